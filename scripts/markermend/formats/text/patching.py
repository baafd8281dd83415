"""New numbers put into the cells of a table, written as the table writes its own."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.formats.text.cells import READ, ROWS_AT_A_TIME, parse
from markermend.formats.text.lines import BLANKS, Sheet, split
from markermend.formats.text.table_layout import Layout
from markermend.formats.units import MILLIMETRES

MOST_DECIMALS = 15
"""More decimals than this carry no information."""

BLANK_SAMPLE = (b"", b"", b"")


@dataclass(frozen=True)
class Style:
    """How a table writes numbers.

    Attributes
    ----------
    decimals : dict of int to int
        Decimals of each of its columns.
    missing : tuple of bytes
        The three cells of a missing sample.
    """

    decimals: dict[int, int]
    missing: tuple[bytes, ...]


def style_of(sheet: Sheet, layout: Layout, unit: str, changed: Sequence[int], known: Sequence[int]) -> Style:
    """Determine how a table writes numbers and missing samples.

    Parameters
    ----------
    sheet : Sheet
        The file.
    layout : Layout
        Where its trajectories stand.
    unit : str
        Of the file.
    changed : sequence of int
        Trajectories that are written to.
    known : sequence of int
        Trajectories in which missing samples are looked for.

    Returns
    -------
    Style
        Decimals for the columns of the changed trajectories, and the cells of a missing sample.
    """
    least = 3 + round(float(np.log10(MILLIMETRES[unit])))
    decimals = {column: least for trajectory in changed for column in layout.columns[trajectory]}
    for start in range(0, len(layout.rows), ROWS_AT_A_TIME):
        rows = [split(sheet.lines[row], layout.delimiter) for row in layout.rows[start : start + ROWS_AT_A_TIME]]
        for column, most in decimals.items():
            decimals[column] = most_decimals((row[column] for row in rows if column < len(row)), most)
    return Style(decimals, _missing_cells(sheet, layout, known) if layout.own_missing else BLANK_SAMPLE)


def most_decimals(cells: Iterable[bytes], least: int) -> int:
    """Count the most decimals that the numbers of some cells have.

    Parameters
    ----------
    cells : iterable of bytes
        Of one column.
    least : int
        The least number to give.

    Returns
    -------
    int
        Between `least` and MOST_DECIMALS.
    """
    most = least
    for cell in cells:
        whole, _, fraction = cell.strip(BLANKS).strip(b'"').lower().replace(b",", b".").partition(b".")
        digits, _, exponent = (fraction or whole).partition(b"e")
        shift = int(exponent) if exponent.lstrip(b"+-").isdigit() and len(exponent) < 5 else 0
        if len(digits) * bool(fraction) - shift > most and (digits.isdigit() or not digits):
            most = len(digits) * bool(fraction) - shift
    return min(most, MOST_DECIMALS)


def _missing_cells(sheet: Sheet, layout: Layout, known: Sequence[int]) -> tuple[bytes, ...]:
    """The cells of the first missing sample of a table, blank where it has none or its row lacks them."""
    numbers, why, _ = parse(sheet, layout, [column for trajectory in known for column in layout.columns[trajectory]])
    unread = (why != READ).reshape(len(why), -1, 3).all(axis=2)
    zero = (numbers.reshape(len(numbers), -1, 3) == 0).all(axis=2)
    found = np.argwhere(unread | zero)
    if not found.size:
        return BLANK_SAMPLE
    row, trajectory = found[0].tolist()
    cells = split(sheet.lines[layout.rows[row]], layout.delimiter)
    texts = [
        cells[column].strip(BLANKS) if column < len(cells) else b"" for column in layout.columns[known[trajectory]]
    ]
    return tuple(texts) if all(len(text) < 12 for text in texts) else BLANK_SAMPLE


def sample_cells(
    position: Sequence[float], columns: Sequence[int], layout: Layout, style: Style
) -> tuple[bytes, ...] | None:
    """Write a position as cells.

    Parameters
    ----------
    position : sequence of float
        x, y and z in the file's unit; all NaN = missing.
    columns : sequence of int
        The columns of x, y and z.
    layout : Layout
        Where the trajectories stand.
    style : Style
        How the table writes numbers.

    Returns
    -------
    tuple of bytes or None
        None where the cells would be read back as a missing sample although the position is not.
    """
    if not np.isfinite(position).all():
        return style.missing if np.isnan(position).all() else None
    texts = [f"{value:.{style.decimals[column]}f}" for value, column in zip(position, columns, strict=True)]
    zero = [float(text) == 0 for text in texts]
    if all(zero):
        return None
    texts = [text.lstrip("-") if void else text for text, void in zip(texts, zero, strict=True)]
    return tuple((text.replace(".", ",") if layout.decimal_comma else text).encode() for text in texts)


def line_with(line: bytes, delimiter: bytes, texts: dict[int, bytes], *, ended: bool = False) -> bytes:
    """Give a line with other texts in some of its cells; it grows by as many cells as they need.

    Parameters
    ----------
    line : bytes
        As in the file.
    delimiter : bytes
        What stands between two cells.
    texts : dict of int to bytes
        New texts by column.
    ended : bool, optional
        Whether a delimiter is put behind the last cell where that becomes blank: OpenSim does not count it otherwise.

    Returns
    -------
    bytes
        The line.
    """
    body = line.rstrip(b"\r")
    cells = split(body, delimiter)
    for column, text in sorted(texts.items()):
        if text and column >= len(cells):
            cells += [b""] * (column + 1 - len(cells))
        if column < len(cells):
            cells[column] = _cell_with(cells[column], text, delimiter)
    if ended and texts.get(len(cells) - 1) == b"" and cells[-1] == b"":
        cells.append(b"")
    return delimiter.join(cells) + line[len(body) :]


def _cell_with(cell: bytes, text: bytes, delimiter: bytes) -> bytes:
    """A cell with another text between its outer blanks, in quotes if it was or has to be."""
    core = cell.strip(BLANKS)
    before, _, after = cell.partition(core) if core else (cell, b"", b"")
    if (core[:1] == b'"' or delimiter in text) and text[:1] != b'"':
        text = b'"' + text + b'"'
    return before + text + after
