"""When the rows of a text file were captured: the frame rate and the number of the first frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.core.recording import BadRecording
from markermend.formats.text.cells import parse
from markermend.formats.text.lines import Sheet
from markermend.formats.text.table_layout import Layout

TOLERANCE = 0.01
"""Rates that differ by no more than this share are the same rate."""

SLOWEST = 1.0
"""Hz; times that give a rate no higher than this are milliseconds."""

ROUNDING = 0.002
"""A rate from rounded times that differs from a whole number by less than this share is that number."""

LEAP = 2.5
"""Steps between times that are at least this many times the median are leaps; shorter ones may be due to rounding."""

EVEN = 0.5
"""Frames; times are evenly spaced where no step between them differs from the mean by more."""

SHORTEST = 1e-9
"""s; no system captures frames at shorter intervals."""

LARGEST_FRAME = 2**53
"""Beyond this, floating point numbers do not distinguish neighbouring integers."""


@dataclass(frozen=True)
class Timing:
    """When the rows of a file were captured.

    Attributes
    ----------
    rate : float
        Frame rate in Hz.
    first_frame : int
        The capture program's number of row 0.
    warnings : tuple of str
        One sentence each.
    """

    rate: float
    first_frame: int
    warnings: tuple[str, ...]


def clock(sheet: Sheet, layout: Layout, rate: float | None) -> Timing:
    """Determine the rate and the first frame of a file.

    Evenly spaced times in seconds take precedence over the header where the two part by more than a frame in the course
    of the recording, more than the rounding of times can explain; otherwise the header takes precedence over the times.

    Parameters
    ----------
    sheet : Sheet
        The file.
    layout : Layout
        Where its frame numbers and times stand.
    rate : float or None
        Frame rate in Hz of the recordings table, which takes precedence; None = not given.

    Returns
    -------
    Timing
        Rate, first frame, and what is odd about them.

    Raises
    ------
    BadRecording
        If no source gives a finite rate above zero.
    """
    columns = [column for column in (layout.frame, layout.time) if column is not None]
    numbers = dict(zip(columns, parse(sheet, layout, columns)[0].T, strict=True)) if columns else {}
    first, warnings = _frames(numbers[layout.frame] if layout.frame is not None else None)
    times = numbers[layout.time] * layout.seconds if layout.time is not None else np.empty(0)
    timed, uneven = _rate_of_times(times)
    warnings += uneven
    stated = layout.rate
    if rate is None and stated is None and timed is not None and timed <= SLOWEST:
        timed *= 1000
        warnings.append("By the size of its numbers, the time column is in milliseconds.")
    if rate is None and stated is not None and timed is not None and _contradict(times, timed, stated):
        warnings.append(
            f"The header says {stated:.6g} Hz, but the times are evenly spaced at {timed:.6g} Hz, which is used."
        )
        stated = None
    chosen = next((value for value in (rate, stated, timed) if value is not None), None)
    if chosen is None or not 0 < chosen < float("inf"):
        raise BadRecording(f"{sheet.name} gives no usable frame rate: give its `rate` in the recordings table")
    for value, source in ((stated, "header"), (timed, "time column")):
        if value is not None and abs(value - chosen) > TOLERANCE * chosen:
            warnings.append(f"The {source} says {value:.6g} Hz; {chosen:.6g} Hz is used.")
    return Timing(float(chosen), first, tuple(warnings))


def _contradict(times: np.ndarray, timed: float, stated: float) -> bool:
    """True where evenly spaced times (s) of one rate cannot be those of another, stated one."""
    steps = np.diff(times) * timed
    even = timed > SLOWEST and bool((np.abs(steps - 1) <= EVEN).all())
    parted = abs(len(steps) * (timed / stated - 1))
    return even and abs(timed - stated) > TOLERANCE * timed and parted > 1


def _frames(numbers: np.ndarray | None) -> tuple[int, list[str]]:
    """The number of the first frame, 1 if unknown, and what is odd about the numbers."""
    if numbers is None:
        return 1, []
    first = numbers[0]
    if not abs(first) < LARGEST_FRAME or first != round(first):
        return 1, ["The first row has no whole frame number: frames are counted from 1."]
    steps = np.diff(numbers)
    odd = np.flatnonzero(~(steps == 1))
    if not odd.size:
        return int(first), []
    kinds = [
        (f"{int((steps == 0).sum())} repeat", (steps == 0).any()),
        (f"{int((steps < 0).sum())} go back", (steps < 0).any()),
        (f"{int((steps > 1).sum())} leap", (steps > 1).any()),
        (f"{int(np.isnan(numbers).sum())} are no numbers", np.isnan(numbers).any()),
    ]
    found = ", ".join(text for text, present in kinds if present) or "some are not whole"
    return int(first), [
        f"Frame numbers do not count up by one ({found}; first in row {odd[0] + 2}): rows are counted instead."
    ]


def _rate_of_times(times: np.ndarray) -> tuple[float | None, list[str]]:
    """The rate (Hz) at which times (s) count up, or None where they do not, and what is odd about them."""
    steps = np.diff(times)
    steps = steps[np.isfinite(steps)]
    step = float(np.median(steps)) if steps.size else 0.0
    if not 0 < step < float("inf"):
        return None, []
    even = (steps >= 0) & (steps < LEAP * step)
    rate = 1 / max(float(steps[even].mean()), SHORTEST)
    rate = float(round(rate)) if abs(rate - round(rate)) < ROUNDING * rate else rate
    return rate, [] if even.all() else [f"{int((~even).sum())} times leap or go back: rows are taken as evenly spaced."]
