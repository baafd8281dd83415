"""Usual courses: how far are samples off what those about them let expect, in units of how badly that fits?

A marker's residual against its neighbours is regular where nothing sudden happens: how regular, each recording tells. What
the usual course leaves of a short window is the noise scale: amid fast motion or heavy noise it leaves much and little
counts as sudden, where all goes smoothly little is needed. What is found must be in the course as recorded too: a
neighbour's artifact is only in the residual. Together this is the adaptive normalised matched filter (Conte, Lops, Ricci
1995), whose false alarms do not depend on the size of the noise.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.detection import inputs
from markermend.detection.neighbour import attribution, residual_scale
from markermend.numerics import intervals
from markermend.numerics.intervals import runs
from markermend.numerics.window_covariance import WindowCovariance, fit_window_covariance, sliding_windows
from markermend.options.detection import ResidualWindowOptions
from markermend.prediction import scene as prediction_scene
from markermend.prediction.scene import Scene


@dataclass(frozen=True, eq=False)
class Contrasts:
    """What is asked of windows of n samples, for each of c places in them.

    place: (c,), first sample in question. size: (c, n), maps a window to the size of what is looked for. gain: (c,), its
    standard deviation where the misfit is 1. misfit: (c, n, n), quadratic form: mean square of what the usual course
    leaves beside that.
    """

    place: np.ndarray
    size: np.ndarray
    gain: np.ndarray
    misfit: np.ndarray

    @property
    def length(self) -> int:
        """Samples in a window."""
        return self.size.shape[1]


@dataclass(frozen=True)
class Courses:
    """What is judged: residual and positions (frames, markers, 3), mm, NaN = missing, as predicted and as recorded;
    misfit and the usual misfit (frames, markers), mm, NaN where there is too little to judge by; and how regular the
    residuals of the recording are.
    """

    residual: np.ndarray
    positions: np.ndarray
    misfit: np.ndarray
    usual: np.ndarray
    regularity: WindowCovariance


@dataclass(frozen=True)
class Exceeding:
    """Windows that exceed the threshold: each one's residuals and positions (i, 3, n), the index of its map, the frame in
    question (i,), the size of what was looked for (i, 3), score, and misfit (i,); mm.
    """

    residual: np.ndarray
    positions: np.ndarray
    map: np.ndarray
    frame: np.ndarray
    size: np.ndarray
    score: np.ndarray
    misfit: np.ndarray


def context(rate: float, options: ResidualWindowOptions, *, fewest: int) -> int:
    """Samples on either side: as long as asked for, and enough to tell the misfit."""
    return max(intervals.samples(options.context_s, rate), fewest)


def spans(start: int, stop: int, length: int, context: int) -> list[tuple[slice, tuple[int, ...]]]:
    """Spans of frames and the places in windows of `length` that cover all of [start, stop), each frame once.

    Inside, what is looked for has its context on either side; at the ends, windows stay and the place in them goes on.
    """
    early, late = tuple(range(context)), tuple(range(context + 1, length))
    return [
        (slice(start, stop), (context,)),
        (slice(start, start + length), early),
        (slice(stop - length, stop), late),
    ]


def own_part(recorded: np.ndarray, residual: np.ndarray) -> np.ndarray:
    """How much of changes of the residual (..., 3) the marker itself makes, as recorded: (...)."""
    far = np.linalg.norm(residual, axis=-1)
    return np.clip(np.einsum("...a,...a->...", recorded, residual) / np.maximum(far, 1e-9), 0, far)


def measure(
    scene: Scene,
    residual: np.ndarray,
    only: Sequence[int] | None = None,
    was: Courses | None = None,
    *,
    maps: Callable[[WindowCovariance], Contrasts],
    length: int,
    options: ResidualWindowOptions,
) -> Courses:
    """Learn how regular residuals are, and measure their misfits under the first of the maps of windows of a length.

    With `was`, anew for the markers `only`.
    """
    if was is None:
        order, shrinkage, at_most = options.polynomial_order, options.white_noise_ratio, options.covariance_windows
        regularity = fit_window_covariance(residual, size=length, order=order, shrinkage=shrinkage, max_windows=at_most)
    else:
        regularity = was.regularity
    form = maps(regularity).misfit[0]
    misfit = np.full(residual.shape[:2], np.nan) if was is None else was.misfit.copy()
    for m in range(residual.shape[1]) if only is None else only:
        misfit[:, m] = np.nan
        for start, stop in runs(~np.isnan(residual[:, m, 0])):
            if stop - start >= length:
                own = _misfit(sliding_windows(residual[start:stop, m], length), form)
                misfit[start:stop, m] = own[np.clip(np.arange(stop - start) - length // 2, 0, len(own) - 1)]
    usual = residual_scale.usual_size(
        misfit,
        scene.neighbours,
        window=intervals.samples(options.scale_window_s, scene.rate, odd=True),
        near=options.scale_neighbours,
        ratio=options.max_scale_ratio,
    )
    return Courses(residual, scene.positions, misfit, usual, regularity)


def _misfit(window: np.ndarray, form: np.ndarray) -> np.ndarray:
    """Root mean square misfit of windows (i, 3, n) under one quadratic form (n, n) or one for each (i, n, n)."""
    square = ((window @ form) * window).sum(axis=(1, 2)) / window.shape[1]
    return np.sqrt(np.maximum(square, 0))


def exceeding(
    courses: Courses, marker: int, span: slice, maps: Contrasts, options: ResidualWindowOptions, *, least: float = 1.0
) -> Exceeding:
    """The windows of a span of one marker's frames, without gaps, that exceed the threshold, or this part of it."""
    residual, positions = (sliding_windows(v[span, marker], maps.length) for v in (courses.residual, courses.positions))
    size = (residual @ maps.size.T).transpose(0, 2, 1)
    at, which = np.nonzero((size**2).sum(axis=2) > (least * options.floor_mm) ** 2)
    size = size[at, which]
    own = own_part(np.einsum("ian,in->ia", positions[at], maps.size[which]), size)
    misfit = _misfit(residual[at], maps.misfit[which])
    frame = span.start + at + maps.place[which]
    noise = np.hypot(misfit, courses.usual[frame, marker])
    score = own / np.maximum(options.threshold_sigmas * noise * maps.gain[which], options.floor_mm)
    k = score > least
    return Exceeding(residual[at[k]], positions[at[k]], which[k], frame[k], size[k], score[k], misfit[k])


def detect(
    scene: Scene,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    options: ResidualWindowOptions,
    maps: Callable[[WindowCovariance], Contrasts],
    length: int,
    predictor: prediction_scene.ResidualSource,
    judge: Callable[[Courses, int], list[Event]],
    suspect: Callable[[Courses, int], list[Event]] | None = None,
    open_at: Callable[[Courses, int], Sequence[int]] | None = None,
) -> tuple[list[Event], Courses]:
    """Find one class of artifacts on the courses of all markers, and the courses.

    scene: positions (frames, markers, 3), mm, NaN = missing; nothing is found there. earlier: bool, like positions, what
    detectors before claimed. maps, length: see measure. judge: finds on the course of a marker (index). suspect, open_at,
    and rivals among neighbours that are judged again: see blame.find.
    """
    found, courses = attribution.find(
        inputs.without(scene, earlier),
        measure=partial(measure, maps=maps, length=length, options=options),
        judge=judge,
        markers=markers,
        predictor=predictor,
        rounds=options.attribution_rounds,
        reach=options.attribution_neighbours,
        border=length // 2,
        suspect=suspect,
        open_at=open_at,
    )
    return events.tidy(found), courses
