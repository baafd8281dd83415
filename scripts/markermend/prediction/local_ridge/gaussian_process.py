"""Local Gaussian process: the local ridge with a curved part, for joints whose skin does not move in straight lines.

Frame, inputs and kriging are those of the local ridge. The kernel is the ridge's linear one plus a radial one: near the
training poses the marker may depend on its neighbours in any smooth way, far from them it does so as in the ridge.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.options.prediction.local_ridge import GaussianProcessOptions, LocalRidgeOptions
from markermend.prediction.local_ridge.model import Regression, TrainingSet
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.marker_selection import evenly_spaced

INTERCEPT_VARIANCE = 1e4
"""Variance of the intercept in units of the noise: it is nearly free, as inputs and target are centred already."""


@dataclass(frozen=True)
class Kernel:
    """Covariance of the target at two poses, in units of the noise: constant, linear and radial.

    Attributes
    ----------
    linear : float
        Variance of a coefficient, mm^-2.
    amplitude : float
        Variance of the radial part.
    length_mm : float
        Length scale of the radial part, mm.
    """

    linear: float
    amplitude: float
    length_mm: float

    def __call__(self, first: np.ndarray, second: np.ndarray) -> np.ndarray:
        """Evaluate the kernel for all pairs of inputs.

        Parameters
        ----------
        first, second : np.ndarray
            Inputs (n, k) and (m, k), mm.

        Returns
        -------
        np.ndarray
            Covariance (n, m).
        """
        products = first @ second.T
        square = (first**2).sum(axis=1)[:, None] - 2 * products + (second**2).sum(axis=1)
        radial = np.exp(-np.maximum(square, 0.0) / (2 * self.length_mm**2))
        covariance: np.ndarray = INTERCEPT_VARIANCE + self.linear * products + self.amplitude * radial
        return covariance


@dataclass(frozen=True)
class GaussianProcess:
    """A trained Gaussian process.

    Attributes
    ----------
    kernel : Kernel
        Covariance function.
    inputs : np.ndarray
        Training inputs (n, k), mm.
    inverse : np.ndarray
        Inverse (n, n) of their covariance with noise.
    weighted : np.ndarray
        The inverse times the training targets, (n, 3).

    References
    ----------
    Rasmussen & Williams (2006), Gaussian Processes for Machine Learning, eq 2.25.
    """

    kernel: Kernel
    inputs: np.ndarray
    inverse: np.ndarray
    weighted: np.ndarray

    def predict(self, inputs: np.ndarray) -> np.ndarray:
        """Compute the posterior mean.

        Parameters
        ----------
        inputs : np.ndarray
            Inputs (m, k), mm.

        Returns
        -------
        np.ndarray
            Expected targets (m, 3), mm.
        """
        mean: np.ndarray = self.kernel(inputs, self.inputs) @ self.weighted
        return mean

    def without(self, block: np.ndarray) -> np.ndarray:
        """Compute the weighted targets of the process trained without some points, by a block of the inverse.

        Parameters
        ----------
        block : np.ndarray
            Which points are left out, bool (n,).

        Returns
        -------
        np.ndarray
            What replaces `weighted`, (n, 3); 0 for the points left out.
        """
        part = np.flatnonzero(block)
        if len(part) == 0:
            return self.weighted
        taken = np.linalg.solve(self.inverse[np.ix_(part, part)], self.weighted[part])
        left: np.ndarray = self.weighted - self.inverse[:, part] @ taken
        left[part] = 0.0
        return left

    def left_out(self, inputs: np.ndarray, block: np.ndarray, own: np.ndarray) -> np.ndarray:
        """Compute posterior means, each by the process trained without the points of the same block.

        Parameters
        ----------
        inputs : np.ndarray
            Inputs (m, k), mm.
        block : np.ndarray
            Block of each input (m,).
        own : np.ndarray
            Block of each training point (n,).

        Returns
        -------
        np.ndarray
            Expected targets (m, 3), mm; NaN where all points are of the same block.
        """
        expected = np.full((len(inputs), 3), np.nan)
        for number in np.unique(block):
            if (own != number).any():
                rows = block == number
                expected[rows] = self.kernel(inputs[rows], self.inputs) @ self.without(own == number)
        return expected


def train(
    inputs: np.ndarray, target: np.ndarray, weights: np.ndarray, *, ridge: float, options: GaussianProcessOptions
) -> GaussianProcess:
    """Train a process whose radial part has the least error on blocks left out of the training.

    Parameters
    ----------
    inputs : np.ndarray
        Inputs (n, k), mm, centred, in order of time.
    target : np.ndarray
        Targets (n, 3), mm, centred.
    weights : np.ndarray
        Weights of the points (n,): inverse variances of their noise.
    ridge : float
        Penalty of the linear part as in the local ridge, mm^2.
    options : GaussianProcessOptions
        Length scales and variances to try.

    Returns
    -------
    GaussianProcess
        The trained process.

    Raises
    ------
    ValueError
        If there is no length scale or no variance to try.
    """
    norm = (inputs**2).sum(axis=1)
    square = norm[:, None] + norm - 2 * inputs @ inputs.T
    typical = max(float(np.sqrt(np.median(np.maximum(square, 0.0)))), 1e-6)
    block = np.arange(len(inputs)) * options.validation_blocks // len(inputs)
    best, least = None, np.inf
    for length in options.length_scales:
        for amplitude in options.variance_ratios:
            kernel = Kernel(1 / (ridge * weights.sum()), amplitude, length * typical)
            inverse = np.linalg.inv(kernel(inputs, inputs) + np.diag(1 / np.maximum(weights, 1e-6)))
            process = GaussianProcess(kernel, inputs, inverse, inverse @ target)
            error = ((process.left_out(inputs, block, block) - target) ** 2).sum(axis=1)
            error = float((weights * np.nan_to_num(error)).sum())
            if best is None or error < least:
                best, least = process, error
    if best is None:
        raise ValueError("no length scale or no variance to try")
    return best


@dataclass(frozen=True, eq=False)
class _GaussianRegression:
    """A Gaussian process as a regression; points: the training frames (places in data) that it is trained on."""

    data: TrainingSet
    used: np.ndarray
    points: np.ndarray
    process: GaussianProcess

    def predict(self, inputs: np.ndarray) -> np.ndarray:
        """See Regression."""
        local: np.ndarray = self.process.predict(inputs) + self.data.centre[-3:]
        return local

    def left_out(self, block: np.ndarray) -> np.ndarray:
        """See Regression."""
        expected = self.process.left_out(self.data.design(self.used), block, block[self.points])
        residual: np.ndarray = self.data.target - expected
        return residual


class LocalGaussian(LocalRidge):
    """The local Gaussian process as a predictor.

    Parameters
    ----------
    options : LocalRidgeOptions
        Options of the frame, the inputs, the linear part and the kriging, as in the local ridge.
    gaussian : GaussianProcessOptions
        Options of the radial part.
    """

    name = "local_gp"

    def __init__(self, options: LocalRidgeOptions, gaussian: GaussianProcessOptions) -> None:
        super().__init__(options)
        self.gaussian = gaussian

    def _fit(self, data: TrainingSet, used: np.ndarray) -> Regression:
        columns = np.flatnonzero(np.repeat(used, 3))
        points = evenly_spaced(np.arange(len(data.local)), self.gaussian.max_training_frames)
        process = train(
            data.local[np.ix_(points, columns)],
            data.local[points, -3:],
            data.weights[points],
            ridge=self.options.ridge_mm2,
            options=self.gaussian,
        )
        return _GaussianRegression(data, used, points, process)
