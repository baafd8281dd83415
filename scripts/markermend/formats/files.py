"""Recordings by their file names: which module reads a file, and which writes edited samples back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from markermend.core.recording import BadRecording
from markermend.formats.reading import PatchResult, Reading
from markermend.storage import source_file

READABLE = (".c3d", ".trc", ".csv", ".tsv")
"""Endings of the files that can be read, in small letters; what a folder of recordings is searched for."""


def read(path: Path, *, unlabelled: Sequence[str], rate: float | None) -> Reading:
    """Read a recording of any known format.

    Parameters
    ----------
    path : Path
        The file; its ending decides how it is read.
    unlabelled : sequence of str
        Regular expressions for the names that capture programs give to unlabelled trajectories (see labels.py).
    rate : float or None
        Frame rate in Hz, used in place of the file's; None = the file's.

    Returns
    -------
    Reading
        Positions in mm; NaN where a sample is missing.

    Raises
    ------
    BadRecording
        If the file is absent, of an unknown format, or unusable.
    """
    source_file.check(path)
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
    """Copy the original with the changed samples overwritten, and nothing else changed.

    Parameters
    ----------
    original, target : Path
        The file, and where its copy goes.
    format : str
        As read.
    positions : ndarray of float, shape (frames, markers, 3)
        In mm; NaN = missing.
    changed : ndarray of bool, shape (frames, markers)
        The samples to write.
    columns : sequence of int
        Index of each marker among the file's trajectories, as read.

    Returns
    -------
    PatchResult
        How many samples were written, and which were refused.

    Raises
    ------
    ValueError
        If the shapes do not fit the file.
    """
    if format == "c3d":
        from markermend.formats.c3d import reader

        return reader.patch(original, target, positions=positions, changed=changed, columns=columns)
    from markermend.formats.text import reader as text_reader

    return text_reader.patch(original, target, format=format, positions=positions, changed=changed, columns=columns)
