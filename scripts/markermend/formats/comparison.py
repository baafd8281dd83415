"""What differs between an original and its cleaned copy, determined independently of the code that wrote it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from markermend.formats.c3d.data_layout import locate
from markermend.formats.c3d.parameters import read_section
from markermend.formats.text import lines, reader

CHUNK = 1 << 24
"""Bytes compared at a time."""


@dataclass(frozen=True)
class Difference:
    """How two files differ.

    Attributes
    ----------
    changed_bytes : int
        Bytes of the copy that differ from the original within the samples that were to change; in a text file, bytes of
        their cells.
    other_bytes_equal : bool
        Whether every byte outside those samples is the same.
    """

    changed_bytes: int
    other_bytes_equal: bool


def compare(original: Path, cleaned: Path, *, format: str, changed: np.ndarray, columns: Sequence[int]) -> Difference:
    """Compare an original and its cleaned copy.

    Parameters
    ----------
    original, cleaned : Path
        Two files of one format.
    format : str
        Of the files, as read.
    changed : ndarray of bool, shape (frames, markers)
        The samples that are allowed to differ.
    columns : sequence of int
        Index of each marker among the file's trajectories, as read.

    Returns
    -------
    Difference
        How they differ.
    """
    if format == "c3d":
        return _compare_bytes(original, cleaned, changed, columns)
    return _compare_cells(original, cleaned, format, changed, columns)


def _compare_bytes(original: Path, cleaned: Path, changed: np.ndarray, columns: Sequence[int]) -> Difference:
    """Compare C3D files byte by byte, with the bytes of the changed samples marked."""
    size = original.stat().st_size
    if cleaned.stat().st_size != size:
        return Difference(abs(cleaned.stat().st_size - size), False)
    if size == 0:
        return Difference(0, True)
    before, after = np.memmap(original, np.uint8, "r"), np.memmap(cleaned, np.uint8, "r")
    different = np.concatenate(
        [np.flatnonzero(before[at : at + CHUNK] != after[at : at + CHUNK]) + at for at in range(0, size, CHUNK)]
    )
    frame, marker = np.nonzero(changed)
    if not len(frame):
        return Difference(0, not len(different))
    layout = locate(read_section(original), size, original.name)
    width = 16 if layout.real else 8
    starts = np.sort(layout.start + frame * layout.stride + np.asarray(columns, int)[marker] * width)
    nearest = np.searchsorted(starts, different, side="right") - 1
    inside = (nearest >= 0) & (different - starts[nearest] < width)
    return Difference(int(inside.sum()), bool(inside.all()))


def _compare_cells(
    original: Path, cleaned: Path, format: str, changed: np.ndarray, columns: Sequence[int]
) -> Difference:
    """Compare text files cell by cell: lines without a changed sample must be equal, in others only its cells may differ."""
    before, after = lines.load(original), lines.load(cleaned)
    if len(before.lines) != len(after.lines):
        return Difference(0, False)
    layout = reader.FORMATS[format](before)
    row_of = {line: row for row, line in enumerate(layout.rows)}
    count, equal = 0, before.joined([b""] * len(before.lines)) == after.joined([b""] * len(after.lines))
    for number, (old, new) in enumerate(zip(before.lines, after.lines, strict=True)):
        if old == new:
            continue
        row = row_of.get(number)
        allowed = () if row is None else (layout.columns[columns[m]] for m in np.flatnonzero(changed[row]).tolist())
        cells = {cell for triple in allowed for cell in triple}
        olds, news = (lines.split(line.removesuffix(b"\r"), layout.delimiter) for line in (old, new))
        equal &= old.endswith(b"\r") == new.endswith(b"\r")
        olds += [b""] * (len(news) - len(olds))
        if len(olds) != len(news):
            return Difference(count, False)
        for cell, (was, now) in enumerate(zip(olds, news, strict=True)):
            if was != now and cell in cells:
                count += len(now)
            elif was != now:
                equal = False
    return Difference(count, equal)
