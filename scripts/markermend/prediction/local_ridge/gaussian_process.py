"""Local Gaussian process: the local ridge with a curved part, for joints whose skin does not move in straight lines.

Frame, inputs and kriging are those of the local ridge. The kernel is the ridge's linear one plus a radial one, so the
marker may depend on its neighbours in any smooth way near the poses that were seen, and far from them as in the ridge.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.options.prediction import GaussianProcessOptions, LocalRidgeOptions
from markermend.prediction.local_ridge.model import RidgeModel
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.marker_selection import evenly_spaced


@dataclass(frozen=True)
class Kernel:
    """Covariance of two poses in units of the noise: constant, linear, and radial.

    linear: variance of a coefficient. amplitude: variance of the radial part. reach_mm: its length.
    """

    linear: float
    amplitude: float
    reach_mm: float

    def __call__(self, first: np.ndarray, second: np.ndarray) -> np.ndarray:
        """Covariance (n, m) of inputs (n, k) and (m, k), mm."""
        products = first @ second.T
        square = (first**2).sum(axis=1)[:, None] - 2 * products + (second**2).sum(axis=1)
        radial = np.exp(-np.maximum(square, 0.0) / (2 * self.reach_mm**2))
        # The constant stands for an intercept that is free: inputs and target are centred already.
        return 1e4 + self.linear * products + self.amplitude * radial


@dataclass(frozen=True)
class GaussianProcess:
    """A trained process: inputs (n, k), the inverse (n, n) of their covariance with noise, and times target (n, 3)."""

    kernel: Kernel
    inputs: np.ndarray
    inverse: np.ndarray
    weighted: np.ndarray

    def predict(self, asked: np.ndarray) -> np.ndarray:
        """Expected target (m, 3) at inputs (m, k)."""
        return self.kernel(asked, self.inputs) @ self.weighted

    def without(self, block: np.ndarray) -> np.ndarray:
        """What stands for `weighted`, (n, 3), had the points marked in `block` (n,) not been there; 0 for these."""
        part = np.flatnonzero(block)
        if len(part) == 0:
            return self.weighted
        taken = np.linalg.solve(self.inverse[np.ix_(part, part)], self.weighted[part])
        left = self.weighted - self.inverse[:, part] @ taken
        left[part] = 0.0
        return left

    def left_out(self, asked: np.ndarray, block: np.ndarray, own: np.ndarray) -> np.ndarray:
        """Expected target (m, 3) at inputs (m, k), each by the process without the points of its own block.

        block: (m,) of the asked; own: (n,) of the points.
        """
        expected = np.full((len(asked), 3), np.nan)
        for number in np.unique(block):
            if (own != number).any():
                rows = block == number
                expected[rows] = self.kernel(asked[rows], self.inputs) @ self.without(own == number)
        return expected


def train(
    inputs: np.ndarray, target: np.ndarray, weights: np.ndarray, *, ridge: float, options: GaussianProcessOptions
) -> GaussianProcess:
    """Train on inputs (n, k) and target (n, 3), both centred, mm, in order of time, of given weights (n,).

    ridge: penalty of the linear part as in the local ridge, mm^2. The radial part whose left-out error is least wins.
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
        raise ValueError("no length or no amplitude to try")
    return best


class LocalGaussian(LocalRidge):
    """The local Gaussian process as a predictor."""

    name = "local_gp"

    def __init__(self, options: LocalRidgeOptions, gaussian: GaussianProcessOptions) -> None:
        """options: frame, inputs, penalty of the linear part, and kriging, as in the local ridge."""
        super().__init__(options)
        self.gaussian = gaussian

    def _learn(self, model: RidgeModel, used: np.ndarray) -> GaussianProcess:
        columns = np.flatnonzero(np.repeat(used, 3))
        rows = evenly_spaced(np.arange(len(model.local)), self.gaussian.max_training_frames)
        return train(
            model.local[np.ix_(rows, columns)],
            model.local[rows, -3:],
            model.weights[rows],
            ridge=self.options.ridge_mm2,
            options=self.gaussian,
        )

    def _respond(self, model: RidgeModel, learned: GaussianProcess, inputs: np.ndarray) -> np.ndarray:
        return learned.predict(inputs) + model.centre[-3:]

    def _left_out(self, model: RidgeModel, used: np.ndarray, learned: GaussianProcess, block: np.ndarray) -> np.ndarray:
        columns = np.flatnonzero(np.repeat(used, 3))
        points = evenly_spaced(np.arange(len(model.local)), self.gaussian.max_training_frames)
        return model.local[:, -3:] - learned.left_out(model.local[:, columns], block, block[points])
