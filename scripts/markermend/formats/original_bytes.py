"""The bytes of an original in whose place its cleaned copy has others, found by comparing both files."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import accumulate
from pathlib import Path

import numpy as np

from markermend.formats.c3d.data_layout import locate
from markermend.formats.c3d.parameters import read_section
from markermend.formats.text import lines, reader
from markermend.storage.original_bytes import OriginalBytes


def find_original_bytes(
    original: Path, cleaned: Path, *, format: str, marker: np.ndarray, frame: np.ndarray, columns: Sequence[int]
) -> OriginalBytes:
    """Find what the original has in place of each changed sample of its cleaned copy.

    Parameters
    ----------
    original, cleaned : Path
        Two files of one format, equal but for the changed samples.
    format : str
        Of the files, as read.
    marker, frame : ndarray of int, shape (n,)
        The changed samples: index of the marker, and frame as a row counted from 0.
    columns : sequence of int
        Index of each marker among the file's trajectories, as read.

    Returns
    -------
    OriginalBytes
        Of C3D files the stored numbers of each sample with their word 4; of text files the cells with all that stands in them.
    """
    column = np.asarray(columns, int)[marker]
    if format == "c3d":
        return _of_points(original, cleaned, column, frame)
    found = sorted(_of_cells(original, cleaned, format, column, frame))
    sample, start, stop, content, written, padding = zip(*found, strict=True) if found else ((),) * 6
    places = [np.array(numbers, int) for numbers in (sample, start, stop)]
    return OriginalBytes(places[0], places[1], places[2], tuple(content), tuple(written), np.array(padding, bool))


def _of_points(original: Path, cleaned: Path, column: np.ndarray, frame: np.ndarray) -> OriginalBytes:
    """The four numbers of each sample of a C3D file, which lie at the same place in both files."""
    count = len(frame)
    layout = locate(read_section(original), original.stat().st_size, original.name)
    width = 16 if layout.real else 8
    start = layout.start + frame * layout.stride + column * width
    content, written = (_stored(path, start, width) for path in (original, cleaned))
    return OriginalBytes(np.arange(count), start, start + width, content, written, np.zeros(count, bool))


def _stored(path: Path, start: np.ndarray, width: int) -> tuple[bytes, ...]:
    """The bytes of a file at some places."""
    stored = np.memmap(path, np.uint8, "r")[start[:, None] + np.arange(width)].tobytes()
    return tuple(stored[at : at + width] for at in range(0, len(stored), width))


Stretch = tuple[int, int, int, bytes, bytes, bool]
"""Sample, start, stop, both contents, and whether it is padding: see `OriginalBytes`."""


def _of_cells(original: Path, cleaned: Path, format: str, column: np.ndarray, frame: np.ndarray) -> Iterator[Stretch]:
    """The cells of each sample of a text file that differ, and the delimiters that were added to rows that lacked cells."""
    before, after = lines.load(original), lines.load(cleaned)
    layout = reader.FORMATS[format](before)
    starts = list(accumulate((len(line) + len(after.newline) for line in after.lines), initial=len(after.mark)))
    samples: dict[int, list[int]] = {}
    for sample, row in enumerate(frame.tolist()):
        samples.setdefault(row, []).append(sample)
    for row, own in samples.items():
        number = layout.rows[row]
        olds, news = (lines.split(sheet.lines[number].rstrip(b"\r"), layout.delimiter) for sheet in (before, after))
        cell_starts = list(accumulate((len(cell) + len(layout.delimiter) for cell in news), initial=starts[number]))
        cells = sorted((cell, sample) for sample in own for cell in layout.columns[column[sample]])
        for cell, sample in cells:
            was = olds[cell] if cell < len(olds) else b""
            if cell < len(news) and news[cell] != was:
                yield sample, cell_starts[cell], cell_starts[cell] + len(news[cell]), was, news[cell], False
        for added in range(len(olds), len(news)):
            sample = next((sample for cell, sample in cells if cell >= added), cells[-1][1])
            yield sample, cell_starts[added] - len(layout.delimiter), cell_starts[added], b"", layout.delimiter, True
