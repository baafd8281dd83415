"""Where the trajectories of a text file stand: the one thing in which the text formats differ.

A format's module only describes the layout of a file; reading and patching (formats/text.py) are the same for all.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from markermend.core.recording import BadRecording
from markermend.formats.text.lines import BLANKS, Sheet, has_decimal_comma, is_number

MILLIMETRES = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, "ft": 304.8}
"""How many millimetres each unit has."""

_UNITS = {
    **{name: "mm" for name in ("mm", "millimeter", "millimeters", "millimetre", "millimetres")},
    **{name: "cm" for name in ("cm", "centimeter", "centimeters", "centimetre", "centimetres")},
    **{name: "m" for name in ("m", "meter", "meters", "metre", "metres")},
    **{name: "in" for name in ("in", "inch", "inches")},
    **{name: "ft" for name in ("ft", "foot", "feet")},
}

SAMPLE_LINES = 200
"""How many lines are looked at to learn how the numbers of a file are written."""


@dataclass(frozen=True)
class Layout:
    """Where the trajectories of a text file stand.

    rows: numbers of the lines that hold the frames. names: one per trajectory, as in the file. columns: the cells of
    its x, y, z. unit, rate (Hz): as the file says; None where it does not. frame, time: columns of the frame number
    and the time. seconds: how many seconds the unit of time has. left: trajectories left alone whatever their name.
    model_outputs: names of computed quantities left alone. frames: as the header promises. decimal_comma: whether
    numbers are written with one. own_missing: whether a missing sample is written as the file itself does, or else
    left blank. warnings: one sentence each.
    """

    format: str
    delimiter: bytes
    rows: Sequence[int]
    names: tuple[str, ...]
    columns: tuple[tuple[int, int, int], ...]
    unit: str | None
    rate: float | None
    frame: int | None = 0
    time: int | None = None
    seconds: float = 1.0
    left: frozenset[int] = frozenset()
    model_outputs: tuple[str, ...] = ()
    frames: int | None = None
    decimal_comma: bool = False
    own_missing: bool = False
    warnings: tuple[str, ...] = ()


def unit_named(sheet: Sheet, text: str) -> str:
    """The unit that a text names: mm, cm, m, in or ft.

    Raises BadRecording for a unit that is not one of length.
    """
    unit = _UNITS.get(text.strip().lower())
    if unit is None:
        raise BadRecording(f"{sheet.name}: the unit '{text[:40]}' is not known: use mm, cm or m")
    return unit


def rate_named(text: str) -> float | None:
    """The frame rate (Hz) that a text gives, or None where it is no finite number above zero."""
    rate = float(text.replace(",", ".")) if is_number(text) else 0.0
    return rate if 0 < rate < float("inf") else None


def count_named(text: str) -> int | None:
    """The count that a text gives, or None."""
    return int(text) if re.fullmatch(r"\d{1,12}", text) else None


def frame_rows(sheet: Sheet, start: int, delimiter: bytes, *, section: bool) -> tuple[list[int], list[str]]:
    """Find the lines of a table whose first cell is a number in each row: its frame or its time.

    start: the first line that can be one. section: a blank line and then text end the table; what follows is another.
    Blank lines are no rows. Text above the first and below the last row is left alone. Returns line numbers and
    warnings.
    """
    lines = sheet.filled(start, delimiter)
    numbered = [_is_numbered(sheet.lines[line], delimiter) for line in lines]
    if section:
        gaps = [line > before + 1 for before, line in zip([start - 1, *lines], lines, strict=False)]
        end = next((i for i in range(len(lines)) if gaps[i] and not numbered[i]), len(lines))
        lines, numbered = lines[:end], numbered[:end]
    first = next((i for i, number in enumerate(numbered) if number), len(lines))
    lines, numbered = lines[first:], numbered[first:]
    last = max((i for i, number in enumerate(numbered) if number), default=-1) + 1
    warnings = []
    if last < len(lines):
        warnings.append(f"Text from line {lines[last] + 1} on is no frame and is left alone.")
    unnumbered = [line for line, number in zip(lines[:last], numbered[:last], strict=True) if not number]
    if unnumbered:
        warnings.append(f"{len(unnumbered)} rows have no frame number, the first in line {unnumbered[0] + 1}.")
    return lines[:last], warnings


def plain_rows(sheet: Sheet, start: int, delimiter: bytes) -> list[int]:
    """Find the lines of a table without frame numbers: all that are not empty, up to the last with anything in it."""
    filled = sheet.filled(start, delimiter)
    return [i for i in range(start, filled[-1] + 1) if sheet.lines[i].strip(b" \r")] if filled else []


def row_widths(sheet: Sheet, rows: Sequence[int], delimiter: bytes) -> list[int]:
    """How many cells each row has, up to its last that is not blank."""
    void = BLANKS + delimiter
    return [sheet.lines[row].rstrip(void).count(delimiter) + 1 for row in rows]


def writes_decimal_comma(sheet: Sheet, rows: Sequence[int], delimiter: bytes) -> bool:
    """Tell whether the rows write numbers with a decimal comma, by a sample of them."""
    sample = rows[:: max(1, len(rows) // SAMPLE_LINES)]
    return has_decimal_comma((sheet.lines[row] for row in sample), delimiter)


def triples(axes: Sequence[str], start: int) -> list[int]:
    """The columns from start on where the axes X, Y, Z begin."""
    upper = [axis.upper() for axis in axes]
    return [i for i in range(start, len(upper) - 2) if upper[i : i + 3] == ["X", "Y", "Z"]]


def consecutive(starts: Sequence[int]) -> tuple[tuple[int, int, int], ...]:
    """The columns of x, y, z that stand side by side from each start on."""
    return tuple((start, start + 1, start + 2) for start in starts)


def _is_numbered(line: bytes, delimiter: bytes) -> bool:
    """True if the first cell of a line is a number."""
    return is_number(line.partition(delimiter)[0].decode("latin-1").strip(' \t\r"\0'))
