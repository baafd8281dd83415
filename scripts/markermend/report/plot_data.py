"""What a plot of one finding shows: the trajectories around it, written as compactly as JSON allows.

A series is a list of runs `[offset, x, y, z, ...]`: offset counts the plotted frames from the start of the window, and
the rest are whole numbers in hundredths of a mm, each the difference from the one before.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from markermend.core.changes import Change
from markermend.core.recording import Recording, Restored, changed
from markermend.numerics.intervals import runs

UNITS_PER_MM = 100
"""Resolution of a plot; far below what one can see, so no tunable."""


def excerpt(finding: Change, before: Recording, after: Restored, *, context_s: float, frames: int) -> dict[str, Any]:
    """Cut out what surrounds a finding, before and after, as JSON values.

    context_s: how much to show on either side, s. frames: most frames to show; a longer window shows every second,
    third, ... of its frames. Keys: `first` and `step` (capture program's numbers), `frames`, `span` (the finding,
    half-open, same numbers), `rate`, `origin` (number of row 0), `before`, `after` (runs of changed samples with one
    unchanged neighbour on either side; after x, y, z come the radii that hold the truth with probability 0.68 and
    0.95), `partner` (the other marker of a swap).
    """
    context = round(context_s * before.rate)
    first, stop = max(0, finding.start - context), min(before.frames, finding.stop + context)
    step = max(1, -(-(stop - first) // frames))
    window = slice(first, stop, step)
    m = before.markers.index(finding.marker)
    number = before.first_frame
    cut = {
        "first": number + first,
        "step": step,
        "frames": len(range(first, stop, step)),
        "span": [number + finding.start, number + finding.stop],
        "rate": before.rate,
        "origin": number,
        "before": series(before.positions[window, m], ~before.missing[window, m]),
        "after": _result(before, after, window, m),
    }
    if finding.partner in before.markers:
        p = before.markers.index(finding.partner)
        cut["partner"] = series(before.positions[window, p], ~before.missing[window, p])
    return cut


def series(values: np.ndarray, where: np.ndarray) -> list[list[Any]]:
    """Write the rows of values (frames, columns), in mm, at which `where` holds."""
    return [[start, *(delta(column) for column in values[start:stop].T)] for start, stop in runs(where)]


def delta(values: np.ndarray) -> list[int]:
    """Write numbers in mm as hundredths, each the difference from the one before. No value may be NaN."""
    hundredths = np.rint(values * UNITS_PER_MM).astype(np.int64)
    differences: list[int] = np.diff(hundredths, prepend=0).tolist()
    return differences


def _result(before: Recording, after: Restored, window: slice, m: int) -> list[list[Any]]:
    """The changed samples of one marker in a window, joined to their neighbours, with their expected errors."""
    position = after.positions[window, m]
    touched = _one(before, after, window, m)
    beside = np.zeros_like(touched)
    beside[1:] |= touched[:-1]
    beside[:-1] |= touched[1:]
    where = (touched | beside) & ~np.isnan(position).any(axis=1)
    errors = np.nan_to_num(np.column_stack((after.error[window, m], after.error95[window, m])))
    return series(np.column_stack((position, errors)), where)


def _one(before: Recording, after: Restored, window: slice, m: int) -> np.ndarray:
    """Where one marker was changed within a window."""

    def part(recording: Recording) -> Recording:
        return Recording((recording.markers[m],), recording.positions[window, [m]], recording.rate)

    return changed(part(before), part(after))[:, 0]
