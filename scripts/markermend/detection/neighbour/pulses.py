"""Excursions: for a few samples a marker is off the smooth course that leads from before to after them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np

from markermend.detection.neighbour import residual_windows
from markermend.detection.neighbour.residual_windows import Contrasts, Courses
from markermend.numerics import intervals
from markermend.numerics.intervals import runs
from markermend.numerics.window_covariance import WindowCovariance
from markermend.options.detection import PeaksOptions

FEWEST = 6
"""Samples of context on either side, at least: they tell the misfit."""


@dataclass(frozen=True)
class Excursion:
    """The samples [start, stop) of a marker that are off by `off` (stop - start, 3), mm; score in units of the threshold."""

    start: int
    stop: int
    score: float
    off: np.ndarray


@lru_cache(maxsize=512)
def contrasts(regularity: WindowCovariance, length: int, size: int, places: tuple[int, ...]) -> Contrasts:
    """The size of a half wave of `length` samples, from each of the places on, and what is usual of the other samples."""
    precision = regularity.precision(size)
    wave = np.sin(np.pi * (np.arange(length) + 0.5) / length)
    maps, gains, forms = [], [], []
    for place in places:
        inside = slice(place, place + length)
        across = precision[:, inside]
        strength = wave @ across[inside] @ wave
        maps.append(across @ wave / strength)
        gains.append(strength**-0.5)
        rest = precision - across @ np.linalg.solve(across[inside], across.T)
        forms.append(rest / (regularity.degrees_of_freedom(size) - length))
    return Contrasts(np.array(places), np.array(maps), np.array(gains), np.array(forms))


@lru_cache(maxsize=512)
def apart(regularity: WindowCovariance, length: int, size: int, place: int) -> np.ndarray:
    """Maps a window to how far `length` samples from a place on are off what the others let expect, (length, size)."""
    across = regularity.precision(size)[place : place + length]
    return np.linalg.solve(across[:, place : place + length], across)


@lru_cache(maxsize=512)
def jumps(regularity: WindowCovariance, size: int) -> np.ndarray:
    """Maps a window to the sizes of jumps at each place, in units of their standard deviation, (size - 1, size)."""
    precision = regularity.precision(size)
    jump = np.arange(size) >= np.arange(1, size)[:, None]
    across = jump @ precision
    return across / np.sqrt(np.maximum((across * jump).sum(axis=1), 1e-12))[:, None]


def of_longest(rate: float, options: PeaksOptions) -> tuple[Callable[[WindowCovariance], Contrasts], int]:
    """The maps for the longest excursion amid its context, and the length of their windows."""
    length, context = (
        intervals.samples(options.max_duration_s, rate),
        residual_windows.context(rate, options, fewest=FEWEST),
    )
    size = length + 2 * context
    return partial(contrasts, length=length, size=size, places=(context,)), size


def find(course: Courses, marker: int, *, rate: float, options: PeaksOptions) -> list[Excursion]:
    """Find the excursions of one marker, the surest first; none is nearer to a surer one than what that is judged by."""
    context = residual_windows.context(rate, options, fewest=FEWEST)
    candidates: list[Excursion] = []
    for start, stop in runs(~np.isnan(course.usual[:, marker])):
        for length in range(1, min(intervals.samples(options.max_duration_s, rate), stop - start - 2 * context) + 1):
            size = length + 2 * context
            for span, places in residual_windows.spans(start, stop, size, context):
                inside = tuple(place for place in places if place + length <= size)
                maps = contrasts(course.regularity, length, size, inside)
                candidates += _in(course, marker, span, maps, length, options)
    kept: list[Excursion] = []
    for candidate in sorted(candidates, key=lambda c: (-c.score, c.stop - c.start, c.start)):
        if all(candidate.stop + context <= one.start or one.stop + context <= candidate.start for one in kept):
            kept.append(candidate)
    return kept


def _in(
    course: Courses, marker: int, span: slice, maps: Contrasts, length: int, options: PeaksOptions
) -> list[Excursion]:
    """The excursions of a span, each cut to the samples that are off."""
    over = residual_windows.exceeding(course, marker, span, maps, options)
    found = []
    for i, first in enumerate(over.frame.tolist()):
        place = int(maps.place[over.map[i]])
        each = apart(course.regularity, length, maps.length, place)
        off = each @ over.residual[i].T
        own = residual_windows.own_part(each @ over.positions[i].T, off)
        inside = np.flatnonzero(own >= options.extent_fraction * own.max())
        low, high = int(inside[0]), int(inside[-1]) + 1
        # Off up to the very border of a gap: a jump and an excursion are the same.
        enclosed = place + low > 0 and place + high < maps.length
        if enclosed and _jump_misfit(over.residual[i], course.regularity) <= options.max_shift_ratio * over.misfit[i]:
            continue
        found.append(Excursion(first + low, first + high, float(over.score[i]), off[low:high]))
    return found


def _jump_misfit(window: np.ndarray, regularity: WindowCovariance) -> float:
    """Root mean square of what the usual course with a jump, where it fits best, leaves of a window (3, n), mm."""
    size = window.shape[1]
    whole = np.einsum("an,nm,am->", window, regularity.precision(size), window)
    explained = ((window @ jumps(regularity, size).T) ** 2).sum(axis=0).max()
    return float(np.sqrt(max(whole - explained, 0) / (3 * (regularity.degrees_of_freedom(size) - 1))))
