"""Edges: from one frame to the next a marker jumps, and its smooth course goes on displaced."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from markermend import courses
from markermend.courses import Contrasts, Courses, CourseSettings
from markermend.recording import runs

NEAREST = 2
"""Samples between an edge and a gap, at least: a single one tells no edge from a peak."""


@dataclass(frozen=True)
class Edge:
    """A jump of a marker on the way to a frame, (3,), mm; score in units of the threshold."""

    frame: int
    jump: np.ndarray
    score: float


@lru_cache(maxsize=64)
def contrasts(size: int, places: tuple[int, ...], order: int) -> Contrasts:
    """The jump at each of the places in a window, of a polynomial with a jump there."""
    basis = courses.powers(size, order)
    off, misfit = np.zeros((len(places), 1, size)), np.zeros((len(places), size - order - 2, size))
    for k, place in enumerate(places):
        design = np.column_stack([basis, np.arange(size) >= place])
        left, _, _ = np.linalg.svd(design)
        off[k, 0], misfit[k] = np.linalg.pinv(design)[-1], left[:, order + 2 :].T
    return Contrasts(np.array(places), off, misfit)


def central(rate: float, settings: CourseSettings) -> Contrasts:
    """The maps for a jump amid its context."""
    context = _context(rate, settings)
    return contrasts(2 * context, (context,), settings.order)


def find(course: Courses, marker: int, *, rate: float, settings: CourseSettings) -> list[Edge]:
    """Find the edges of one marker, in time; of those that are nearer than half the context, the best."""
    context = _context(rate, settings)
    size = 2 * context
    candidates: list[Edge] = []
    for start, stop in runs(~np.isnan(course.usual[:, marker])):
        early, late = tuple(range(NEAREST, context)), tuple(range(context + 1, size - NEAREST + 1))
        for span, places, order in (
            (slice(start, stop), (context,), settings.order),
            (slice(start, start + size), early, settings.border_order),
            (slice(stop - size, stop), late, settings.border_order),
        ):
            over = courses.exceeding(course, marker, span, contrasts(size, places, order), settings)
            found = zip(over.frame.tolist(), over.off[:, 0], over.score.tolist(), strict=True)
            candidates += [Edge(*one) for one in found]
    kept: list[Edge] = []
    for edge in sorted(candidates, key=lambda e: (-e.score, e.frame)):
        if all(2 * abs(edge.frame - one.frame) > context for one in kept):
            kept.append(edge)
    return sorted(kept, key=lambda e: e.frame)


def _context(rate: float, settings: CourseSettings) -> int:
    return courses.context(rate, settings, coefficients=settings.order + 2)
