"""Which lines of a text file are the rows of its table, and how they write numbers."""

from __future__ import annotations

from collections.abc import Sequence

from markermend.formats.text.lines import BLANKS, Sheet, has_decimal_comma, is_number

SAMPLE_LINES = 200
"""How many lines are inspected to find out how the numbers of a file are written."""


def frame_rows(sheet: Sheet, start: int, delimiter: bytes, *, section: bool) -> tuple[list[int], list[str]]:
    """Find the lines of a table in which the first cell of each row is a number, its frame or its time.

    Blank lines are no rows. Text above the first and below the last row is left alone.

    Parameters
    ----------
    sheet : Sheet
        The file.
    start : int
        The first line that can be a row.
    delimiter : bytes
        What stands between two cells.
    section : bool
        Whether a blank line followed by text ends the table, because another section follows.

    Returns
    -------
    rows : list of int
        Numbers of the lines.
    warnings : list of str
        One sentence each.
    """
    lines = sheet.filled(start, delimiter)
    numbered = [_is_numbered(sheet.lines[line], delimiter) for line in lines]
    if section:
        after_blank = [line > before + 1 for before, line in zip([start - 1, *lines], lines, strict=False)]
        end = next((i for i in range(len(lines)) if after_blank[i] and not numbered[i]), len(lines))
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
    """Find the lines of a table without frame numbers.

    Parameters
    ----------
    sheet : Sheet
        The file.
    start : int
        The first line that can be a row.
    delimiter : bytes
        What stands between two cells.

    Returns
    -------
    list of int
        Numbers of all lines that are not empty, up to the last with more in it than delimiters.
    """
    filled = sheet.filled(start, delimiter)
    return [i for i in range(start, filled[-1] + 1) if sheet.lines[i].strip(b" \r")] if filled else []


def row_widths(sheet: Sheet, rows: Sequence[int], delimiter: bytes) -> list[int]:
    """Count the cells of each row, up to its last that is not blank.

    Parameters
    ----------
    sheet : Sheet
        The file.
    rows : sequence of int
        Numbers of the lines.
    delimiter : bytes
        What stands between two cells.

    Returns
    -------
    list of int
        One for each row.
    """
    void = BLANKS + delimiter
    return [sheet.lines[row].rstrip(void).count(delimiter) + 1 for row in rows]


def writes_decimal_comma(sheet: Sheet, rows: Sequence[int], delimiter: bytes) -> bool:
    """Determine from a sample of the rows whether they write numbers with a decimal comma.

    Parameters
    ----------
    sheet : Sheet
        The file.
    rows : sequence of int
        Numbers of the lines.
    delimiter : bytes
        What stands between two cells.

    Returns
    -------
    bool
        Whether they do.
    """
    sample = rows[:: max(1, len(rows) // SAMPLE_LINES)]
    return has_decimal_comma((sheet.lines[row] for row in sample), delimiter)


def _is_numbered(line: bytes, delimiter: bytes) -> bool:
    """True if the first cell of a line is a number."""
    return is_number(line.partition(delimiter)[0].decode("latin-1").strip(' \t\r"\0'))
