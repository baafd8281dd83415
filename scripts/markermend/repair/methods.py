"""Ways to mend one marker over one interval: predict it, part it from its artifact, or smooth it; each says how sure it is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from markermend.numerics.filters import high_pass
from markermend.numerics.intervals import runs
from markermend.numerics.kriging import Covariance, fit_covariance
from markermend.options.repair import SeparationOptions
from markermend.prediction.interpolation import KINDS
from markermend.prediction.lagged_regression.predictor import LAGGED_REGRESSIONS
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.scene import Predictor, Scene
from markermend.repair.separation import (
    SHAPE_COVARIANCES,
    artifact_covariances,
    average_by_likelihood,
    conditional_correlation,
    separate,
)

METHODS = ("exchange", *SHAPE_COVARIANCES, "savitzky_golay", "blank", "local_ridge", *LAGGED_REGRESSIONS, *KINDS)
"""The ways of repair by the names that a config may use."""


@dataclass(frozen=True)
class Proposal:
    """New samples over [start, stop): positions (n, 3), mm, and their standard deviation per axis (n,), mm."""

    method: str
    positions: np.ndarray
    error: np.ndarray


def predicted(
    predictor: Predictor, scene: Scene, marker: int, start: int, stop: int, *, trials: int
) -> Proposal | None:
    """What a predictor says; None where it cannot tell for every sample, or how sure it is.

    trials: hidden stretches on either side from which the error of a predictor is told that does not state one.
    """
    prediction = predictor.predict(scene, marker, start, stop)
    positions, error = prediction.positions[1:-1], prediction.error[1:-1]
    if np.isnan(positions).any():
        return None
    if np.isnan(error).any():
        error = np.full(stop - start, tried_error(predictor, scene, marker, start, stop, trials=trials))
    return None if np.isnan(error).any() else Proposal(predictor.name, positions, error)


def tried_error(predictor: Predictor, scene: Scene, marker: int, start: int, stop: int, *, trials: int) -> float:
    """Root mean square error per axis, mm, of a predictor on stretches of the same length hidden nearby; NaN if none fits."""
    length, errors = stop - start, []
    for trial in range(1, trials + 1):
        for first in (start - 2 * trial * length - 2, stop + (2 * trial - 1) * length + 2):
            last = first + length
            if first < 1 or last >= len(scene.positions) or not scene.present[first - 1 : last + 1, marker].all():
                continue
            guess = predictor.predict(scene, marker, first, last)
            errors.append(np.mean((guess.positions[1:-1] - scene.positions[first:last, marker]) ** 2))
    return float(np.sqrt(np.mean(errors))) if errors else np.nan


def separated(
    method: str,
    original: np.ndarray,
    ridges: Sequence[LocalRidge],
    scene: Scene,
    marker: int,
    start: int,
    stop: int,
    *,
    options: SeparationOptions,
) -> Proposal | None:
    """The measured samples without the artifact that a method of SHAPE_COVARIANCES tells apart from the error of the prediction.

    original: (frames, 3), the marker's course as measured, NaN = missing. ridges: what predicts it; the residual of the
    first tells how errors go together. None where the neighbours cannot tell for every sample, and for more samples than
    the options allow.
    """
    margins = [round(share * (stop - start)) for share in options.margins] if method == "separate_slow" else [0]
    first, last = _free(scene.present[:, marker], start, stop, max(margins))
    if last - first > options.most_frames or np.isnan(original[start:stop]).all():
        return None
    together = _together(ridges[0], scene, marker, first, last, round(options.border_s * scene.rate))
    extents = [(max(start - wider, first) - first, min(stop + wider, last) - first) for wider in margins]
    courses, parts = [], []
    for ridge in ridges:
        prediction = ridge.predict(scene, marker, first, last)
        positions, deviation = prediction.positions[1:-1], prediction.error[1:-1]
        if np.isnan(positions).any() or np.isnan(deviation).any():
            continue
        tried = artifact_covariances(method, last - first, options, extents)
        error = together * deviation * deviation[:, None]
        parts.append(separate(original[first:last] - positions, error, tried, likelihood_power=options.trust))
        courses.append(positions + parts[-1].mean)
    if not parts:
        return None
    mean, remaining = average_by_likelihood(courses, parts)
    own = slice(start - first, stop - first)
    return Proposal(method, mean[own], remaining[own])


def _together(ridge: LocalRidge, scene: Scene, marker: int, first: int, last: int, border: int) -> np.ndarray:
    """How errors of a prediction over [first, last) go together: correlation (n, n), given `border` frames on either side."""
    around = np.arange(first - border, last + border)
    around = around[(around >= 0) & (around < len(scene.present)) & ((around < first) | (around >= last))]
    around = around[scene.present[around, marker]]
    covariance = scene.cached((ridge, "residual", marker), partial(residual_covariance, ridge, scene, marker))
    return conditional_correlation(
        covariance, known_s=around / scene.rate, wanted_s=np.arange(first, last) / scene.rate
    )


def _free(present: np.ndarray, start: int, stop: int, margin: int) -> tuple[int, int]:
    """The interval [start, stop) with up to `margin` frames on either side, as far as the marker is observed there."""
    absent = np.flatnonzero(~present)
    before, after = absent[absent < start], absent[absent >= stop]
    first = max(start - margin, before[-1] + 1 if len(before) else 0)
    return first, min(stop + margin, after[0] if len(after) else len(present))


def residual_covariance(ridge: LocalRidge, scene: Scene, marker: int) -> Covariance:
    """How the residual of a marker goes together over time, over the whole recording."""
    residual = ridge.residuals(scene, np.array([marker]))[:, marker]
    scales_s = np.array(ridge.options.scales_s)
    return fit_covariance(residual, rate=scene.rate, scales_s=scales_s, max_lag_s=ridge.options.longest_s)


def smoothed(
    original: np.ndarray, flagged: np.ndarray, start: int, stop: int, *, window: int, order: int
) -> Proposal | None:
    """The distorted samples under a Savitzky-Golay smoother (order 13 over 101 samples in skurowski2022).

    original: (frames, 3), NaN = missing. flagged: bool (frames,), samples that some detector found. The error is told by
    how far the smoother moves the good samples around, which the distortion drags along. None across a gap.
    """
    run = next((r for r in runs(~np.isnan(original).any(axis=1)) if r[0] <= start and stop <= r[1]), None)
    if run is None:
        return None
    course = original[slice(*run)]
    smooth = course - np.stack([high_pass(axis, window, order) for axis in course.T], axis=1)
    around = np.arange(max(run[0], start - window // 2), min(run[1], stop + window // 2))
    good = around[~flagged[around]] - run[0]
    if not len(good):
        return None
    error = np.sqrt(np.mean((smooth[good] - course[good]) ** 2))
    return Proposal("savitzky_golay", smooth[start - run[0] : stop - run[0]], np.full(stop - start, error))
