"""Excursions: for a few samples a marker is off the smooth course that leads from before to after them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from markermend import courses, robust
from markermend.courses import Contrasts, Courses, CourseSettings
from markermend.recording import runs


@dataclass(frozen=True)
class ExcursionSettings(CourseSettings):
    """Settings of excursions (config peaks.default), beside those of courses.

    longest_s: longest excursion. weak: samples that are off by this part of the largest belong to it. edge: nothing is
    one where a polynomial with a jump fits all samples with up to so many times the misfit that it has without those in
    question.
    """

    longest_s: float
    weak: float
    edge: float


@dataclass(frozen=True)
class Excursion:
    """The samples [start, stop) of a marker that are off by `off` (stop - start, 3), mm; score in units of the threshold."""

    start: int
    stop: int
    score: float
    off: np.ndarray


@lru_cache(maxsize=256)
def contrasts(length: int, size: int, places: tuple[int, ...], order: int) -> Contrasts:
    """How far `length` samples, from each of the places on, are off the polynomial through the other ones of a window."""
    basis = courses.powers(size, order)
    off = np.zeros((len(places), length, size))
    misfit = np.zeros((len(places), size - length - order - 1, size))
    for k, place in enumerate(places):
        inside = place + np.arange(length)
        others = np.setdiff1d(np.arange(size), inside)
        left, _, _ = np.linalg.svd(basis[others])
        off[k][:, others] = -basis[inside] @ np.linalg.pinv(basis[others])
        off[k, np.arange(length), inside] = 1
        misfit[k][:, others] = left[:, order + 1 :].T
    return Contrasts(np.array(places), off, misfit)


@lru_cache(maxsize=256)
def jump_misfits(size: int, order: int) -> np.ndarray:
    """What a polynomial with a jump leaves of a window, for each place of the jump: (size - 1, d, size)."""
    jumps = np.arange(size) >= np.arange(1, size)[:, None]
    basis = np.broadcast_to(courses.powers(size, order), (size - 1, size, order + 1))
    left, _, _ = np.linalg.svd(np.concatenate([basis, jumps[:, :, None]], axis=2))
    return left[:, :, order + 2 :].transpose(0, 2, 1)


def lengths(longest: int) -> list[int]:
    """Lengths to try: each at most half as long again as the one before, up to the longest."""
    tried = [1]
    while tried[-1] < longest:
        tried.append(min(longest, max(tried[-1] + 1, tried[-1] * 3 // 2)))
    return tried


def of_longest(rate: float, settings: ExcursionSettings) -> Contrasts:
    """The maps for the longest excursion amid its context."""
    length, context = robust.samples(settings.longest_s, rate), _context(rate, settings)
    return contrasts(length, length + 2 * context, (context,), settings.order)


def find(course: Courses, marker: int, *, rate: float, settings: ExcursionSettings) -> list[Excursion]:
    """Find the excursions of one marker, the surest first; none is nearer to a surer one than what that is judged by."""
    context = _context(rate, settings)
    candidates: list[Excursion] = []
    for start, stop in runs(~np.isnan(course.usual[:, marker])):
        for length in lengths(robust.samples(settings.longest_s, rate)):
            size = length + 2 * context
            if size > stop - start:
                break
            early, late = tuple(range(context)), tuple(range(context + 1, 2 * context + 1))
            for span, places, order in (
                (slice(start, stop), (context,), settings.order),
                (slice(start, start + size), early, settings.border_order),
                (slice(stop - size, stop), late, settings.border_order),
            ):
                candidates += _in(course, marker, span, contrasts(length, size, places, order), settings)
    kept: list[Excursion] = []
    for candidate in sorted(candidates, key=lambda c: (-c.score, c.stop - c.start, c.start)):
        if all(candidate.stop + context <= one.start or one.stop + context <= candidate.start for one in kept):
            kept.append(candidate)
    return kept


def _context(rate: float, settings: ExcursionSettings) -> int:
    return courses.context(rate, settings, coefficients=settings.order + 1)


def _in(course: Courses, marker: int, span: slice, maps: Contrasts, settings: ExcursionSettings) -> list[Excursion]:
    """The excursions of a span, each cut to the samples that are off."""
    over = courses.exceeding(course, marker, span, maps, settings)
    order = maps.size - maps.off.shape[1] - maps.misfit.shape[1] - 1
    found = []
    for i, own in enumerate(over.own):
        inside = np.flatnonzero(own >= settings.weak * own.max())
        low, high = int(inside[0]), int(inside[-1]) + 1
        place = maps.place[over.map[i]]
        # Off up to the very border of a gap: a jump and an excursion are the same.
        enclosed = place + low > 0 and place + high < maps.size
        if enclosed and _jump_misfit(over.window[i], order) <= settings.edge * over.misfit[i]:
            continue
        first = int(over.frame[i])
        found.append(Excursion(first + low, first + high, float(over.score[i]), over.off[i, low:high]))
    return found


def _jump_misfit(window: np.ndarray, order: int) -> float:
    """Root mean square misfit of a polynomial with a jump where it fits best; window: (3, n), mm."""
    parts = np.einsum("an,kdn->kad", window, jump_misfits(window.shape[1], order), optimize=True)
    return float(np.sqrt(((parts**2).sum(axis=(1, 2)) / parts.shape[2]).min()))
