"""Recordings by their file names: which module reads a file, and which writes edited samples back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from markermend.core.recording import BadRecording
from markermend.formats.reading import PatchResult, Reading
from markermend.storage import source_file

READABLE = (".c3d", ".trc", ".csv", ".tsv")
"""Endings of the files that can be read, in small letters; what a folder of recordings is searched for."""


COMPRESSED = "is compressed: unpack it"

UNREADABLE = {
    **dict.fromkeys((".gz", ".zip", ".bz2", ".xz", ".zst", ".7z", ".rar", ".tgz"), COMPRESSED),
    ".trb": "is a binary TRB file: export it from Cortex as C3D or TRC",
    ".tak": "is a take of Motive: export it as C3D or CSV",
    ".qtm": "is a file of QTM: export it as C3D or TSV",
    **dict.fromkeys((".x1d", ".x2d"), "holds the data of cameras: export the trial from Nexus as C3D"),
    **dict.fromkeys((".xls", ".xlsx", ".ods"), "is a spreadsheet: save it as CSV"),
    ".mat": "is a MATLAB file: export the recording as C3D or TSV",
}
"""What may hold a recording but is not read, by ending in small letters: what it is, and what to do."""


def why_unreadable(name: str) -> str | None:
    """Say why a file cannot be read, by its name.

    Parameters
    ----------
    name : str
        Of the file.

    Returns
    -------
    str or None
        What follows its name in a sentence; None where its ending is that of a format that can be read.
    """
    ending = Path(name).suffix.lower()
    if ending in READABLE:
        return None
    unknown = f"ends in {ending or 'nothing'}, which is not a known format ({', '.join(READABLE)})"
    return UNREADABLE.get(ending, unknown)


def read(path: Path, *, unlabelled: Sequence[str], rate: float | None, unit: str | None = None) -> Reading:
    """Read a recording of any known format.

    Parameters
    ----------
    path : Path
        The file; its ending decides how it is read.
    unlabelled : sequence of str
        Regular expressions for the names that capture programs give to unlabelled trajectories (see labels.py).
    rate : float or None
        Frame rate in Hz, used in place of the file's; None = the file's.
    unit : str, optional
        Unit of the positions, a key of units.MILLIMETRES, used in place of the file's; None = the file's.

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
    if reason := why_unreadable(path.name):
        raise BadRecording(f"{path.name} {reason}")
    if rate is not None and not 0 < rate < np.inf:
        raise BadRecording(f"The rate {rate:g} Hz given for {path.name} is impossible: correct the recordings table")
    if path.suffix.lower() != ".c3d":
        from markermend.formats.text import reader as text_reader

        return text_reader.read(path, unlabelled=unlabelled, rate=rate, unit=unit)
    from markermend.formats.c3d import reader

    reading = reader.read(path, unlabelled=unlabelled, unit=unit)
    return reading if rate is None else replace(reading, recording=replace(reading.recording, rate=float(rate)))


def write_back(
    original: Path,
    target: Path,
    *,
    format: str,
    positions: np.ndarray,
    changed: np.ndarray,
    columns: Sequence[int],
    unit: str | None = None,
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
    unit : str, optional
        As given for reading.

    Returns
    -------
    PatchResult
        How many samples were written, and which were refused.

    Raises
    ------
    ValueError
        If the shapes do not fit the file.
    """
    samples: dict[str, Any] = {"positions": positions, "changed": changed, "columns": columns, "unit": unit}
    if format == "c3d":
        from markermend.formats.c3d import reader

        return reader.patch(original, target, **samples)
    from markermend.formats.text import reader as text_reader

    return text_reader.patch(original, target, format=format, **samples)
