"""A recording as a 3-D stick figure, before and after: a bounded number of its poses, and the lines of its mesh.

The page holds every nth pose of the recording, and more around each finding, worst first, until the bound is reached. A series is
written as in `plot_data`, in whole mm.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from markermend.core.changes import Change
from markermend.core.mesh import Mesh, Segment
from markermend.core.recording import Recording, Restored, changed
from markermend.numerics.graphs import spanning_tree
from markermend.numerics.intervals import runs
from markermend.report.plot_data import series

POSITIONS = 30_000
"""Positions of markers (poses times markers) that a page holds, at most: about 300 kB."""

REGULAR_POSITIONS = 10_000
"""Of these, positions in poses at regular distances."""

WINDOW_POSES = 25
"""Poses around one finding, at most."""

UNITS_PER_MM = 1
"""Resolution; a figure is some hundred pixels high."""

FULLY_CONNECTED = 4
"""Markers of a segment of which all are connected, at most; of more, those of a minimum spanning tree."""


def stick_figure(
    before: Recording, after: Restored, mesh: Mesh, findings: Iterable[Change], *, context_s: float
) -> dict[str, Any]:
    """Make the figure of a recording.

    Parameters
    ----------
    before, after : Recording
        The recording as ingested and as cleaned.
    mesh : Mesh
        The subject's mesh, for this recording.
    findings : iterable of Change
        The findings, worst first.
    context_s : float
        Time on either side of a finding that its window shows, s.

    Returns
    -------
    dict of str to Any
        JSON values: `markers`; `frames` (capture program's numbers, each less the one before) and `regular` (every how many frames one is
        shown in any case); `rate` and `origin` (number of row 0); `edges` (pairs of indices of markers); `up` (the axis along which the
        markers extend most); `before` and `after`, for each marker the runs of its positions (offsets count `frames`; `after` has changed
        samples alone); `taken`, for each marker the runs of samples that were taken away, `[start, stop]`.
    """
    step, rows = chosen_rows(before, findings, context_s=context_s)
    differs = changed(before, after)[rows]
    seen, result = ~before.missing[rows], differs & ~after.missing[rows]
    columns = range(len(before.markers))
    return {
        "markers": list(before.markers),
        "frames": np.diff(np.array(rows, int) + before.first_frame, prepend=0).tolist(),
        "regular": step,
        "rate": before.rate,
        "origin": before.first_frame,
        "edges": edges(before, mesh),
        "up": upward_axis(before.positions[::step]),
        "before": [series(before.positions[rows, m], seen[:, m], UNITS_PER_MM) for m in columns],
        "after": [series(after.positions[rows, m], result[:, m], UNITS_PER_MM) for m in columns],
        "taken": [[list(run) for run in runs(differs[:, m] & ~result[:, m])] for m in columns],
    }


def chosen_rows(recording: Recording, findings: Iterable[Change], *, context_s: float) -> tuple[int, list[int]]:
    """Choose the poses that a figure holds.

    Parameters
    ----------
    recording : Recording
        The recording.
    findings : iterable of Change
        The findings, worst first.
    context_s : float
        Time on either side of a finding, s.

    Returns
    -------
    step : int
        Every how many rows a pose is chosen in any case.
    rows : list of int
        The rows, sorted: those, the middle of each finding, and then more around each, as far as the bound allows.
    """
    markers = max(1, len(recording.markers))
    step = max(1, -(-recording.frames * markers // REGULAR_POSITIONS))
    chosen = set(range(0, recording.frames, step))
    found, context = list(findings), round(context_s * recording.rate)
    windows = [window(finding, recording.frames, context) for finding in found]
    for more in ([(finding.start + finding.stop - 1) // 2] for finding in found), windows:
        for rows in more:
            if len(chosen.union(rows)) * markers <= POSITIONS:
                chosen.update(rows)
    return step, sorted(chosen)


def window(finding: Change, frames: int, context: int) -> list[int]:
    """Choose the poses around one finding.

    Parameters
    ----------
    finding : Change
        The finding.
    frames : int
        Frames of the recording.
    context : int
        Frames on either side, at most.

    Returns
    -------
    list of int
        Rows at equal distances, WINDOW_POSES at most.
    """
    first, stop = max(0, finding.start - context), min(frames, finding.stop + context)
    return list(range(first, stop, max(1, -(-(stop - first) // WINDOW_POSES))))


def edges(recording: Recording, mesh: Mesh) -> list[tuple[int, int]]:
    """Draw the mesh as lines between markers.

    Parameters
    ----------
    recording : Recording
        The recording.
    mesh : Mesh
        Its mesh.

    Returns
    -------
    list of tuple of int
        Pairs of indices of markers: within each segment, and from the marker nearest to its parent segment to the marker that it
        is attached to.
    """
    place = {marker: m for m, marker in enumerate(recording.markers)}
    drawn: dict[tuple[int, int], None] = {}
    for segment in mesh.segments:
        own = [place[marker] for marker in segment.markers if marker in place]
        pairs = [(own[a], own[b]) for a, b in _within(recording, own)]
        drawn.update(
            dict.fromkeys([*pairs, *_attachment(recording, segment, own, place.get(segment.parent_marker or ""))])
        )
    return list(drawn)


def _within(recording: Recording, own: Sequence[int]) -> list[tuple[int, int]]:
    """The lines within a segment, between places in the list of its markers."""
    count = len(own)
    if count <= FULLY_CONNECTED:
        return [(a, b) for a in range(count) for b in range(a + 1, count)]
    costs = np.full((count, count), np.inf)
    for a in range(count):
        for b in range(a):
            costs[a, b] = costs[b, a] = _distance(recording, own[a], own[b])
    return spanning_tree(costs)


def _attachment(
    recording: Recording, segment: Segment, own: Sequence[int], attached: int | None
) -> list[tuple[int, int]]:
    """The line from a segment to the marker of its parent that it is attached to, where there is one."""
    if segment.parent is None or attached is None or not own:
        return []
    return [(attached, min(own, key=lambda m: (_distance(recording, m, attached), m)))]


def _distance(recording: Recording, one: int, other: int) -> float:
    """Median distance of two markers, mm; large where they are never seen together."""
    apart = np.linalg.norm(recording.positions[:, one] - recording.positions[:, other], axis=1)
    seen = apart[~np.isnan(apart)]
    return float(np.median(seen)) if len(seen) else 1e6


def upward_axis(positions: np.ndarray) -> str:
    """Guess the vertical axis.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        Trajectories, mm; NaN = missing.

    Returns
    -------
    str
        The axis, x, y or z, along which the markers of most poses extend furthest; z where nothing is seen.
    """
    present = ~np.isnan(positions).any(axis=2)
    poses = positions[present.any(axis=1)]
    if not len(poses):
        return "z"
    extent = np.nanmax(poses, axis=1) - np.nanmin(poses, axis=1)
    return "xyz"[2 - int(np.argmax(np.median(extent, axis=0)[::-1]))]
