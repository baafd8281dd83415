"""Where the trajectories stand in a Motive (OptiTrack) CSV: columns of type `Marker`, among solved bodies and bones.

Positions that Motive solves from a rigid body or a skeleton are not measured; they are left alone as model outputs.
"""

from __future__ import annotations

from markermend.core.recording import BadRecording
from markermend.formats.text.axes_header import consecutive, triples
from markermend.formats.text.header_values import count_named, rate_named, unit_named
from markermend.formats.text.lines import Sheet, likeliest_delimiter
from markermend.formats.text.table_layout import Layout
from markermend.formats.text.table_rows import frame_rows, writes_decimal_comma

HEADER_LINES = 15
"""How many lines from the top the line `Frame, Time, X, Y, Z` is looked for."""

SCREEN = ("+X", "+Y")
"""Motive's axes: y is up."""

UNLABELLED = ("unlabeled", "unlabelled")
"""What Motive writes before the colon and the number of an unlabelled trajectory."""


def describe(sheet: Sheet) -> Layout:
    """Find the measured markers of a Motive CSV.

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
        If the header is cut off, or no column holds a measured marker.
    """
    delimiter = likeliest_delimiter(sheet.lines[:1])
    cells = sheet.texts(0, delimiter)
    header = dict(zip(cells[::2], cells[1::2], strict=False))
    lines = [line for line in sheet.filled(1, delimiter) if line < HEADER_LINES]
    titles = [line for line in lines if sheet.texts(line, delimiter)[0].lower() == "frame"]
    above = [line for line in lines if titles and line < titles[0]]
    if len(above) < 3:
        raise BadRecording(f"{sheet.name}: the header of this Motive file is incomplete: export it with header lines")
    axes, kinds, names, measures = (sheet.texts(i, delimiter) for i in (titles[0], above[0], above[1], above[-1]))
    width = min(len(axes), len(kinds), len(names), len(measures))
    starts = [
        i
        for i in triples(axes[:width], 0)
        if kinds[i] == "Marker" and measures[i : i + 3] == ["Position"] * 3 and len(set(names[i : i + 3])) == 1
    ]
    if not starts:
        raise BadRecording(
            f"{sheet.name}: no column holds a measured marker (type 'Marker'): export the markers from Motive"
        )
    rows, warnings = frame_rows(sheet, titles[0] + 1, delimiter, section=False)
    solved = {name: None for name, kind in zip(names[2:], kinds[2:], strict=False) if kind not in ("Marker", "")}
    return Layout(
        format="motive",
        delimiter=delimiter,
        rows=rows,
        names=tuple(names[i] for i in starts),
        columns=consecutive(starts),
        unit=unit_named(sheet, header["Length Units"]) if header.get("Length Units") else None,
        rate=rate_named(header.get("Export Frame Rate", header.get("Capture Frame Rate", ""))),
        time=1 if axes[1].lower().startswith("time") else None,
        unlabelled=frozenset(k for k, i in enumerate(starts) if names[i].rpartition(":")[0].lower() in UNLABELLED),
        model_outputs=tuple(solved),
        frames=count_named(header.get("Total Exported Frames", "")),
        decimal_comma=writes_decimal_comma(sheet, rows, delimiter),
        own_missing=True,
        screen=SCREEN,
        warnings=tuple(warnings),
    )
