"""Where the trajectories stand in a Vicon Nexus CSV: the section `Trajectories`, among others that are left alone."""

from __future__ import annotations

from collections.abc import Sequence

from markermend.core.recording import BadRecording
from markermend.formats.text.lines import Sheet, likeliest_delimiter
from markermend.formats.text.table_layout import (
    Layout,
    consecutive,
    frame_rows,
    plain_rows,
    rate_named,
    triples,
    unit_named,
    writes_decimal_comma,
)

HEADER_LINES = 8
"""How far below the section's title the line of axes is looked for."""


def section_line(sheet: Sheet) -> int | None:
    """The line that opens the section of trajectories, or None."""
    titled = (i for i, line in enumerate(sheet.lines) if line[:14].lstrip(b'"').lower().startswith(b"trajectories"))
    return next((i for i in titled if not sheet.lines[i].strip(b' \t\r,;"')[12:]), None)


def describe(sheet: Sheet) -> Layout:
    """Find the trajectories of a Nexus CSV.

    Raises BadRecording where the section or its header is not there.
    """
    title = section_line(sheet)
    if title is None:
        raise BadRecording(f"{sheet.name} has no section 'Trajectories': export the trajectories from Nexus")
    delimiter = likeliest_delimiter(sheet.lines[title + 1 : title + HEADER_LINES])
    rate_line = next(iter(sheet.filled(title + 1, delimiter)), title)
    rate = rate_named(sheet.texts(rate_line, delimiter)[0].partition(" ")[0])
    axes_line = find_axes(sheet, range(title + 1, title + HEADER_LINES), delimiter)
    if axes_line is None:
        raise BadRecording(f"{sheet.name}: its section 'Trajectories' has no line of axes X, Y, Z: export it again")
    return below_axes(sheet, axes_line, delimiter, "nexus", rate)


def find_axes(sheet: Sheet, lines: Sequence[int], delimiter: bytes) -> int | None:
    """The first of some lines that names the axes X, Y, Z side by side, or None."""
    return next((line for line in lines if triples(sheet.texts(line, delimiter), 0)), None)


def below_axes(sheet: Sheet, axes_line: int, delimiter: bytes, format: str, rate: float | None) -> Layout:
    """The layout of a table whose header is a line of names, one of axes, and perhaps one of units."""
    axes, names = sheet.texts(axes_line, delimiter), sheet.texts(axes_line - 1, delimiter)
    starts = triples(axes, 0)
    names += [""] * (len(axes) - len(names))
    units = sheet.texts(axes_line + 1, delimiter)
    stated = {unit_named(sheet, units[i]) for i in starts if i < len(units) and units[i][:1].isalpha()}
    if len(stated) > 1:
        raise BadRecording(f"{sheet.name}: its trajectories are in several units ({', '.join(sorted(stated))})")
    if starts[0] > 0:
        rows, warnings = frame_rows(sheet, axes_line + 1, delimiter, section=True)
    else:
        rows, warnings = plain_rows(sheet, axes_line + (2 if stated else 1), delimiter), []
    time = next((i for i, axis in enumerate(axes[: starts[0]]) if axis.lower().startswith("time")), None)
    return Layout(
        format=format,
        delimiter=delimiter,
        rows=rows,
        names=tuple(names[i] for i in starts),
        columns=consecutive(starts),
        unit=stated.pop() if stated else None,
        rate=rate,
        frame=0 if starts[0] > 0 and time != 0 else None,
        time=time,
        decimal_comma=writes_decimal_comma(sheet, rows, delimiter),
        warnings=tuple(warnings),
    )
