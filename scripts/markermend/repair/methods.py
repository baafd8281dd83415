"""Methods that repair one marker over one interval: prediction and smoothing, each with its error; their names."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.numerics.filters import high_pass
from markermend.numerics.intervals import runs
from markermend.prediction.interface import Predictor
from markermend.prediction.interpolation import KINDS
from markermend.prediction.lagged_regression.predictor import LAGGED_REGRESSIONS
from markermend.prediction.scene import Scene
from markermend.repair.separation import SHAPE_COVARIANCES

METHODS = (
    "exchange",
    "move_back",
    *SHAPE_COVARIANCES,
    "separate_levels",
    "savitzky_golay",
    "blank",
    "local_ridge",
    *LAGGED_REGRESSIONS,
    *KINDS,
)
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
