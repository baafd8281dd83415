"""Headers whose last lines name the trajectories, then the axes X, Y, Z, and perhaps the units."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import compress

from markermend.formats.text.header_values import unit_shared
from markermend.formats.text.lines import Sheet
from markermend.formats.text.table_layout import Layout
from markermend.formats.text.table_rows import frame_rows, plain_rows, writes_decimal_comma


def triples(axes: Sequence[str], start: int) -> list[int]:
    """Find where the axes X, Y, Z begin.

    Parameters
    ----------
    axes : sequence of str
        The cells of a line, in any case of letters.
    start : int
        The first column to look at.

    Returns
    -------
    list of int
        Columns of X.
    """
    upper = [axis.upper() for axis in axes]
    return [i for i in range(start, len(upper) - 2) if upper[i : i + 3] == ["X", "Y", "Z"]]


def consecutive(starts: Sequence[int]) -> tuple[tuple[int, int, int], ...]:
    """Give the columns of x, y and z that stand side by side.

    Parameters
    ----------
    starts : sequence of int
        Columns of x.

    Returns
    -------
    tuple[tuple[int, int, int], ...]
        Three columns for each.
    """
    return tuple((start, start + 1, start + 2) for start in starts)


def find_axes(sheet: Sheet, lines: Sequence[int], delimiter: bytes) -> int | None:
    """Find the line that names the axes X, Y, Z side by side.

    Parameters
    ----------
    sheet : Sheet
        The file.
    lines : sequence of int
        Numbers of the lines to look at.
    delimiter : bytes
        What stands between two cells.

    Returns
    -------
    int or None
        The first such line, or None.
    """
    return next((line for line in lines if triples(sheet.texts(line, delimiter), 0)), None)


def below_axes(sheet: Sheet, axes_line: int, delimiter: bytes, format: str, rate: float | None) -> Layout:
    """Describe a table whose header ends in a line of names, one of axes, and perhaps one of units.

    Parameters
    ----------
    sheet : Sheet
        The file.
    axes_line : int
        The line that names the axes; that of the names stands above it.
    delimiter : bytes
        What stands between two cells.
    format : str
        The format of the layout.
    rate : float or None
        Frame rate in Hz, None where the header states none.

    Returns
    -------
    Layout
        Where the trajectories stand.

    Raises
    ------
    BadRecording
        If the trajectories are in several units, or in one that is not known.
    """
    axes, names = sheet.texts(axes_line, delimiter), sheet.texts(axes_line - 1, delimiter)
    starts = triples(axes, 0)
    names += [""] * (len(axes) - len(names))
    units = sheet.texts(axes_line + 1, delimiter)
    texts = [units[i] if i < len(units) and units[i][:1].isalpha() else "" for i in starts]
    unit, are_positions = unit_shared(sheet, texts)
    if starts[0] > 0:
        rows, warnings = frame_rows(sheet, axes_line + 1, delimiter, section=True)
    else:
        rows, warnings = plain_rows(sheet, axes_line + (2 if any(texts) else 1), delimiter), []
    time = next((i for i, axis in enumerate(axes[: starts[0]]) if axis.lower().startswith("time")), None)
    return Layout(
        format=format,
        delimiter=delimiter,
        rows=rows,
        names=tuple(names[i] for i in compress(starts, are_positions)),
        columns=consecutive(list(compress(starts, are_positions))),
        unit=unit,
        rate=rate,
        frame=0 if starts[0] > 0 and time != 0 else None,
        time=time,
        model_outputs=tuple(names[i] for i, own in zip(starts, are_positions, strict=True) if not own),
        decimal_comma=writes_decimal_comma(sheet, rows, delimiter),
        warnings=tuple(warnings),
    )
