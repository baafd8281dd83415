"""Where the trajectories stand in a TRC file (Motion Analysis, OpenSim), and how to write a new one."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from markermend.core.recording import BadRecording, Recording
from markermend.formats.text.axes_header import consecutive
from markermend.formats.text.header_values import count_named, rate_named, unit_named
from markermend.formats.text.lines import Sheet, is_number, likeliest_delimiter
from markermend.formats.text.table_layout import Layout
from markermend.formats.text.table_rows import frame_rows, row_widths, writes_decimal_comma
from markermend.formats.text.trc_labels import labelled_columns
from markermend.formats.units import MILLIMETRES
from markermend.storage.atomic import write_text

HEADER_LINES = 5
"""How many lines from the top the line that names the header's fields is looked for."""

DECIMALS = {"mm": 5, "cm": 6, "m": 8}
"""Decimals that a new file is written with: a hundred times finer than any system measures."""


def describe(sheet: Sheet) -> Layout:
    """Find the trajectories of a TRC file by its rows and labels, whatever numbers its header states.

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
        If the header is cut off, or the labels cannot be matched with the columns.
    """
    fields = next((i for i, line in enumerate(sheet.lines[:HEADER_LINES]) if b"DataRate" in line), None)
    if fields is None:
        raise BadRecording(f"{sheet.name} is no TRC file: its first lines do not name DataRate. Export it again")
    delimiter = likeliest_delimiter(sheet.lines[fields : fields + 1])
    header = _header(sheet.texts(fields, delimiter), sheet.texts(fields + 1, delimiter))
    title = next(iter(sheet.filled(fields + 2, delimiter)), len(sheet.lines))
    labels = sheet.texts(title, delimiter)
    if not labels or not labels[0].lower().startswith("frame"):
        raise BadRecording(f"{sheet.name}: the header of this TRC file is cut off before the labels. Export it again")
    rows, warnings = frame_rows(sheet, title + 1, delimiter, section=False)
    widths = row_widths(sheet, rows, delimiter)
    promised = header.get("NumMarkers", "")
    own = labelled_columns(sheet.name, labels, width=max(widths, default=0), promised=count_named(promised))
    return Layout(
        format="trc",
        delimiter=delimiter,
        rows=rows,
        names=own.names,
        columns=consecutive(own.starts),
        # A number is that of the next field: no unit stands between the delimiters.
        unit=unit_named(sheet, stated) if (stated := header.get("Units", "")) and not is_number(stated) else None,
        rate=rate_named(header.get("DataRate", "")),
        time=1 if own.first == 2 else None,
        frames=count_named(header.get("NumFrames", "")),
        decimal_comma=writes_decimal_comma(sheet, rows, delimiter),
        warnings=(*warnings, *own.warnings, *_count_warnings(promised, own.starts, widths)),
    )


def _header(fields: Sequence[str], values: Sequence[str]) -> dict[str, str]:
    """The values of the header by field: in order where several delimiters stand between them, as OpenSim reads them."""
    names, filled = [field for field in fields if field], [value for value in values if value]
    in_order = len(filled) == len(names) or len(values) > len(fields)
    return dict(zip(names, filled, strict=False) if in_order else zip(fields, values, strict=False))


def _count_warnings(promised: str, starts: Sequence[int], widths: Sequence[int]) -> list[str]:
    """Say where the number of markers in the header, that of the labels and the width of the rows differ."""
    warnings = []
    if count_named(promised) != len(starts):
        warnings.append(
            f"The header says {promised[:20] or 'no'} markers and {len(starts)} are labelled: the labels are used."
        )
    wider = sum(width > starts[-1] + 3 for width in widths)
    if wider:
        warnings.append(f"{wider} rows have cells beyond the last labelled marker, which are left alone.")
    return warnings


def write_new(path: Path, *, recording: Recording, unit: str = "mm") -> None:
    """Write a TRC file that OpenSim opens: tabs, missing samples blank, exact counts, a blank line above the data.

    Rows end in a tab, without which OpenSim does not count a blank last cell. Times start at zero. A recording without frames or markers gives a file without them.

    Parameters
    ----------
    path : Path
        Where it goes.
    recording : Recording
        Positions in mm; NaN = missing.
    unit : str
        Unit of the file: mm, cm or m.
    """
    decimals = DECIMALS[unit]
    count = len(recording.markers)
    rate = f"{recording.rate:.10g}"
    fields = (rate, rate, recording.frames, count, unit, rate, recording.first_frame, recording.frames)
    lines = [
        f"PathFileType\t4\t(X/Y/Z)\t{path.name}",
        "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames",
        "\t".join(map(str, fields)),
        "Frame#\tTime" + "".join(f"\t{marker}\t\t" for marker in recording.markers),
        "\t" + "".join(f"\tX{i}\tY{i}\tZ{i}" for i in range(1, count + 1)),
        "",
    ]
    positions = (recording.positions / MILLIMETRES[unit]).reshape(recording.frames, 3 * count)
    missing = np.repeat(recording.missing, 3, axis=1).tolist()
    for row, (cells, blank) in enumerate(zip(positions.tolist(), missing, strict=True)):
        written = ["" if void else f"{cell:.{decimals}f}" for cell, void in zip(cells, blank, strict=True)]
        lines.append("\t".join([str(recording.first_frame + row), f"{row / recording.rate:.6f}", *written, ""]))
    write_text(path, "\n".join(lines) + "\n")
