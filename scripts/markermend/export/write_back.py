"""From restored trajectories back to the recording's own file, with a certificate of what changed in it."""

from __future__ import annotations

import os
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from markermend.core.recording import (
    MEASURED,
    MISSING,
    BadRecording,
    Recording,
    Restored,
    SetAside,
    SourceChanged,
    changed,
)
from markermend.formats import comparison, files
from markermend.formats.reading import PatchResult
from markermend.storage import atomic, source_file
from markermend.storage.folder_names import printable


def check_invariant(measured: Recording, restored: Restored) -> None:
    """Check that samples of origin `measured` are those that were ingested.

    Parameters
    ----------
    measured : Recording
        The recording as ingested.
    restored : Restored
        The same after repair and filling.

    Raises
    ------
    BadRecording
        Where any differs.
    """
    wrong = changed(measured, restored) & (restored.origin == MEASURED)
    if wrong.any():
        raise BadRecording(f"{int(wrong.sum())} samples marked as measured differ from the recording: run it again")


def write_cleaned(source: Path, cleaned: Path, measured: Recording, restored: Restored) -> dict[str, Any]:
    """Write the cleaned copy of a file.

    The copy is compared with the file byte by byte (text: cell by cell) by code that had no part in writing it.

    Parameters
    ----------
    source : Path
        The original file.
    cleaned : Path
        The copy, in which only samples that changed differ.
    measured : Recording
        The recording as ingested.
    restored : Restored
        The same after repair and filling.

    Returns
    -------
    dict
        The certificate: checksums, how many samples and bytes changed, and the samples that the file's number format
        cannot hold and that stay as they were (`refused`). JSON values.

    Raises
    ------
    SourceChanged
        Where the source is gone, or not the file that was ingested.
    BadRecording
        Where any other byte would differ.
    """
    check_invariant(measured, restored)
    facts = measured.facts["source"]
    source_file.check(source, planned=facts["sha256"])
    before = atomic.sha256(source)
    if before != facts["sha256"]:
        raise SourceChanged(f"{source.name} has changed since it was ingested; the next run ingests it again")
    differs = changed(measured, restored)
    columns = facts["columns"]
    with atomic.replacing(cleaned, source=source) as temporary:
        if differs.any():
            result = files.write_back(
                source,
                temporary,
                format=facts["format"],
                positions=restored.positions,
                changed=differs,
                columns=columns,
                unit=facts.get("given_unit"),
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


def pass_through(source: Path, cleaned: Path, note: SetAside, *, within: Path | None = None) -> dict[str, Any]:
    """Copy a file whose recording was set aside, byte for byte.

    Parameters
    ----------
    source : Path
        The original file; the copy is an empty file where it cannot be read or is to be left alone (see source_file.check).
    cleaned : Path
        The copy.
    note : SetAside
        The stage that set the recording aside, and why.
    within : Path, optional
        The folder that links may not lead out of.

    Returns
    -------
    dict
        A certificate that says so, without a checksum of a file that was not read. JSON values.
    """
    before = _checksum(source, within)
    with atomic.replacing(cleaned, source=source) as temporary:
        if before is None:
            temporary.touch()
        else:
            shutil.copyfile(source, temporary)
        after = atomic.sha256(temporary)
    return {
        "source": printable(source.name),
        "original_sha256": before,
        "cleaned_sha256": after,
        "changed_samples": 0,
        "blanked_samples": 0,
        "changed_bytes": 0,
        "other_bytes_equal": True,
        "refused": [],
        "untouched": {"stage": note.stage, "reason": note.reason},
    }


def write_certificate(path: Path, certificate: Mapping[str, Any], cleaned: Path) -> None:
    """Write a certificate, with the path of the cleaned file from its folder.

    Parameters
    ----------
    path : Path
        Its file.
    certificate : mapping of str to Any
        What `write_cleaned` or `pass_through` gives.
    cleaned : Path
        The cleaned file.

    Raises
    ------
    NotWritten
        Where it cannot be written.
    """
    place = Path(os.path.relpath(cleaned, path.parent)).as_posix()
    atomic.write_json(path, {**certificate, "cleaned": place})


def _checksum(source: Path, within: Path | None) -> str | None:
    """The checksum of an original; None where it cannot be read or is to be left alone."""
    try:
        source_file.check(source, within=within)
        return atomic.sha256(source)
    except (BadRecording, OSError):
        return None
