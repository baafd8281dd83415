"""From restored trajectories back to the recording's own file: what changed, the list of changes, and the certificate."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

from markermend.core.recording import MEASURED, MISSING, BadRecording, Recording, Restored, changed
from markermend.formats import comparison, files
from markermend.formats.reading import PatchResult
from markermend.storage import atomic
from markermend.storage.folder_names import printable


def check_invariant(measured: Recording, restored: Restored) -> None:
    """Raise BadRecording where a sample said to be measured is not the one that was ingested."""
    wrong = changed(measured, restored) & (restored.origin == MEASURED)
    if wrong.any():
        raise BadRecording(f"{int(wrong.sum())} samples marked as measured differ from the recording: run it again")


def write_cleaned(source: Path, cleaned: Path, measured: Recording, restored: Restored) -> dict[str, Any]:
    """Write the cleaned copy of the source and return its certificate.

    Only samples that changed differ from the source; the copy is compared with it byte by byte (text: cell by cell) by
    code that had no part in writing it. Raises BadRecording where the source is not the file that was ingested, or
    where any other byte differs.
    """
    check_invariant(measured, restored)
    facts = measured.facts["source"]
    before = atomic.sha256(source)
    if before != facts["sha256"]:
        raise BadRecording(f"{source.name} has changed since it was ingested: run the workflow again")
    differs = changed(measured, restored)
    columns = facts["columns"]
    with atomic.replacing(cleaned) as temporary:
        if differs.any():
            result = files.write_back(
                source,
                temporary,
                format=facts["format"],
                positions=restored.positions,
                changed=differs,
                columns=columns,
            )
        else:
            shutil.copyfile(source, temporary)
            result = PatchResult(0)
        difference = comparison.compare(source, temporary, format=facts["format"], changed=differs, columns=columns)
        after = atomic.sha256(temporary)
        if not difference.other_bytes_equal:
            raise BadRecording(f"writing {cleaned.name} would have changed more than the repaired samples; not written")
    blanked = differs & (restored.origin == MISSING)
    return {
        "source": facts["name"],
        "original_sha256": before,
        "cleaned_sha256": after,
        "changed_samples": result.samples,
        "blanked_samples": int(blanked.sum()),
        "changed_bytes": difference.changed_bytes,
        "other_bytes_equal": difference.other_bytes_equal,
        "refused": [
            {"marker": measured.markers[columns.index(column)], "frame": measured.first_frame + frame}
            for frame, column in result.refused
        ],
    }


def pass_through(source: Path, cleaned: Path, stage: str, reason: str) -> dict[str, Any]:
    """Copy a recording that was set aside, byte for byte, and return a certificate that says so.

    Where the source is gone (a broken link, say) the copy is an empty file, and the certificate has no checksum of it.
    """
    gone = not source.is_file()
    with atomic.replacing(cleaned) as temporary:
        if gone:
            temporary.touch()
        else:
            shutil.copyfile(source, temporary)
        after = atomic.sha256(temporary)
    return {
        "source": printable(source.name),
        "original_sha256": None if gone else atomic.sha256(source),
        "cleaned_sha256": after,
        "changed_samples": 0,
        "blanked_samples": 0,
        "changed_bytes": 0,
        "other_bytes_equal": True,
        "refused": [],
        "untouched": {"stage": stage, "reason": reason},
    }
