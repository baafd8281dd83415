"""The regression of a marker on the pose of its neighbours, in their local frame."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from markermend.numerics.robust import MAD_TO_STD
from markermend.options.detection.displacement import DisplacementOptions
from markermend.options.prediction.local_ridge import LocalRidgeOptions
from markermend.prediction.local_ridge.inputs import InputSelection
from markermend.prediction.local_ridge.model import TrainingSet
from markermend.prediction.local_ridge.ridge import with_intercept
from markermend.prediction.scene import Scene


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
        Those of them that differ.
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
