"""Sudden changes of markers against their neighbours: what heavy noise is made of.

A sudden change is one that the neighbours cannot explain (it is in the residual) and that the marker itself makes (it is
in the trajectory as recorded, in the same direction). A neighbour's artifact is only in the residual, natural motion
only in the trajectory.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from scipy import ndimage

from markermend.core import events
from markermend.core.events import Event
from markermend.detection import inputs
from markermend.detection.neighbour import attribution, residual_scale
from markermend.numerics import intervals
from markermend.numerics.intervals import runs
from markermend.options.detection import IncrementOptions
from markermend.prediction import scene as prediction_scene
from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class Changes:
    """Sudden changes of the markers of a recording.

    vector: (frames, markers, 3), mm, change of the residual from the frame before, without trend; 0 where there is none
    to speak of. size: (frames, markers), mm, how much of it the marker itself makes. score: (frames, markers), that in
    units of the threshold. residual: (frames, markers, 3), mm. tail: a large size in this recording, mm.
    """

    vector: np.ndarray
    size: np.ndarray
    score: np.ndarray
    residual: np.ndarray
    tail: float


def sharp(values: np.ndarray, window: int) -> np.ndarray:
    """Differences of (frames, 3) less their moving median over each valid run; 0 at a run's first sample and in gaps."""
    out = np.zeros_like(values)
    for start, stop in runs(~np.isnan(values).any(axis=1)):
        if stop - start > 1:
            change = np.diff(values[start:stop], axis=0)
            out[start + 1 : stop] = change - ndimage.median_filter(change, (window, 1), mode="reflect")
    return out


def _window(rate: float, options: IncrementOptions) -> int:
    """Samples in the window of the moving median: fewer than three have no trend."""
    return max(3, intervals.samples(options.median_window_s, rate, odd=True))


def measure(
    scene: Scene,
    residual: np.ndarray,
    only: Sequence[int] | None = None,
    was: Changes | None = None,
    *,
    options: IncrementOptions,
) -> Changes:
    """Measure the sudden changes of a scene from its residuals; with `was`, anew for the markers `only`."""
    window = _window(scene.rate, options)
    vector = np.zeros(residual.shape) if was is None else was.vector.copy()
    own = np.zeros(residual.shape[:2]) if was is None else was.size.copy()
    for m in range(residual.shape[1]) if only is None else only:
        vector[:, m] = sharp(residual[:, m], window)
        length = np.linalg.norm(vector[:, m], axis=1)
        along = np.einsum("na,na->n", sharp(scene.positions[:, m], window), vector[:, m])
        own[:, m] = np.clip(along / np.maximum(length, 1e-9), 0, length)
    seen = ~np.isnan(residual).any(axis=2)
    tail = float(np.quantile(own[seen], options.tail_quantile)) if was is None and seen.any() else 0.0
    tail = tail if was is None else was.tail
    length = np.where(seen, np.linalg.norm(vector, axis=2), np.nan)
    usual = residual_scale.usual_size(
        length,
        scene.neighbours,
        window=intervals.samples(options.scale_window_s, scene.rate, odd=True),
        near=options.scale_neighbours,
        ratio=options.max_scale_ratio,
    )
    level = np.maximum(options.threshold_sigmas * usual, max(options.floor_mm, options.tail_factor * tail))
    return Changes(vector, own, np.nan_to_num(own / level), residual, tail)


def detect(
    scene: Scene,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    options: IncrementOptions,
    predictor: prediction_scene.ResidualSource,
    judge: Callable[[Changes, int], list[Event]],
) -> tuple[list[Event], Changes]:
    """Find one class of artifacts among the sudden changes of each marker, and the changes.

    scene: positions (frames, markers, 3), mm, NaN = missing; nothing is found there. earlier: bool, like positions, what
    detectors before claimed. judge: finds among the changes of a marker (index). Rivals among neighbours are judged
    again, see blame.find.
    """
    found, changes = attribution.find(
        inputs.without(scene, earlier),
        measure=partial(measure, options=options),
        judge=judge,
        markers=markers,
        predictor=predictor,
        rounds=options.attribution_rounds,
        reach=options.attribution_neighbours,
        border=_window(scene.rate, options),
    )
    return events.tidy(found), changes


def clusters(frames: np.ndarray, link: int) -> list[np.ndarray]:
    """Split sorted frames wherever two are more than `link` apart."""
    return np.split(frames, np.flatnonzero(np.diff(frames) > link) + 1) if len(frames) else []
