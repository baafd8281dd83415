"""Edges: from one frame to the next a marker jumps, and its smooth trajectory goes on displaced."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from markermend.detection.neighbour import residual_windows
from markermend.detection.neighbour.residual_windows import ResidualStatistics, WindowFilters
from markermend.numerics.intervals import runs
from markermend.numerics.window_covariance import WindowCovariance
from markermend.options.detection import ResidualWindowOptions

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
    """

    frame: int
    jump: np.ndarray
    score: float


@lru_cache(maxsize=64)
def step_filters(covariance: WindowCovariance, size: int, offsets: tuple[int, ...]) -> WindowFilters:
    """Make the matched filters of a unit step.

    Parameters
    ----------
    covariance : WindowCovariance
        Covariance of the residual windows.
    size : int
        Samples in a window.
    offsets : tuple[int, ...]
        First sample after the step.

    Returns
    -------
    WindowFilters
        A filter for each offset.
    """
    precision = covariance.precision(size)
    step = (np.arange(size) >= np.array(offsets)[:, None]).astype(float)
    across = step @ precision
    information = (across * step).sum(axis=1)
    rest = precision - across[:, :, None] * across[:, None, :] / information[:, None, None]
    misfit_form = rest / (covariance.degrees_of_freedom(size) - 1)
    return WindowFilters(np.array(offsets), across / information[:, None], information**-0.5, misfit_form)


def find_edges(
    statistics: ResidualStatistics,
    marker: int,
    *,
    rate: float,
    options: ResidualWindowOptions,
    fraction: float = 1.0,
) -> list[Edge]:
    """Find the edges of one marker; of those nearer to each other than half the context the strongest.

    Parameters
    ----------
    statistics : ResidualStatistics
        Statistics of the residuals.
    marker : int
        Index of the marker.
    rate : float
        Sampling rate, Hz.
    options : ResidualWindowOptions
        Threshold, context, and how the covariance of windows is estimated.
    fraction : float, optional
        Part of the threshold that is enough.

    Returns
    -------
    list[Edge]
        The edges, by frame.
    """
    context = residual_windows.context_samples(rate, options, min_samples=MIN_CONTEXT)
    size = 2 * context
    candidates: list[Edge] = []
    for start, stop in runs(~np.isnan(statistics.local_scale[:, marker])):
        for span, offsets in residual_windows.window_spans(start, stop, size, context):
            inside = tuple(offset for offset in offsets if MIN_GAP_DISTANCE <= offset <= size - MIN_GAP_DISTANCE)
            filters = step_filters(statistics.covariance, size, inside)
            over = residual_windows.exceedances(statistics, marker, span, filters, options, fraction=fraction)
            found = zip(over.frame.tolist(), over.amplitude, over.score.tolist(), strict=True)
            candidates += [Edge(*one) for one in found]
    kept: list[Edge] = []
    for edge in sorted(candidates, key=lambda e: (-e.score, e.frame)):
        if all(2 * abs(edge.frame - one.frame) > context for one in kept):
            kept.append(edge)
    return sorted(kept, key=lambda e: e.frame)
