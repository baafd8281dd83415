"""Lasting displacements: from one moment on a marker sits elsewhere on its segment, whatever the pose.

The local position of the marker, in the frame of its neighbours, is regressed on the pose (the local positions of the
neighbours) and on the course of a displacement, together: like poses before and after are compared, and a change of pose
for good explains itself.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from markermend.numerics.robust import MAD_TO_STD
from markermend.options.detection.displacement import DisplacementOptions
from markermend.options.prediction import LocalRidgeOptions
from markermend.prediction.local_ridge.inputs import InputSelection
from markermend.prediction.local_ridge.model import TrainingSet, with_intercept
from markermend.prediction.scene import Scene

MIN_INDEPENDENT_VARIANCE = 1e-3
"""No course counts as more independent of the pose than it is, and none as less than this."""


@dataclass(frozen=True)
class Course:
    """How a displacement develops: 0 before, rising to 1, and back to 0 where it ends.

    Attributes
    ----------
    middle_s : float
        Time at which it has reached one half.
    rise_s : float
        Duration of the rise; 0 for a sudden one.
    stop_s : float
        Time from which on it is 0 again, suddenly; infinite for one to the end.
    """

    middle_s: float
    rise_s: float = 0.0
    stop_s: float = np.inf

    def at(self, time_s: np.ndarray) -> np.ndarray:
        """Evaluate the course.

        Parameters
        ----------
        time_s : np.ndarray
            Times (n,), s.

        Returns
        -------
        np.ndarray
            Values (n,) from 0 to 1.
        """
        values: np.ndarray = rise(time_s, np.array([self.middle_s]), self.rise_s)[:, 0]
        return np.where(time_s >= self.stop_s, 0.0, values)


def rise(time_s: np.ndarray, middle_s: np.ndarray, rise_s: float) -> np.ndarray:
    """Evaluate rises from 0 to 1.

    Parameters
    ----------
    time_s : np.ndarray
        Times (n,), s.
    middle_s : np.ndarray
        Times (k,) at which each has reached one half, s.
    rise_s : float
        Their duration, s; 0 for steps.

    Returns
    -------
    np.ndarray
        Values (n, k).
    """
    since = time_s[:, None] - middle_s
    values: np.ndarray = np.clip(since / rise_s + 0.5, 0.0, 1.0) if rise_s > 0 else (since >= 0).astype(float)
    return values


def bump(time_s: np.ndarray, first_s: float, last_s: float, width: float = 1.0) -> np.ndarray:
    """Evaluate a drift that comes back: a raised cosine.

    Parameters
    ----------
    time_s : np.ndarray
        Times (n,), s.
    first_s, last_s : float
        Times between which it exceeds one half, s.
    width : float, optional
        Makes it wider about the middle of these by this factor.

    Returns
    -------
    np.ndarray
        Values (n,) from 0 to 1.
    """
    part = np.abs(time_s - (first_s + last_s) / 2) / (width * (last_s - first_s))
    values: np.ndarray = np.where(part < 1, 0.5 + 0.5 * np.cos(np.pi * np.minimum(part, 1)), 0.0)
    return values


@dataclass(frozen=True, eq=False)
class PoseRegression:
    """A weighted ridge regression on the pose, whose share in the marker's position and in courses is removed.

    Attributes
    ----------
    design : np.ndarray
        Intercept, pose, and courses of known displacements (n, p).
    weights : np.ndarray
        Weights of the frames (n,).
    projection : np.ndarray
        Maps values at the frames to coefficients (p, n).

    References
    ----------
    Frisch and Waugh 1933; Lovell 1963: coefficients of partitioned regressions.
    """

    design: np.ndarray
    weights: np.ndarray
    projection: np.ndarray

    @classmethod
    def fit(cls, pose: np.ndarray, known: np.ndarray, weights: np.ndarray, *, ridge: float) -> PoseRegression:
        """Prepare the regression.

        Parameters
        ----------
        pose : np.ndarray
            Local positions of the neighbours (n, 3 k), mm, about typical values.
        known : np.ndarray
            Courses of known displacements (n, j).
        weights : np.ndarray
            Weights of the frames (n,).
        ridge : float
            Penalty of the pose, mm^2.

        Returns
        -------
        PoseRegression
            The regression.
        """
        design = np.concatenate([with_intercept(pose), known], axis=1)
        penalty = np.zeros(design.shape[1])
        penalty[1 : 1 + pose.shape[1]] = ridge * weights.sum()
        weighted = design * weights[:, None]
        jitter = 1e-9 * weights.sum()
        return cls(design, weights, np.linalg.solve(weighted.T @ design + np.diag(penalty + jitter), weighted.T))

    def residual(self, values: np.ndarray) -> np.ndarray:
        """Remove what the pose explains.

        Parameters
        ----------
        values : np.ndarray
            Values (n, k).

        Returns
        -------
        np.ndarray
            What is left (n, k).
        """
        left: np.ndarray = values - self.design @ (self.projection @ values)
        return left


@dataclass(frozen=True, eq=False)
class Displacement:
    """A lasting displacement of a marker in the local frame of its neighbours.

    Attributes
    ----------
    data : TrainingSet
        The frames, the marker and its neighbours that it was estimated from.
    course : Course
        How it develops.
    vector : np.ndarray
        The displacement (3,), mm, in the local frame.
    explained : float
        Share of the variance left by the pose that it explains, 0 to 1.
    independent : float
        Variance of the course that the pose does not explain.
    error_mm : float
        Standard deviation of each component of the vector, mm.
    coefficients : np.ndarray
        Intercept, pose and known courses (p, 3).
    weights : np.ndarray
        Robust weights of the frames (n,).
    """

    data: TrainingSet
    course: Course
    vector: np.ndarray
    explained: float
    independent: float
    error_mm: float
    coefficients: np.ndarray
    weights: np.ndarray

    @property
    def amount_mm(self) -> float:
        """Length of the vector, mm."""
        return float(np.linalg.norm(self.vector))

    @property
    def evidence(self) -> float:
        """Ratio of explained to unexplained variance."""
        return self.explained / max(1.0 - self.explained, 1e-6)


def training_data(
    scene: Scene, marker: int, local_ridge: LocalRidgeOptions, options: DisplacementOptions, *, excluded: frozenset[int]
) -> TrainingSet | None:
    """Express a marker and its neighbours in the local frame of the nearest of these.

    Parameters
    ----------
    scene : Scene
        What is observed.
    marker : int
        Index of the marker.
    local_ridge : LocalRidgeOptions
        Options of the frame and the inputs.
    options : DisplacementOptions
        In which of them differ.
    excluded : frozenset of int
        Markers that are no neighbours here.

    Returns
    -------
    TrainingSet or None
        The data of the neighbours that are seen most often; None where there are too few.
    """
    own = replace(local_ridge, **options.local_ridge_changes)
    neighbours = [np.array([n for n in near if n not in excluded], int) for near in scene.neighbours]
    around = replace(scene, neighbours=neighbours) if excluded else scene
    frames = np.flatnonzero(scene.present[:, marker])
    frames = frames[:: max(1, len(frames) // own.max_training_frames)]
    assigned = InputSelection(own).assignments(around, marker, frames)
    best = max(assigned, key=lambda assignment: len(assignment.rows), default=None)
    return None if best is None else best.data


def estimate(
    data: TrainingSet,
    course: Course,
    *,
    rate: float,
    ridge: float,
    options: DisplacementOptions,
    known: np.ndarray | None = None,
) -> Displacement:
    """Estimate the displacement of a given course, with robust weights.

    Parameters
    ----------
    data : TrainingSet
        The marker and its neighbours.
    course : Course
        How the displacement develops.
    rate : float
        Sampling rate, Hz.
    ridge : float
        Penalty of the pose, mm^2.
    options : DisplacementOptions
        How outliers are weighed, and over which blocks the error is estimated.
    known : np.ndarray, optional
        Courses of other displacements of the marker (n, j).

    Returns
    -------
    Displacement
        The displacement.
    """
    time_s, pose, local = data.training / rate, data.local[:, :-3], data.target
    own = course.at(time_s)[:, None]
    others = np.zeros((len(own), 0)) if known is None else known
    weights = np.ones(len(own))
    for last in (False, True):
        regression = PoseRegression.fit(pose, others, weights, ridge=ridge)
        left, free = regression.residual(local), regression.residual(own)
        variance = float((weights[:, None] * own * free).sum())
        total = float((weights[:, None] * local * left).sum())
        vector = (weights[:, None] * own * left).sum(axis=0) / max(variance, MIN_INDEPENDENT_VARIANCE * weights.sum())
        remaining = left - free * vector
        if not last:
            weights = outlier_weights(remaining, options.outlier_sigmas)
    return Displacement(
        data,
        course,
        vector,
        explained=variance * float(vector @ vector) / max(total, 1e-12),
        independent=variance / float(weights.sum()),
        error_mm=_level_error(remaining, weights, variance / float(weights.sum()), time_s, options),
        coefficients=regression.projection @ (local - own * vector),
        weights=weights,
    )


def outlier_weights(residual: np.ndarray, sigmas: float) -> np.ndarray:
    """Weigh frames by their residuals.

    Parameters
    ----------
    residual : np.ndarray
        Residuals (n, 3), mm.
    sigmas : float
        Residuals beyond this many robust standard deviations lose weight.

    Returns
    -------
    np.ndarray
        Weights (n,): 1 within the limit, beyond it the squared ratio of limit and residual.
    """
    size = np.linalg.norm(residual, axis=1)
    limit = sigmas * MAD_TO_STD * float(np.median(size)) + 1e-9
    weights: np.ndarray = np.minimum(1.0, (limit / np.maximum(size, 1e-9)) ** 2)
    return weights


def _level_error(
    residual: np.ndarray, weights: np.ndarray, independent: float, time_s: np.ndarray, options: DisplacementOptions
) -> float:
    """Standard deviation of a displacement per axis, mm, from the means of a residual (n, 3) over blocks.

    The levels wander for longer than a block: only blocks as far apart as levels are correlated count as independent.
    """
    block = np.floor((time_s - time_s[0]) / options.level_block_s).astype(int)
    count = np.bincount(block, weights)
    sums = np.stack([np.bincount(block, weights * axis) for axis in residual.T], axis=1)
    level = sums[count > 0] / count[count > 0, None]
    effective = max(1.0, float(time_s[-1] - time_s[0]) / options.level_correlation_s)
    return float(np.sqrt(np.mean(level**2) / (effective * max(independent, MIN_INDEPENDENT_VARIANCE))))
