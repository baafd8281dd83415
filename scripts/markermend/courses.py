"""Smooth courses: how far are samples off a polynomial through those about them, in units of how badly that fits?

A marker's residual against its neighbours is smooth where nothing sudden happens. Polynomials are fitted to short windows
of it, and their misfit is the noise scale: amid fast motion or heavy noise they fit badly and little counts as sudden,
where all goes smoothly little is needed. What is found must be in the course as recorded too: a neighbour's artifact is
only in the residual.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from markermend import blame, detection, events, robust
from markermend.events import Event
from markermend.predictors import Scene
from markermend.recording import runs

SPARE = 5
"""Samples that a polynomial is fitted to, beyond its coefficients, at least: they tell the misfit."""


@dataclass(frozen=True)
class CourseSettings:
    """What counts as off a smooth course (part of config peaks.default and steps.default).

    context_s: the polynomial is fitted to so much on either side; beside a gap, to the more on the other side. order,
    border_order: of the polynomial, and beside a gap. activity_s, activity_ratio, activity_neighbours: how the usual
    misfit follows what the body is doing, see robust.usual_size. sigmas: threshold in units of the misfit here and the
    usual one together. floor_mm: and at least so much. rounds: how often neighbours found together are judged again.
    rivals: how many neighbours may be meant by that.
    """

    context_s: float
    order: int
    border_order: int
    activity_s: float
    activity_ratio: float
    activity_neighbours: int
    sigmas: float
    floor_mm: float
    rounds: int
    rivals: int


@dataclass(frozen=True, eq=False)
class Contrasts:
    """Linear maps on windows of n samples, one for each of c places in it.

    place: (c,), first sample in question. off: (c, length, n), what is asked. misfit: (c, d, n), what the polynomial
    leaves: d independent parts of equal variance. gain: (c, length), standard deviation of `off` for independent noise
    of deviation 1.
    """

    place: np.ndarray
    off: np.ndarray
    misfit: np.ndarray

    @property
    def size(self) -> int:
        """Samples in a window."""
        return self.off.shape[2]

    @property
    def gain(self) -> np.ndarray:
        """Standard deviation (c, length) of `off` for independent noise of deviation 1."""
        return np.linalg.norm(self.off, axis=2)


@dataclass(frozen=True)
class Courses:
    """What is judged: residual and positions (frames, markers, 3), mm, NaN = missing, as predicted and as recorded;
    misfit and the usual misfit (frames, markers), mm, NaN where there is too little to fit to.
    """

    residual: np.ndarray
    positions: np.ndarray
    misfit: np.ndarray
    usual: np.ndarray


@dataclass(frozen=True)
class Exceeding:
    """Windows that exceed the threshold: each one's samples (i, 3, n), the index of its map, the frame in question (i,),
    what is off (i, length, 3), how much of that the marker itself makes (i, length), score, and misfit (i,); mm.
    """

    window: np.ndarray
    map: np.ndarray
    frame: np.ndarray
    off: np.ndarray
    own: np.ndarray
    score: np.ndarray
    misfit: np.ndarray


def context(rate: float, settings: CourseSettings, *, coefficients: int) -> int:
    """Samples on either side: as long as asked for, and enough for so many coefficients."""
    return max(robust.samples(settings.context_s, rate), -(-(coefficients + SPARE) // 2))


def powers(size: int, order: int) -> np.ndarray:
    """Orthonormal polynomials up to an order over a window, (size, order + 1)."""
    return np.linalg.qr(np.vander(np.linspace(-1, 1, size), order + 1))[0]


def windows(values: np.ndarray, size: int) -> np.ndarray:
    """All windows of (frames, 3): (windows, 3, size)."""
    return np.lib.stride_tricks.sliding_window_view(values, size, axis=0)


def measure(
    scene: Scene,
    residual: np.ndarray,
    only: Sequence[int] | None = None,
    was: Courses | None = None,
    *,
    maps: Contrasts,
    settings: CourseSettings,
) -> Courses:
    """Measure the misfits of residuals under the first of the maps; with `was`, anew for the markers `only`."""
    misfit = np.full(residual.shape[:2], np.nan) if was is None else was.misfit.copy()
    for m in range(residual.shape[1]) if only is None else only:
        misfit[:, m] = np.nan
        for start, stop in runs(~np.isnan(residual[:, m, 0])):
            if stop - start >= maps.size:
                parts = windows(residual[start:stop, m], maps.size) @ maps.misfit[0].T
                own = np.sqrt((parts**2).sum(axis=(1, 2)) / parts.shape[2])
                misfit[start:stop, m] = own[np.clip(np.arange(stop - start) - maps.size // 2, 0, len(own) - 1)]
    usual = robust.usual_size(
        misfit,
        scene.neighbours,
        window=robust.samples(settings.activity_s, scene.rate, odd=True),
        near=settings.activity_neighbours,
        ratio=settings.activity_ratio,
    )
    return Courses(residual, scene.positions, misfit, usual)


def exceeding(courses: Courses, marker: int, span: slice, maps: Contrasts, settings: CourseSettings) -> Exceeding:
    """The windows of a span of one marker's frames, without gaps, that exceed the threshold."""
    residual, positions = (windows(v[span, marker], maps.size) for v in (courses.residual, courses.positions))
    off = np.einsum("wan,cln->wcla", residual, maps.off, optimize=True)
    at, which = np.nonzero((np.einsum("wcla,wcla->wcl", off, off) > settings.floor_mm**2).any(axis=2))
    off = off[at, which]
    far = np.sqrt(np.einsum("ila,ila->il", off, off))
    course = np.einsum("ian,iln->ila", positions[at], maps.off[which])
    own = np.clip(np.einsum("ila,ila->il", course, off) / np.maximum(far, 1e-9), 0, far)
    parts = np.einsum("ian,idn->iad", residual[at], maps.misfit[which])
    misfit = np.sqrt((parts**2).sum(axis=(1, 2)) / parts.shape[2])
    frame = span.start + at + maps.place[which]
    noise = np.hypot(misfit, courses.usual[frame, marker])
    level = np.maximum(settings.sigmas * noise[:, None] * maps.gain[which], settings.floor_mm)
    score = (own / level).max(axis=1)
    k = score > 1
    return Exceeding(residual[at[k]], which[k], frame[k], off[k], own[k], score[k], misfit[k])


def detect(
    scene: Scene,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    settings: CourseSettings,
    maps: Contrasts,
    predictor: blame.ResidualSource,
    judge: Callable[[Courses, int], list[Event]],
) -> tuple[list[Event], Courses]:
    """Find one class of artifacts on the courses of all markers, and the courses.

    scene: positions (frames, markers, 3), mm, NaN = missing; nothing is found there. earlier: bool, like positions, what
    detectors before claimed. maps: see measure. judge: finds on the course of a marker (index). Rivals among neighbours
    are judged again, see blame.find.
    """
    found, courses = blame.find(
        detection.without(scene, earlier),
        measure=partial(measure, maps=maps, settings=settings),
        judge=judge,
        markers=markers,
        predictor=predictor,
        rounds=settings.rounds,
        reach=settings.rivals,
    )
    return events.tidy(found), courses
