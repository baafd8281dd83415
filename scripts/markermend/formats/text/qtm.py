"""Where the trajectories stand in a Qualisys (QTM) TSV: a header of keys and values, then one column per axis."""

from __future__ import annotations

from collections.abc import Sequence

from markermend.core.recording import BadRecording
from markermend.formats.text.axes_header import consecutive
from markermend.formats.text.header_values import count_named, rate_named
from markermend.formats.text.lines import Sheet, is_number
from markermend.formats.text.table_layout import Layout
from markermend.formats.text.table_rows import SAMPLE_LINES, frame_rows, plain_rows, writes_decimal_comma

DELIMITER = b"\t"


def describe(sheet: Sheet) -> Layout:
    """Find the trajectories of a QTM TSV, with or without a line of column titles, a frame and a time column.

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
        If the file holds other data than 3-D trajectories, or its header is cut off.
    """
    header, after = _header(sheet)
    included = header.get("DATA_INCLUDED", ["3D"])[0]
    if included != "3D" or "MARKER_NAMES" not in header:
        raise BadRecording(f"{sheet.name} holds no 3-D trajectories (DATA_INCLUDED {included}): export the 3D data")
    names = header["MARKER_NAMES"]
    promised = count_named(header.get("NO_OF_MARKERS", [""])[0])
    while names and not names[-1] and len(names) != promised:
        names = names[:-1]
    titles = [title.lower() for title in sheet.texts(after, DELIMITER)]
    titled = titles[:1] in (["frame"], ["time"]) or any(title.endswith(" x") for title in titles)
    start = after + 1 if titled else after
    leading = [title for title in titles[:2] if title in ("frame", "time")] if titled else _leading(sheet, start, names)
    warnings = []
    if promised is not None and promised != len(names):
        warnings.append(f"The header says {promised} markers and names {len(names)}: the names are used.")
    if leading:
        rows, more = frame_rows(sheet, start, DELIMITER, section=False)
        warnings += more
    else:
        rows = plain_rows(sheet, start, DELIMITER)
    return Layout(
        format="qtm",
        delimiter=DELIMITER,
        rows=rows,
        names=tuple(names),
        columns=consecutive([len(leading) + 3 * i for i in range(len(names))]),
        unit="mm",
        rate=rate_named(header.get("FREQUENCY", [""])[0]),
        frame=leading.index("frame") if "frame" in leading else None,
        time=leading.index("time") if "time" in leading else None,
        frames=count_named(header.get("NO_OF_FRAMES", [""])[0]),
        decimal_comma=writes_decimal_comma(sheet, rows, DELIMITER),
        own_missing=True,
        warnings=tuple(warnings),
    )


def _header(sheet: Sheet) -> tuple[dict[str, list[str]], int]:
    """The values of each key (an event's keys repeat: the first counts), and the line after the last key."""
    header: dict[str, list[str]] = {}
    for line in range(len(sheet.lines)):
        cells = sheet.texts(line, DELIMITER)
        if not (cells[0].isupper() and cells[0].replace("_", "").isalnum() and len(cells) > 1):
            return header, line
        header.setdefault(cells[0], cells[1:])
    return header, len(sheet.lines)


def _leading(sheet: Sheet, start: int, names: Sequence[str]) -> list[str]:
    """The columns before the trajectories in a table without titles: a frame and a time column, or nothing.

    They are present if the rows have two cells more than the trajectories need and the first cells count up by one.
    """
    rows = [sheet.texts(line, DELIMITER) for line in plain_rows(sheet, start, DELIMITER)[:SAMPLE_LINES]]
    wide = bool(rows) and all(len(row) >= 3 * len(names) + 2 and is_number(row[0]) for row in rows)
    numbers = [float(row[0].replace(",", ".")) for row in rows] if wide else []
    counted = wide and all(number == numbers[0] + i for i, number in enumerate(numbers))
    return ["frame", "time"] if counted else []
