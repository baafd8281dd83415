"""Edges: from one frame to the next a marker jumps, and its smooth trajectory goes on displaced."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from markermend.detection.neighbour import residual_windows
from markermend.detection.neighbour.residual_windows import ResidualStatistics, WindowFilters
from markermend.numerics.intervals import runs
from markermend.numerics.window_covariance import WindowCovariance
from markermend.options.detection.steps import StepsOptions

MIN_CONTEXT = 5
"""Samples of context on either side, at least: they estimate the noise scale."""

MIN_GAP_DISTANCE = 2
"""Samples between an edge and a gap, at least: with a single one an edge and a peak are the same."""


@dataclass(frozen=True)
class Edge:
    """A jump of a marker.

    Attributes
    ----------
    frame : int
        The first frame after it.
    jump : np.ndarray
        Its size (3,), mm.
    score : float
        Its size in units of the threshold.
    ramp : int
        Samples on the way between the two levels.
    """

    frame: int
    jump: np.ndarray
    score: float
    ramp: int = 0

    @property
    def centre(self) -> float:
        """The middle of its ramp, frames."""
        return self.frame + self.ramp / 2


@lru_cache(maxsize=256)
def step_filters(covariance: WindowCovariance, size: int, offsets: tuple[int, ...], *, ramp: int = 0) -> WindowFilters:
    """Make the matched filters of a unit step, sharp or with a ramp.

    Parameters
    ----------
    covariance : WindowCovariance
        Covariance of the residual windows.
    size : int
        Samples in a window.
    offsets : tuple[int, ...]
        First sample that differs from those before the step.
    ramp : int, optional
        Samples on the way between the two levels.

    Returns
    -------
    WindowFilters
        A filter for each offset.
    """
    precision = covariance.precision(size)
    step = np.clip((np.arange(size) - np.array(offsets)[:, None] + 1) / (ramp + 1), 0, 1)
    across = step @ precision
    information = (across * step).sum(axis=1)
    return WindowFilters(
        offsets=np.array(offsets),
        weights=across / information[:, None],
        deviation=information**-0.5,
        precision=precision,
        degrees_of_freedom=covariance.degrees_of_freedom(size) - 1,
    )


def find_edges(
    statistics: ResidualStatistics, marker: int, *, rate: float, options: StepsOptions, fraction: float = 1.0
) -> list[Edge]:
    """Find the edges of one marker; of those nearer to each other than half the context the strongest, without its sidelobes.

    Parameters
    ----------
    statistics : ResidualStatistics
        Statistics of the residuals.
    marker : int
        Index of the marker.
    rate : float
        Sampling rate, Hz.
    options : StepsOptions
        Threshold, context, longest ramp, and how the covariance of windows is estimated.
    fraction : float, optional
        Part of the threshold that is enough.

    Returns
    -------
    list[Edge]
        The edges, by frame.
    """
    context = residual_windows.context_samples(rate, options, min_samples=MIN_CONTEXT)
    candidates: list[Edge] = []
    for run in runs(~np.isnan(statistics.local_scale[:, marker])):
        for ramp in range(options.max_ramp_frames + 1):
            size = 2 * context + ramp
            for span, offsets in residual_windows.window_spans(*run, size, context):
                inside = tuple(o for o in offsets if MIN_GAP_DISTANCE <= o <= size - ramp - MIN_GAP_DISTANCE)
                filters = step_filters(statistics.covariance, size, inside, ramp=ramp)
                over = residual_windows.exceedances(statistics, marker, span, filters, options, fraction=fraction)
                scores = over.score / (1 + options.ramp_cost * ramp)
                found = zip(over.frame.tolist(), over.amplitude, scores.tolist(), strict=True)
                candidates += [Edge(*one, ramp) for one in found if one[2] > fraction]
    kept: list[Edge] = []
    for edge in sorted(candidates, key=lambda e: (-e.score, e.frame, e.ramp)):
        distances = [(abs(edge.centre - one.centre), one) for one in kept]
        near = [one for distance, one in distances if distance <= context + options.max_ramp_frames]
        alone = all(2 * distance > context for distance, _ in distances)
        if alone and all(edge.score >= options.sidelobe_fraction * one.score for one in near):
            kept.append(edge)
    return sorted(kept, key=lambda e: e.frame)
