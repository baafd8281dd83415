"""Level shifts: a marker is displaced between two edges, or between an edge and a gap or an end of the recording."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.detection.neighbour.edges import Edge
from markermend.numerics import intervals
from markermend.options.detection import StepsOptions

MIN_BASELINE_RATIO = 3
"""At an end of the recording, the baseline lasts at least this many times as long as what is displaced."""


def shift_fraction(residual: np.ndarray, start: int, stop: int, jump: np.ndarray) -> float:
    """Measure by which part of a jump an interval is displaced as a whole.

    Parameters
    ----------
    residual : np.ndarray
        Residual (frames, 3), mm, NaN = missing.
    start, stop : int
        The interval, [start, stop).
    jump : np.ndarray
        The jump (3,), mm.

    Returns
    -------
    float
        Median inside less the median of as many samples outside, half on either side, along the jump, as a part of it.
    """
    reach = max(1, (stop - start) // 2)
    outside = np.concatenate([residual[max(start - reach, 0) : start], residual[stop : stop + reach]])
    shift = np.nanmedian(residual[start:stop], axis=0) - np.nanmedian(outside, axis=0)
    return float(shift @ jump / (jump @ jump))


def joint_score(first: Edge, second: Edge) -> float:
    """Measure two jumps together.

    Parameters
    ----------
    first, second : Edge
        The jumps.

    Returns
    -------
    float
        Root mean square of their scores.
    """
    return float(np.hypot(first.score, second.score) / np.sqrt(2))


@dataclass(frozen=True)
class LevelShiftFinder:
    """Finds the level shifts of a marker among its edges.

    Attributes
    ----------
    rate : float
        Sampling rate, Hz.
    options : StepsOptions
        Lengths and thresholds of a step and its two jumps, context, and attribution.
    """

    rate: float
    options: StepsOptions

    @property
    def shortest(self) -> int:
        """Shortest level shift, samples."""
        return intervals.samples(self.options.min_duration_s, self.rate)

    @property
    def longest(self) -> int:
        """Longest level shift, samples."""
        return intervals.samples(self.options.max_duration_s, self.rate)

    def between_edges(
        self, residual: np.ndarray, found_edges: Sequence[Edge], *, missing: np.ndarray, name: str
    ) -> list[Event]:
        """Pair opposite edges of one marker between which it is displaced.

        Pairs that exceed the threshold together are made first, then the shorter ones.

        Parameters
        ----------
        residual : np.ndarray
            Residual of the marker (frames, 3), mm, NaN = missing.
        found_edges : Sequence[Edge]
            Its edges by frame, those below the threshold included.
        missing : np.ndarray
            Frames in which it is not observed, bool (frames,): no level shift goes on across them. What an earlier
            detector claimed is not missing.
        name : str
            Name of the marker.

        Returns
        -------
        list[Event]
            The level shifts.
        """
        frames = np.array([edge.frame for edge in found_edges], int)
        gone = np.cumsum(missing)
        candidates = [
            (joint_score(found_edges[k], found_edges[j]) < 1, int(frames[j] - frames[k]), k, j)
            for k in range(len(frames))
            for j in range(k + 1, int(np.searchsorted(frames, frames[k] + self.longest, side="right")))
            if gone[frames[k]] == gone[frames[j]] and self._is_level_shift(residual, found_edges[k], found_edges[j])
        ]
        found, used = [], np.zeros(len(frames), bool)
        for _, _, k, j in sorted(candidates):
            if not used[k : j + 1].any():
                used[k : j + 1] = True
                jumps = np.array([found_edges[k].jump, found_edges[j].jump])
                score = joint_score(found_edges[k], found_edges[j]) / self.options.joint_jump_fraction
                found.append(Event(name, int(frames[k]), int(frames[j]), score, events.main_axes(jumps)))
        return found

    def truncated(
        self,
        residual: np.ndarray,
        found_edges: Sequence[Edge],
        others: Sequence[Event],
        *,
        missing: np.ndarray,
        name: str,
    ) -> list[Event]:
        """Find the level shifts of one marker with a gap or an end of the recording in place of one edge.

        Parameters
        ----------
        residual : np.ndarray
            Residual of the marker (frames, 3), mm, NaN = missing.
        found_edges : Sequence[Edge]
            Its edges by frame.
        others : Sequence[Event]
            What was found of all markers: nothing is found that touches an event of this marker, nor at an edge where an
            event of another one begins or ends, of which it may be the reflection.
        missing : np.ndarray
            Where the marker is not observed, or claimed by an earlier detector, bool (frames,).
        name : str
            Name of the marker.

        Returns
        -------
        list[Event]
            The level shifts, the shorter ones first.
        """
        reflected = {frame for other in others if other.marker != name for frame in (other.start, other.stop)}
        own = [other for other in others if other.marker == name]
        found: list[Event] = []
        for start, stop, edge in self._sides([edge for edge in found_edges if edge.frame not in reflected], missing):
            free = all(stop < other.start or other.stop < start for other in [*own, *found])
            if free and self._is_displaced(residual, (start, stop), edge, missing):
                found.append(Event(name, start, stop, edge.score, events.main_axes(edge.jump[None])))
        return found

    def _is_level_shift(self, residual: np.ndarray, first: Edge, second: Edge) -> bool:
        """Whether two jumps are opposite and of similar size, and the residual (frames, 3) is displaced in between."""
        options = self.options
        sizes = float(np.linalg.norm(first.jump)), float(np.linalg.norm(second.jump))
        opposite = -first.jump @ second.jump >= options.min_cosine * sizes[0] * sizes[1]
        balanced = min(sizes) >= options.min_jump_ratio * max(sizes)
        if second.frame - first.frame < self.shortest or not opposite or not balanced:
            return False
        mean, score = (first.jump - second.jump) / 2, joint_score(first, second)
        if score < options.joint_jump_fraction or np.linalg.norm(mean) < options.floor_mm:
            return False
        imbalance = np.linalg.norm(first.jump + second.jump)
        if score >= 1 and imbalance <= options.max_imbalance_fraction * np.linalg.norm(mean):
            return True
        fraction = options.min_shift_fraction if score >= 1 else options.weak_min_shift_fraction
        return shift_fraction(residual, first.frame, second.frame, mean) >= fraction

    def _sides(self, found_edges: Sequence[Edge], missing: np.ndarray) -> list[tuple[int, int, Edge]]:
        """The intervals between edges and the nearest missing frame or end on either side, the shortest first."""
        holes = np.flatnonzero(np.concatenate([[True], missing, [True]])) - 1
        candidates: list[tuple[int, int, Edge]] = []
        for edge in found_edges:
            k = int(np.searchsorted(holes, edge.frame))
            sides = (int(holes[k - 1]) + 1, edge.frame), (edge.frame, int(holes[k]))
            candidates += [(*side, edge) for side in sides if self.shortest <= side[1] - side[0] <= self.longest]
        return sorted(candidates, key=lambda candidate: (candidate[1] - candidate[0], candidate[0]))

    def _is_displaced(self, residual: np.ndarray, interval: tuple[int, int], edge: Edge, missing: np.ndarray) -> bool:
        """Whether an interval with an edge at one border is displaced against what lies beyond the edge and the gap.

        Where nothing lies beyond, the edge must be stronger, and all of the interval displaced against a longer baseline.
        """
        start, stop = interval
        jump = edge.jump if edge.frame == start else -edge.jump
        seen = np.flatnonzero(~missing)
        before, after = seen[seen < start], seen[seen >= stop]
        reaches = [intervals.samples(self.options.level_window_s, self.rate)]
        if not (len(before) and len(after)):
            baseline = MIN_BASELINE_RATIO * (stop - start)
            if edge.score < self.options.recording_end_factor or len(before) + len(after) < baseline:
                return False
            reaches.append(baseline)
        return all(
            _differ(residual[own], residual[beyond], jump, self.options.truncated_min_shift_fraction)
            for reach in reaches
            for own, beyond in (
                (slice(start, min(start + reach, stop)), before[-reach:]),
                (slice(max(stop - reach, start), stop), after[:reach]),
            )
            if len(beyond)
        )


def _differ(inside: np.ndarray, outside: np.ndarray, jump: np.ndarray, fraction: float) -> bool:
    """Whether the medians of residuals (n, 3) differ by this part of a jump (3,) at least; False where nothing is known."""
    if np.isnan(inside).all() or np.isnan(outside).all():
        return False
    shift = np.nanmedian(inside, axis=0) - np.nanmedian(outside, axis=0)
    return bool(shift @ jump >= fraction * (jump @ jump))
