"""Methods that repair one marker over one interval: prediction, separation from the artifact, smoothing; each with its error."""

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
    """New samples over an interval.

    Attributes
    ----------
    method : str
        Name of the method.
    positions : ndarray of float, shape (n, 3)
        Positions, mm.
    error : ndarray of float, shape (n,)
        Their standard deviation per axis, mm.
    """

    method: str
    positions: np.ndarray
    error: np.ndarray


def predicted(
    predictor: Predictor, scene: Scene, marker: int, start: int, stop: int, *, trials: int
) -> Proposal | None:
    """Propose what a predictor predicts.

    Parameters
    ----------
    predictor : Predictor
        The predictor.
    scene : Scene
        The trajectories without any finding.
    marker : int
        Index of the marker.
    start, stop : int
        The interval.
    trials : int
        Number of hidden stretches on either side that measure the error of a predictor which does not state one.

    Returns
    -------
    Proposal or None
        The proposal; None where the predictor has no value or no error for some sample.
    """
    prediction = predictor.predict(scene, marker, start, stop)
    positions, error = prediction.positions[1:-1], prediction.error[1:-1]
    if np.isnan(positions).any():
        return None
    if np.isnan(error).any():
        error = np.full(stop - start, hidden_stretch_error(predictor, scene, marker, start, stop, trials=trials))
    return None if np.isnan(error).any() else Proposal(predictor.name, positions, error)


def hidden_stretch_error(
    predictor: Predictor, scene: Scene, marker: int, start: int, stop: int, *, trials: int
) -> float:
    """Measure the error of a predictor on stretches of the same length nearby.

    Parameters
    ----------
    predictor : Predictor
        The predictor.
    scene : Scene
        The trajectories without any finding.
    marker : int
        Index of the marker.
    start, stop : int
        The interval.
    trials : int
        Number of stretches on either side; those with missing samples do not count.

    Returns
    -------
    float
        Root mean square error per axis, mm; NaN where no stretch can be hidden.
    """
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
    """Propose the measured samples without the artifact on them.

    Parameters
    ----------
    method : str
        A key of SHAPE_COVARIANCES: the artifacts that are tried.
    original : ndarray of float, shape (frames, 3)
        The trajectory of the marker as measured, mm; NaN = missing.
    ridges : sequence of LocalRidge
        The predictors; the covariance of the error is estimated from the residual of the first.
    scene : Scene
        The trajectories without any finding.
    marker : int
        Index of the marker.
    start, stop : int
        The interval.
    options : SeparationOptions
        What is assumed of artifacts.

    Returns
    -------
    Proposal or None
        The proposal; None where the neighbours have no value for some sample, or for more samples than the options allow.
    """
    margins = (
        [round(share * (stop - start)) for share in options.margin_fractions] if method == "separate_slow" else [0]
    )
    first, last = _observed_extent(scene.present[:, marker], start, stop, max(margins))
    if last - first > options.max_frames or np.isnan(original[start:stop]).all():
        return None
    correlation = _error_correlation(ridges[0], scene, marker, first, last, round(options.border_s * scene.rate))
    extents = [(max(start - margin, first) - first, min(stop + margin, last) - first) for margin in margins]
    trajectories, separations = [], []
    for ridge in ridges:
        prediction = ridge.predict(scene, marker, first, last)
        positions, deviation = prediction.positions[1:-1], prediction.error[1:-1]
        if np.isnan(positions).any() or np.isnan(deviation).any():
            continue
        tried = artifact_covariances(method, last - first, options, extents)
        error = correlation * deviation * deviation[:, None]
        difference = original[first:last] - positions
        separations.append(separate(difference, error, tried, likelihood_power=options.likelihood_power))
        trajectories.append(positions + separations[-1].mean)
    if not separations:
        return None
    mean, deviation = average_by_likelihood(trajectories, separations)
    own = slice(start - first, stop - first)
    return Proposal(method, mean[own], deviation[own])


def _error_correlation(ridge: LocalRidge, scene: Scene, marker: int, first: int, last: int, border: int) -> np.ndarray:
    """Correlation (n, n) of the error of a prediction over [first, last), known over `border` frames on either side."""
    around = np.arange(first - border, last + border)
    around = around[(around >= 0) & (around < len(scene.present)) & ((around < first) | (around >= last))]
    around = around[scene.present[around, marker]]
    covariance = scene.cached((ridge, "residual", marker), partial(residual_covariance, ridge, scene, marker))
    known_s, wanted_s = around / scene.rate, np.arange(first, last) / scene.rate
    return conditional_correlation(covariance, known_s=known_s, wanted_s=wanted_s)


def _observed_extent(present: np.ndarray, start: int, stop: int, margin: int) -> tuple[int, int]:
    """The interval [start, stop) with up to `margin` frames on either side, as far as the marker is observed there."""
    absent = np.flatnonzero(~present)
    before, after = absent[absent < start], absent[absent >= stop]
    first = max(start - margin, before[-1] + 1 if len(before) else 0)
    return first, min(stop + margin, after[0] if len(after) else len(present))


def residual_covariance(ridge: LocalRidge, scene: Scene, marker: int) -> Covariance:
    """Estimate the covariance of the residual of a marker over time.

    Parameters
    ----------
    ridge : LocalRidge
        The predictor.
    scene : Scene
        The trajectories without any finding.
    marker : int
        Index of the marker.

    Returns
    -------
    Covariance
        The covariance over the whole recording, mm^2.
    """
    residual = ridge.residuals(scene, np.array([marker]))[:, marker]
    scales_s = np.array(ridge.options.correlation_times_s)
    return fit_covariance(residual, rate=scene.rate, scales_s=scales_s, max_lag_s=ridge.options.max_lag_s)


def smoothed(
    original: np.ndarray, flagged: np.ndarray, start: int, stop: int, *, window: int, order: int
) -> Proposal | None:
    """Propose the distorted samples under a Savitzky-Golay smoother.

    Parameters
    ----------
    original : ndarray of float, shape (frames, 3)
        The trajectory of the marker as measured, mm; NaN = missing.
    flagged : ndarray of bool, shape (frames,)
        The samples that a detector found.
    start, stop : int
        The interval.
    window, order : int
        Window in frames and order of the smoother.

    Returns
    -------
    Proposal or None
        The proposal, whose error is by how much the smoother moves the good samples around; None across a gap.

    References
    ----------
    skurowski2022, section 4.2.3: order 13 over 101 samples.
    """
    run = next((r for r in runs(~np.isnan(original).any(axis=1)) if r[0] <= start and stop <= r[1]), None)
    if run is None:
        return None
    trajectory = original[slice(*run)]
    smooth = trajectory - np.stack([high_pass(axis, window, order) for axis in trajectory.T], axis=1)
    around = np.arange(max(run[0], start - window // 2), min(run[1], stop + window // 2))
    good = around[~flagged[around]] - run[0]
    if not len(good):
        return None
    error = np.sqrt(np.mean((smooth[good] - trajectory[good]) ** 2))
    return Proposal("savitzky_golay", smooth[start - run[0] : stop - run[0]], np.full(stop - start, error))
