"""Recordings by their file names: which module reads a file, and which writes edited samples back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from markermend.core.recording import BadRecording
from markermend.formats.reading import PatchResult, Reading

READABLE = (".c3d", ".trc", ".csv", ".tsv")
"""Endings of the files that can be read, in small letters; what a folder of recordings is searched for."""


def read(path: Path, *, unlabelled: Sequence[str], rate: float | None) -> Reading:
    """Read a recording of any known format, in mm.

    unlabelled: regular expressions for the names of trajectories that nobody labelled. rate: Hz, in place of what the
    file says; None = the file's. Raises BadRecording where the file is absent, of an unknown format, or unusable.
    """
    if not path.is_file():
        raise BadRecording(f"{path.name} is not there: correct the file in the recordings table")
    ending = path.suffix.lower()
    if ending not in READABLE:
        known = ", ".join(READABLE)
        raise BadRecording(f"{path.name} ends in {ending or 'nothing'}, which is not a known format ({known})")
    if rate is not None and not 0 < rate < np.inf:
        raise BadRecording(f"The rate {rate:g} Hz given for {path.name} is impossible: correct the recordings table")
    if ending != ".c3d":
        from markermend.formats.text import reader as text_reader

        return text_reader.read(path, unlabelled=unlabelled, rate=rate)
    from markermend.formats.c3d import reader

    reading = reader.read(path, unlabelled=unlabelled)
    return reading if rate is None else replace(reading, recording=replace(reading.recording, rate=float(rate)))


def write_back(
    original: Path,
    target: Path,
    *,
    format: str,
    positions: np.ndarray,
    changed: np.ndarray,
    columns: Sequence[int],
) -> PatchResult:
    """Copy the original to `target` with the changed samples overwritten, and nothing else changed.

    format, columns: as read. positions: (frames, markers, 3), mm, NaN = missing. changed: bool (frames, markers).
    """
    if format == "c3d":
        from markermend.formats.c3d import reader

        return reader.patch(original, target, positions=positions, changed=changed, columns=columns)
    from markermend.formats.text import reader as text_reader

    return text_reader.patch(original, target, format=format, positions=positions, changed=changed, columns=columns)
