"""Edges: from one frame to the next a marker jumps, and its smooth course goes on displaced."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np

from markermend.detection.neighbour import residual_windows
from markermend.detection.neighbour.residual_windows import Contrasts, Courses
from markermend.numerics.intervals import runs
from markermend.numerics.window_covariance import WindowCovariance
from markermend.options.detection import ResidualWindowOptions

FEWEST = 5
"""Samples of context on either side, at least: they tell the misfit."""

NEAREST = 2
"""Samples between an edge and a gap, at least: a single one tells no edge from a peak."""


@dataclass(frozen=True)
class Edge:
    """A jump of a marker on the way to a frame, (3,), mm; score in units of the threshold."""

    frame: int
    jump: np.ndarray
    score: float


@lru_cache(maxsize=64)
def contrasts(regularity: WindowCovariance, size: int, places: tuple[int, ...]) -> Contrasts:
    """The size of a jump at each of the places in a window, and what is usual of all beside it."""
    precision = regularity.precision(size)
    jump = (np.arange(size) >= np.array(places)[:, None]).astype(float)
    across = jump @ precision
    strength = (across * jump).sum(axis=1)
    rest = precision - across[:, :, None] * across[:, None, :] / strength[:, None, None]
    misfit = rest / (regularity.degrees_of_freedom(size) - 1)
    return Contrasts(np.array(places), across / strength[:, None], strength**-0.5, misfit)


def central(rate: float, options: ResidualWindowOptions) -> tuple[Callable[[WindowCovariance], Contrasts], int]:
    """The maps for a jump amid its context, and the length of their windows."""
    context = residual_windows.context(rate, options, fewest=FEWEST)
    return partial(contrasts, size=2 * context, places=(context,)), 2 * context


def find(
    course: Courses, marker: int, *, rate: float, options: ResidualWindowOptions, least: float = 1.0
) -> list[Edge]:
    """Find the edges of one marker, in time; of those that are nearer than half the context, the best.

    least: a part of the threshold is enough.
    """
    context = residual_windows.context(rate, options, fewest=FEWEST)
    size = 2 * context
    candidates: list[Edge] = []
    for start, stop in runs(~np.isnan(course.usual[:, marker])):
        for span, places in residual_windows.spans(start, stop, size, context):
            inside = tuple(place for place in places if NEAREST <= place <= size - NEAREST)
            maps = contrasts(course.regularity, size, inside)
            over = residual_windows.exceeding(course, marker, span, maps, options, least=least)
            candidates += [Edge(*one) for one in zip(over.frame.tolist(), over.size, over.score.tolist(), strict=True)]
    kept: list[Edge] = []
    for edge in sorted(candidates, key=lambda e: (-e.score, e.frame)):
        if all(2 * abs(edge.frame - one.frame) > context for one in kept):
            kept.append(edge)
    return sorted(kept, key=lambda e: e.frame)
