"""Where the trajectories stand in a Vicon Nexus CSV: the section `Trajectories`, among others that are left alone."""

from __future__ import annotations

from markermend.core.recording import BadRecording
from markermend.formats.text.axes_header import below_axes, find_axes
from markermend.formats.text.header_values import rate_named
from markermend.formats.text.lines import Sheet, likeliest_delimiter
from markermend.formats.text.table_layout import Layout

HEADER_LINES = 8
"""How many lines below the section's title the line of axes is looked for."""


def section_line(sheet: Sheet) -> int | None:
    """Find the line that opens the section of trajectories.

    Parameters
    ----------
    sheet : Sheet
        The file.

    Returns
    -------
    int or None
        Its number, or None.
    """
    titled = (i for i, line in enumerate(sheet.lines) if line[:14].lstrip(b'"').lower().startswith(b"trajectories"))
    return next((i for i in titled if not sheet.lines[i].strip(b' \t\r,;"')[12:]), None)


def describe(sheet: Sheet) -> Layout:
    """Find the trajectories of a Nexus CSV.

    Parameters
    ----------
    sheet : Sheet
        The file.

    Returns
    -------
    Layout
        Where the trajectories stand.

    Raises
    ------
    BadRecording
        If the section or its header is missing.
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
