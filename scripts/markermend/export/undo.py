"""Changes taken back: the original bit for bit, or the findings that a person names, from the cleaned file and what is kept beside it.

Reads: the cleaned file; originals.parquet and certificate.json of its recording. The original itself is not needed.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from markermend.core.originals import Originals, find_originals, select_findings
from markermend.core.recording import BadRecording, Recording, SetAside
from markermend.core.written import WrittenChanges
from markermend.export.partly_undone import file_bytes, recognise
from markermend.formats.original_bytes import find_original_bytes
from markermend.storage import atomic, originals_file
from markermend.storage.original_bytes import OriginalBytes


class NotUndone(Exception):
    """Changes that cannot be taken back; the message says why and what to do."""


class NothingNamed(NotUndone):
    """Markers and frames that name no change of a recording."""


@dataclass(frozen=True)
class Restoration:
    """What was restored, and what stays cleaned.

    Attributes
    ----------
    samples : int
        How many samples were restored.
    stretches : tuple of (str, int, int)
        Marker, first and last frame as the capture program numbers them, of each stretch of restored samples.
    left : int
        How many changed samples stay as they were written.
    """

    samples: int
    stretches: tuple[tuple[str, int, int], ...]
    left: int

    @property
    def whole(self) -> bool:
        """Whether the file is the original again."""
        return not self.left


def keep_originals(
    path: Path,
    source: Path,
    cleaned: Path,
    measured: Recording,
    written: WrittenChanges,
    *,
    sha256: str,
    facts: Mapping[str, Any],
) -> None:
    """Keep what is needed to take the changes of a cleaned file back.

    Parameters
    ----------
    path : Path
        Where it goes: originals.parquet.
    source, cleaned : Path
        The original, and its cleaned copy.
    measured : Recording
        The recording as ingested.
    written : WrittenChanges
        What was written.
    sha256 : str
        Checksum of the original.
    facts : mapping
        What the stage says of itself, JSON values.

    Raises
    ------
    BadRecording
        Where the original would not come back bit for bit.
    """
    originals, about = find_originals(measured, written.recording, written.applied), measured.facts["source"]
    stored = find_original_bytes(
        source,
        cleaned,
        format=about["format"],
        marker=originals.marker,
        frame=originals.frame,
        columns=about["columns"],
    )
    digest = hashlib.sha256()
    for part in stored.put_back(file_bytes(cleaned), np.ones(len(originals.frame), bool), originals.frame):
        digest.update(part)
    if digest.hexdigest() != sha256:
        raise BadRecording(f"the original would not come back from {cleaned.name} bit for bit; not written")
    originals_file.write(path, originals, stored, facts)


def undo(
    cleaned: Path,
    target: Path,
    *,
    originals: Path,
    certificate: Mapping[str, Any],
    markers: Sequence[str] = (),
    frames: tuple[int, int] | None = None,
) -> Restoration:
    """Write a copy of a cleaned file in which changes are taken back.

    Without markers and frames, all are: the copy is the original, bit for bit, and is held against its checksum. Otherwise these
    findings and gaps are, and all other samples stay cleaned: those that share a sample of one of these markers with these frames.
    What can be taken back together only is: both markers of an exchange, and all markers of a finding about several.
    What was taken back before, in the cleaned file or in a copy that stands in the place of this one, stays so.

    Parameters
    ----------
    cleaned : Path
        The cleaned file, as it was written or with some of its changes taken back.
    target : Path
        Where the copy goes; a file that is there may only be equal to it, or a copy in which some changes were taken back.
    originals : Path
        What was kept of the recording, originals.parquet.
    certificate : mapping of str to Any
        Its certificate: see `read_certificate`.
    markers : sequence of str, optional
        Names or patterns with `*` and `?`.
    frames : (int, int), optional
        First and last frame, as the capture program numbers them.

    Returns
    -------
    Restoration
        What was restored.

    Raises
    ------
    NothingNamed
        Where markers and frames name nothing that was changed.
    NotUndone
        Where the cleaned file was altered otherwise, what was kept is missing or damaged, or another file stands in the place of the copy.
    NotWritten
        Where the copy cannot be written.
    """
    if certificate["original_sha256"] is None:
        raise NotUndone(f"{cleaned}: the original could not be read, so there is nothing to restore")
    kept, stored = _kept(originals)
    content, original = _written(cleaned, stored, certificate["cleaned_sha256"])
    there = _taken_back(target, stored, certificate)
    original = original if there is None else original | there
    selected = select_findings(kept, markers=markers, frames=frames)
    if (markers or frames) and not selected.any():
        raise NothingNamed(f"{cleaned}: none of its changes is of these markers and frames, see changes.tsv")
    back = selected | stored.holds_originals(original, len(selected))
    restored = Restoration(int(selected.sum()), _stretches(kept, selected), int((~back).sum()))
    with atomic.replacing(target, source=cleaned) as temporary:
        with open(temporary, "wb") as file:
            file.writelines(stored.put_back(content, back, kept.frame, original))
        found = atomic.sha256(temporary)
        if restored.whole and found != certificate["original_sha256"]:
            raise NotUndone(
                f"{originals} is damaged: the original would not come back bit for bit, nothing was written"
            )
        if found == certificate["original_sha256"]:
            restored = replace(restored, left=0)
        present = atomic.sha256(target) if there is None and target.exists() else found
        if present == certificate["original_sha256"] != found:
            raise NotUndone(f"{target} is the original already: nothing is left to undo in it")
        if present != found:
            raise NotUndone(f"{target} is another file already: name another folder")
    return restored


def read_certificate(path: Path) -> dict[str, Any]:
    """Read the certificate of a recording.

    Parameters
    ----------
    path : Path
        The file certificate.json.

    Returns
    -------
    dict
        Its content; see `markermend.export.write_back.write_cleaned`.

    Raises
    ------
    NotUndone
        Where it is missing or damaged.
    """
    try:
        stated: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        if not {"source", "original_sha256", "cleaned_sha256"} <= stated.keys():
            raise ValueError
    except (OSError, ValueError, AttributeError) as error:
        raise NotUndone(f"{path} is missing or damaged: clean the recording again") from error
    return stated


def _written(cleaned: Path, stored: OriginalBytes, expected: str) -> tuple[np.ndarray, np.ndarray]:
    """The cleaned file as it was written, and the stretches of it that have the original bytes; refused where it was altered otherwise."""
    try:
        written = recognise(cleaned, stored, expected)
    except OSError as error:
        raise NotUndone(f"{cleaned} cannot be read ({error.strerror}): clean the recording again") from error
    if written is None:
        raise NotUndone(
            f"{cleaned} was altered after it was written, so that its changes cannot be taken back: put the file back as it was, or "
            "clean the recording again"
        )
    return written


def _taken_back(target: Path, stored: OriginalBytes, certificate: Mapping[str, Any]) -> np.ndarray | None:
    """The stretches with the original bytes of a copy that stands in the place of the next, in which some changes were taken back and not all."""
    if not target.exists() or atomic.sha256(target) in (certificate["original_sha256"], certificate["cleaned_sha256"]):
        return None
    copy = recognise(target, stored, certificate["cleaned_sha256"])
    return None if copy is None else copy[1]


def _kept(path: Path) -> tuple[Originals, OriginalBytes]:
    """The original values and bytes; none of a recording that was set aside."""
    try:
        return originals_file.read(path), originals_file.read_bytes(path)
    except SetAside:
        nothing = np.zeros(0, int)
        originals = Originals((), nothing, nothing, np.zeros((0, 3)), nothing, (), nothing)
        return originals, OriginalBytes(nothing, nothing, nothing, (), (), np.zeros(0, bool))
    except originals_file.WithoutBytes as error:
        raise NotUndone(f"{path} is of an earlier version, without all bytes: clean the recording again") from error
    except (OSError, BadRecording, KeyError) as error:
        raise NotUndone(f"{path} is missing or damaged: clean the recording again") from error


def _stretches(kept: Originals, selected: np.ndarray) -> tuple[tuple[str, int, int], ...]:
    """The stretches of the selected samples, which are ordered by marker and frame."""
    marker, frame = kept.marker[selected], kept.frame[selected]
    ends = np.flatnonzero((np.diff(marker) != 0) | (np.diff(frame) != 1))
    starts = np.concatenate(([0], ends + 1)) if len(marker) else ends
    stops = np.concatenate((ends, [len(marker) - 1])) if len(marker) else ends
    return tuple(
        (kept.markers[marker[start]], int(frame[start]) + kept.first_frame, int(frame[stop]) + kept.first_frame)
        for start, stop in zip(starts.tolist(), stops.tolist(), strict=True)
    )
