"""Local Gaussian process: the local ridge with a curved part, for joints whose skin does not move in straight lines.

Frame, inputs and kriging are those of the local ridge. The covariance is the ridge's linear one plus a Matern kernel in the
pose: near the training poses the marker may depend on its neighbours in any smooth way, far from them it does so as in the
ridge. Inputs count by how much the ridge uses them. The kernel is approximated by functions of some
poses (inducing points), so that the process is a ridge regression on these functions beside the inputs.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from markermend.numerics.kriging import matern_3_2
from markermend.numerics.pivoted_cholesky import pivoted_cholesky
from markermend.options.prediction.local_ridge import GaussianProcessOptions, LocalRidgeOptions
from markermend.prediction.local_ridge.model import Regression, TrainingSet
from markermend.prediction.local_ridge.offsets import Offsets
from markermend.prediction.local_ridge.predictor import TRUSTED_WEIGHT, LocalRidge
from markermend.prediction.local_ridge.ridge_regression import RidgeRegression
from markermend.prediction.marker_selection import evenly_spaced


@dataclass(frozen=True)
class PoseKernel:
    """Matern kernel of order 3/2 in the pose.

    Attributes
    ----------
    scales : np.ndarray
        Weight of each input (k,), per mm: the inverse of its length scale.
    """

    scales: np.ndarray

    def __call__(self, first: np.ndarray, second: np.ndarray) -> np.ndarray:
        """Evaluate the kernel for all pairs of inputs.

        Parameters
        ----------
        first, second : np.ndarray
            Inputs (n, k) and (m, k), mm.

        Returns
        -------
        np.ndarray
            Covariance (n, m), 1 for equal inputs.
        """
        return matern_3_2(np.sqrt(squared_distances(first * self.scales, second * self.scales)))


@dataclass(frozen=True)
class InducedFeatures:
    """Functions of the inputs whose covariance approximates a kernel by its values at some inducing points.

    Attributes
    ----------
    kernel : PoseKernel
        The kernel.
    points : np.ndarray
        Inputs at the inducing points (m, k), mm.
    whitening : np.ndarray
        Matrix (m, m) that makes the kernel values at the points uncorrelated functions of unit variance.
    penalty : float
        Penalty of the coefficients of these functions per unit of weight.

    References
    ----------
    Quinonero-Candela & Rasmussen (2005), Journal of Machine Learning Research 6, section 5.
    """

    kernel: PoseKernel
    points: np.ndarray
    whitening: np.ndarray
    penalty: float

    @classmethod
    def choose(cls, ridge: RidgeRegression, options: GaussianProcessOptions) -> InducedFeatures:
        """Choose the kernel and the inducing points for training data.

        Parameters
        ----------
        ridge : RidgeRegression
            The regression on the inputs; inputs count by their coefficients.
        options : GaussianProcessOptions
            Number of points, length scale and penalty.

        Returns
        -------
        InducedFeatures
            The features.
        """
        data, used = ridge.data, ridge.used
        use = np.linalg.norm(ridge.function.coefficients[1:], axis=1)
        poses = _poses(data, used, options.inducing_points)
        sample = poses * use
        typical = max(float(np.sqrt(np.median(squared_distances(sample, sample)))), 1e-6)
        kernel = PoseKernel(use / (options.length_scale * typical))
        pivots, factor = pivoted_cholesky(kernel(poses, poses), tolerance=options.min_variance)
        return cls(kernel, poses[pivots], np.linalg.inv(factor).T, options.penalty)

    def values(self, inputs: np.ndarray) -> np.ndarray:
        """Evaluate the features. See `Features.values`."""
        values: np.ndarray = self.kernel(inputs, self.points) @ self.whitening
        return values


class LocalGaussian(LocalRidge):
    """The local Gaussian process as a predictor.

    Parameters
    ----------
    options : LocalRidgeOptions
        Options of the frame, the inputs, the linear part and the kriging, as in the local ridge.
    gaussian : GaussianProcessOptions
        Options of the part that is a function of the pose, and what takes the place of some of those options.
    """

    name = "local_gp"

    def __init__(self, options: LocalRidgeOptions, gaussian: GaussianProcessOptions) -> None:
        frames = min(options.max_training_frames, gaussian.max_training_frames)
        super().__init__(
            replace(options, max_training_frames=frames, border_s=max(options.border_s, gaussian.border_s))
        )
        self.gaussian = gaussian

    def _stretch(self, length: int, rate: float) -> int | None:
        gaussian = self.gaussian
        if not gaussian.offset_share:
            return None
        # Gaps of similar lengths share their training.
        rounded = 2.0 ** math.ceil(math.log2(length / rate))
        return max(1, round(max(gaussian.offset_s, gaussian.offset_gaps * rounded) * rate))

    def _fit(self, data: TrainingSet, used: np.ndarray, stretch: int | None = None) -> Regression:
        share = self.gaussian.offset_share
        offsets = stretch and Offsets.of_stretches(data.training, length=stretch, share=share)
        ridge = RidgeRegression.fit(data, used, self.options.ridge_mm2, self._pooling, offsets or None)
        features = InducedFeatures.choose(ridge, self.gaussian)
        return ridge.extended(features, max_pooled_rows=self.options.max_training_frames)


def squared_distances(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Compute the squared distances of all pairs of points.

    Parameters
    ----------
    first, second : np.ndarray
        Points (n, k) and (m, k).

    Returns
    -------
    np.ndarray
        Squared distances (n, m).
    """
    square = (first**2).sum(axis=1)[:, None] - 2 * first @ second.T + (second**2).sum(axis=1)
    positive: np.ndarray = np.maximum(square, 0.0)
    return positive


def _poses(data: TrainingSet, used: np.ndarray, count: int) -> np.ndarray:
    """Inputs (n, 3 u) at trusted training frames and pooled rows, evenly spaced."""
    rows, weights = data.local, data.weights
    if data.pooled is not None:
        rows, weights = np.concatenate([rows, data.pooled.about(data.centre)]), np.append(weights, data.pooled.weights)
    columns = np.flatnonzero(np.repeat(used, 3))
    chosen = evenly_spaced(np.flatnonzero(weights > TRUSTED_WEIGHT), count)
    inputs: np.ndarray = rows[np.ix_(chosen, columns)]
    return inputs
