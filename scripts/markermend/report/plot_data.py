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
"""Resolution of a plot; far finer than visible, so it is no option."""


def excerpt(finding: Change, before: Recording, after: Restored, *, context_s: float, frames: int) -> dict[str, Any]:
    """Extract the trajectories around a finding, before and after.

    Parameters
    ----------
    finding : Change
        The finding.
    before, after : Recording
        The recording as ingested and as cleaned.
    context_s : float
        How much to show on either side, in s.
    frames : int
        The most frames to show; a longer window shows every second, third, ... of its frames.

    Returns
    -------
    dict of str to Any
        JSON values: `first` and `step` (capture program's numbers), `frames`, `span` (the finding, half-open, same
        numbers), `rate`, `origin` (number of row 0), `before`, `after` (runs of changed samples with one unchanged
        neighbour on either side; after x, y, z come the radii that hold the truth with probability 0.68 and 0.95), and
        `partner` (the other marker of an exchange of labels, or the unlabelled trajectory).
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
    elif finding.partner is not None and finding.partner in before.unlabelled:
        track = before.unlabelled[finding.partner][window]
        cut["partner"] = series(track, ~np.isnan(track).any(axis=1))
    return cut


def series(values: np.ndarray, where: np.ndarray, units_per_mm: int = UNITS_PER_MM) -> list[list[Any]]:
    """Write some rows of values.

    Parameters
    ----------
    values : ndarray of float, shape (frames, columns)
        In mm.
    where : ndarray of bool, shape (frames,)
        The rows to write.
    units_per_mm : int, optional
        Resolution.

    Returns
    -------
    list of list of Any
        One list per run of rows: offset, and the differences of each column.
    """
    return [[start, *(delta(column, units_per_mm) for column in values[start:stop].T)] for start, stop in runs(where)]


def delta(values: np.ndarray, units_per_mm: int = UNITS_PER_MM) -> list[int]:
    """Write numbers as differences of whole units.

    Parameters
    ----------
    values : ndarray of float
        In mm; no value may be NaN.
    units_per_mm : int, optional
        Resolution.

    Returns
    -------
    list of int
        The first, and each less the one before.
    """
    units = np.rint(values * units_per_mm).astype(np.int64)
    differences: list[int] = np.diff(units, prepend=0).tolist()
    return differences


def _result(before: Recording, after: Restored, window: slice, m: int) -> list[list[Any]]:
    """The changed samples of one marker in a window, joined to their neighbours, with their expected errors."""
    position = after.positions[window, m]
    differs = _one(before, after, window, m)
    adjacent = np.zeros_like(differs)
    adjacent[1:] |= differs[:-1]
    adjacent[:-1] |= differs[1:]
    where = (differs | adjacent) & ~np.isnan(position).any(axis=1)
    errors = np.nan_to_num(np.column_stack((after.error[window, m], after.error95[window, m])))
    return series(np.column_stack((position, errors)), where)


def _one(before: Recording, after: Restored, window: slice, m: int) -> np.ndarray:
    """Where one marker was changed within a window."""

    def part(recording: Recording) -> Recording:
        return Recording((recording.markers[m],), recording.positions[window, [m]], recording.rate)

    return changed(part(before), part(after))[:, 0]
