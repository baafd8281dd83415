"""Where the trajectories stand in a plain CSV or TSV: columns named by marker and axis, as `LASI_x`, `LASI (Y)`, `LASIz`."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import compress

from markermend.core.recording import BadRecording
from markermend.formats.text.axes_header import below_axes, find_axes
from markermend.formats.text.header_values import unit_shared
from markermend.formats.text.lines import Sheet, likeliest_delimiter
from markermend.formats.text.table_layout import Layout
from markermend.formats.text.table_rows import frame_rows, plain_rows, writes_decimal_comma

HEADER_LINES = 12
"""How many lines from the top the line that names the columns is looked for."""

LONGEST_TITLE = 300
"""Characters; a longer cell is no column's name."""

# Without brackets only metric units: "x_toe_in" is the x of a marker "toe_in".
_UNIT = r"(?:\s*[(\[](?P<unit>[a-zA-Z]+)[)\]]|_(?P<suffix>mm|cm|m))?"
_AXIS_LAST = re.compile(rf"(?P<name>.*?[^\s_.:/|-])[\s_.:/|-]+(?P<axis>[xyzXYZ]){_UNIT}")
_AXIS_IN_BRACKETS = re.compile(
    rf"(?P<name>.*?[^\s_.:/|-])[\s_.:/|-]*[(\[]\s*(?P<axis>[xyzXYZ])(?:[\s,;:_-]+(?P<inner>[a-zA-Z]+))?\s*[)\]]{_UNIT}"
)
_AXIS_FIRST = re.compile(rf"(?P<axis>[xyzXYZ])[\s_.:/|-]+(?P<name>.+?){_UNIT}")
# A single letter before the axis is a quantity (Fx, Vx) and no marker.
_AXIS_AT_END = re.compile(rf"(?P<name>.*[^\s_.:/|-].*[^\s_.:/|-])(?P<axis>[xyzXYZ]){_UNIT}")
_FRAME = re.compile(r"(frame|field|sample|index)s?[ _]?(#|no\.?|nr\.?|number|index)?", re.IGNORECASE)
_TIME = re.compile(
    r"(time|t|times|timestamp|time[ _]?stamp|seconds?)[ _]?[(\[]?(?P<unit>ms|s|sec|seconds)?[)\]]?", re.IGNORECASE
)


def describe(sheet: Sheet) -> Layout:
    """Find the trajectories of a CSV by its column names, in one line or in two (names above X, Y, Z).

    The rate comes from a time column or from the recordings table.

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
        If no line names columns by marker and axis, or the units of the trajectories differ.
    """
    for line in [line for line in sheet.filled(0, b"\t") if line < HEADER_LINES]:
        delimiter = likeliest_delimiter([sheet.lines[line]])
        if find_axes(sheet, [line], delimiter) is not None and line > 0:
            return below_axes(sheet, line, delimiter, "csv", None)
        titles = sheet.texts(line, delimiter)
        found = _trajectories(titles)
        if found:
            return _layout(sheet, line, delimiter, titles, found)
    raise BadRecording(
        f"{sheet.name} has no line that names columns by marker and axis (such as LASI_x, LASI_y, LASI_z): add one, or export"
        " the recording as C3D or TRC"
    )


def _trajectories(titles: Sequence[str]) -> dict[tuple[str, int], dict[str, tuple[int, str]]]:
    """Column and unit of each axis by marker; where no axis stands apart from the name, complete ones at its end count."""
    apart = _matching(titles, _AXIS_LAST, _AXIS_IN_BRACKETS, _AXIS_FIRST)
    if apart:
        return apart
    return {key: axes for key, axes in _matching(titles, _AXIS_AT_END).items() if len(axes) == 3}


def _matching(titles: Sequence[str], *patterns: re.Pattern[str]) -> dict[tuple[str, int], dict[str, tuple[int, str]]]:
    """What matches a pattern, if anything complete does; the second trajectory of the same name is one of its own."""
    short = {i: title for i, title in enumerate(titles) if len(title) <= LONGEST_TITLE}
    matches = {
        i: next((match for pattern in patterns if (match := pattern.fullmatch(title))), None)
        for i, title in short.items()
    }
    axes: dict[tuple[str, int], dict[str, tuple[int, str]]] = {}
    seen: dict[tuple[str, str], int] = {}
    for column, match in matches.items():
        if match:
            title = (match["name"].strip(), match["axis"].lower())
            repetition = seen[title] = seen.get(title, -1) + 1
            axes.setdefault((title[0], repetition), {})[title[1]] = (column, _unit(match))
    return axes if any(len(found) == 3 for found in axes.values()) else {}


def _unit(match: re.Match[str]) -> str:
    """The unit that a title states, or nothing."""
    return next((text for name in ("unit", "suffix", "inner") if (text := match.groupdict().get(name))), "")


def _layout(
    sheet: Sheet,
    line: int,
    delimiter: bytes,
    titles: Sequence[str],
    found: dict[tuple[str, int], dict[str, tuple[int, str]]],
) -> Layout:
    """The layout of a table below one line of titles."""
    complete = {key: axes for key, axes in found.items() if len(axes) == 3}
    stated = [next((unit for _, unit in axes.values() if unit), "") for axes in complete.values()]
    unit, are_positions = unit_shared(sheet, stated)
    positions = {key: complete[key] for key in compress(complete, are_positions)}
    frame, time, seconds = _counting_columns(titles)
    warnings = [
        f"Columns of '{name}' do not have all of x, y, z and are left alone."
        for (name, _), axes in found.items()
        if len(axes) < 3
    ]
    if 0 in (frame, time):
        rows, more = frame_rows(sheet, line + 1, delimiter, section=False)
        warnings += more
    else:
        rows = plain_rows(sheet, line + 1, delimiter)
    return Layout(
        format="csv",
        delimiter=delimiter,
        rows=rows,
        names=tuple(name for name, _ in positions),
        columns=tuple((axes["x"][0], axes["y"][0], axes["z"][0]) for axes in positions.values()),
        unit=unit,
        rate=None,
        frame=frame,
        time=time,
        seconds=seconds,
        model_outputs=tuple(key[0] for key in complete if key not in positions),
        decimal_comma=writes_decimal_comma(sheet, rows, delimiter),
        own_missing=True,
        warnings=tuple(warnings),
    )


def _counting_columns(titles: Sequence[str]) -> tuple[int | None, int | None, float]:
    """The columns of frame numbers and of times, None where there is none, and the unit of the times in s."""
    frame = next((i for i, title in enumerate(titles) if _FRAME.fullmatch(title) or (i == 0 and not title)), None)
    time, match = next(
        ((i, match) for i, title in enumerate(titles) if (match := _TIME.fullmatch(title))), (None, None)
    )
    return frame, time, 0.001 if match and (match["unit"] or "").lower() == "ms" else 1.0
