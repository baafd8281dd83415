"""The displacement of one marker, estimated together with the regression on the pose."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.options.detection.displacement import DisplacementOptions
from markermend.prediction.lasting_displacement.course import Course
from markermend.prediction.lasting_displacement.pose_regression import PoseRegression, outlier_weights
from markermend.prediction.local_ridge.model import TrainingSet

MIN_INDEPENDENT_VARIANCE = 1e-3
"""Variance of a course that the pose leaves unexplained: none counts as smaller than this."""


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
