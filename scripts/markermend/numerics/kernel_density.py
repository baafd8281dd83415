"""Kernel density estimates in one dimension: Gaussian kernels with Silverman's bandwidth, exact at any point."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

MIN_BANDWIDTH = 1e-3
"""Least bandwidth, mm: distances within a rigid body do not vary at all."""

POINTS_AT_ONCE = 64
"""Points whose kernels are computed together: as many as the cache of a processor holds."""

BISECTIONS = 30
"""Steps of the search for a quantile: enough for a millionth of the samples' range."""


@dataclass(frozen=True)
class Density:
    """A mean of Gaussians of equal bandwidth around samples.

    Attributes
    ----------
    samples : np.ndarray
        Samples (n,), mm, ascending.
    bandwidth : float
        Standard deviation of the Gaussians, mm.
    """

    samples: np.ndarray
    bandwidth: float

    def log_density(self, points: np.ndarray) -> np.ndarray:
        """Evaluate the natural logarithm of the density.

        Parameters
        ----------
        points : np.ndarray
            Points of any shape, mm.

        Returns
        -------
        np.ndarray
            Log-density of the same shape, per mm: finite at any distance from the samples, NaN where a point is NaN.
        """
        flat = np.ravel(points)
        starts = range(0, len(flat), POINTS_AT_ONCE)
        totals = [self._log_sum(flat[start : start + POINTS_AT_ONCE]) for start in starts]
        total = np.concatenate(totals) if totals else np.empty(0)
        density: np.ndarray = total - np.log(len(self.samples) * self.bandwidth * np.sqrt(2 * np.pi))
        return density.reshape(np.shape(points))

    def _log_sum(self, points: np.ndarray) -> np.ndarray:
        """Logarithm of the sum of the kernels, without their common factor, at points (n,)."""
        exponent = points[:, None] - self.samples
        exponent /= self.bandwidth
        np.square(exponent, out=exponent)
        exponent *= -0.5
        largest = exponent.max(axis=1)
        exponent -= largest[:, None]
        total: np.ndarray = np.log(np.exp(exponent, out=exponent).sum(axis=1)) + largest
        return total

    def quantiles(self, probabilities: Sequence[float]) -> np.ndarray:
        """Compute quantiles by bisection of the distribution function.

        Parameters
        ----------
        probabilities : Sequence[float]
            Probabilities (q,), between 0 and 1.

        Returns
        -------
        np.ndarray
            Quantiles (q,), mm, to a millionth of the samples' range.
        """
        key = tuple(probabilities)
        if key not in self._computed_quantiles:
            self._computed_quantiles[key] = self._bisect(np.array(key))
        return self._computed_quantiles[key]

    @cached_property
    def _computed_quantiles(self) -> dict[tuple[float, ...], np.ndarray]:
        """Quantiles by their probabilities, which are the same for gap after gap."""
        return {}

    def _bisect(self, probabilities: np.ndarray) -> np.ndarray:
        """Quantiles (q,) at probabilities (q,)."""
        from scipy.special import ndtr

        low = np.full(probabilities.shape, self.samples.min() - 10 * self.bandwidth)
        high = np.full(probabilities.shape, self.samples.max() + 10 * self.bandwidth)
        for _ in range(BISECTIONS):
            middle = (low + high) / 2
            below = ndtr((middle[:, None] - self.samples) / self.bandwidth).mean(axis=1) < probabilities
            low, high = np.where(below, middle, low), np.where(below, high, middle)
        quantiles: np.ndarray = (low + high) / 2
        return quantiles


def kernel_density(samples: np.ndarray, *, max_samples: int) -> Density:
    """Estimate a density by Gaussian kernels with Silverman's rule of thumb.

    Parameters
    ----------
    samples : np.ndarray
        Samples (n,), mm, at least two, without NaN.
    max_samples : int
        Largest number of kernels: of more samples, those evenly spaced in rank are used, which keeps the tails.

    Returns
    -------
    Density
        The density; its bandwidth is that of all samples, at least a thousandth of a millimetre.

    References
    ----------
    tits2018 eq 21; Silverman (1986), Density Estimation for Statistics and Data Analysis, eq 3.28.
    """
    ordered = np.sort(samples)
    bandwidth = ordered.std(ddof=1) * (len(ordered) * 3 / 4) ** -0.2
    if len(ordered) > max_samples:
        ordered = ordered[np.linspace(0, len(ordered) - 1, max_samples).astype(int)]
    return Density(ordered, max(float(bandwidth), MIN_BANDWIDTH))
