"""The numbers in the cells of a table, and why a cell holds none."""

from __future__ import annotations

from collections.abc import Sequence
from operator import itemgetter

import numpy as np

from markermend.core.recording import BadRecording
from markermend.formats.text.lines import BLANKS, Sheet, split
from markermend.formats.text.table_layout import Layout

ROWS_AT_A_TIME = 4096
"""Rows that are split at a time, so that a large file needs little memory."""

READ, BLANK, NOT_FINITE, NOT_A_NUMBER = range(4)
"""What a cell holds: a number, nothing, the text of something not finite (nan, inf), or other text."""


def parse(sheet: Sheet, layout: Layout, columns: Sequence[int]) -> tuple[np.ndarray, np.ndarray, int]:
    """Read some columns of a table as numbers.

    Parameters
    ----------
    sheet : Sheet
        The file.
    layout : Layout
        Where its trajectories stand.
    columns : sequence of int
        The columns to read.

    Returns
    -------
    numbers : ndarray of float, shape (rows, columns)
        In the file's unit; NaN where a cell holds no finite number.
    why : ndarray of uint8, shape (rows, columns)
        What each cell holds: READ, BLANK, NOT_FINITE or NOT_A_NUMBER.
    short : int
        How many rows were too short to have all the cells.

    Raises
    ------
    BadRecording
        If rows are so short that the header promises far more than the file can hold.
    """
    size = sum(len(sheet.lines[row]) for row in layout.rows)
    if len(layout.rows) * len(columns) > 20 * size + 100_000:
        raise BadRecording(f"{sheet.name}: its rows are far shorter than its header says. Export it again")
    width = max(columns) + 1
    pick = itemgetter(*columns, columns[0])
    blocks, reasons, short = [], [], 0
    for start in range(0, len(layout.rows), ROWS_AT_A_TIME):
        rows = [split(sheet.lines[row], layout.delimiter) for row in layout.rows[start : start + ROWS_AT_A_TIME]]
        if start + ROWS_AT_A_TIME >= len(layout.rows) and _breaks_off(sheet, layout):
            rows[-1].pop()
        cells: list[bytes] = []
        for row in rows:
            if len(row) < width:
                short += 1
                row.extend([b""] * (width - len(row)))
            cells.extend(pick(row))
        numbers, why = _numbers(cells, layout.decimal_comma)
        blocks.append(numbers.reshape(len(rows), -1)[:, :-1])
        reasons.append(why.reshape(len(rows), -1)[:, :-1])
    if not blocks:
        return np.empty((0, len(columns))), np.empty((0, len(columns)), np.uint8), 0
    return np.concatenate(blocks), np.concatenate(reasons), short


def _breaks_off(sheet: Sheet, layout: Layout) -> bool:
    """True if the file ends within its last row, whose last number may have lost digits: that cell does not count."""
    rows = layout.rows[-2:]
    widths = [len(split(sheet.lines[row], layout.delimiter)) for row in rows]
    return not sheet.complete and rows[-1] == len(sheet.lines) - 1 and widths[-1] < widths[0]


def _numbers(cells: list[bytes], decimal_comma: bool) -> tuple[np.ndarray, np.ndarray]:
    """The numbers in cells, NaN where there is none, and why not."""
    if decimal_comma:
        cells = [cell.replace(b",", b".") for cell in cells]
    try:
        if any(b"_" in cell for cell in cells):
            raise ValueError("Python reads 1_0 as a number, and no one else does")
        numbers = np.fromiter(map(float, cells), float, len(cells))
    except ValueError:
        numbers = np.fromiter(map(_number, cells), float, len(cells))
    why = np.zeros(len(cells), np.uint8)
    unread = np.flatnonzero(~np.isfinite(numbers))
    why[unread] = [_reason(cells[i]) for i in unread.tolist()]
    numbers[unread] = np.nan
    return numbers, why


def _number(cell: bytes) -> float:
    """The number in a cell, perhaps in quotes, or NaN."""
    text = cell.strip(BLANKS).strip(b'"')
    if not text or b"_" in text:
        return np.nan
    try:
        return float(text)
    except ValueError:
        return np.nan


def _reason(cell: bytes) -> int:
    """Why a cell holds no finite number."""
    text = cell.strip(BLANKS).strip(b'"').strip(BLANKS)
    if not text:
        return BLANK
    try:
        float(text)
    except ValueError:
        return NOT_A_NUMBER
    return NOT_A_NUMBER if b"_" in text else NOT_FINITE
