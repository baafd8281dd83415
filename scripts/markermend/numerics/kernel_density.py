"""Density of a distance: a Gaussian kernel estimate with Silverman's bandwidth, exact at any point, with quantiles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np


@dataclass(frozen=True)
class Density:
    """A sum of Gaussians of one bandwidth around samples (n,), mm."""

    samples: np.ndarray
    bandwidth: float

    def log_density(self, points: np.ndarray) -> np.ndarray:
        """Natural logarithm of the density at points of any shape; finite however far off; NaN stays NaN."""
        deviation = -0.5 * ((points[..., None] - self.samples) / self.bandwidth) ** 2
        largest = deviation.max(axis=-1)
        total = np.log(np.exp(deviation - largest[..., None]).sum(axis=-1)) + largest
        return total - np.log(len(self.samples) * self.bandwidth * np.sqrt(2 * np.pi))

    def quantiles(self, probabilities: Sequence[float]) -> np.ndarray:
        """Points (q,) under which the given shares of the density lie, to a millionth of the samples' range."""
        key = tuple(probabilities)
        if key not in self._found:
            self._found[key] = self._quantiles(np.array(key))
        return self._found[key]

    @cached_property
    def _found(self) -> dict[tuple[float, ...], np.ndarray]:
        """Quantiles by their probabilities: the same are asked for by gap after gap."""
        return {}

    def _quantiles(self, wanted: np.ndarray) -> np.ndarray:
        """Bisection of the distribution function."""
        from scipy.special import ndtr

        low = np.full(wanted.shape, self.samples.min() - 10 * self.bandwidth)
        high = np.full(wanted.shape, self.samples.max() + 10 * self.bandwidth)
        for _ in range(30):
            middle = (low + high) / 2
            below = ndtr((middle[:, None] - self.samples) / self.bandwidth).mean(axis=1) < wanted
            low, high = np.where(below, middle, low), np.where(below, high, middle)
        return (low + high) / 2


def kernel_density(samples: np.ndarray, *, max_samples: int) -> Density:
    """Estimate a density; source: tits2018 eq 21, Silverman's rule of thumb.

    samples: (n,), mm, at least two. At max_samples `max_samples` of them are used, evenly spaced in rank, so that the tails stay.
    The bandwidth is at least a thousandth of a millimetre: distances within a rigid body do not vary at all.
    """
    ordered = np.sort(samples)
    bandwidth = ordered.std(ddof=1) * (len(ordered) * 3 / 4) ** -0.2
    if len(ordered) > max_samples:
        ordered = ordered[np.linspace(0, len(ordered) - 1, max_samples).astype(int)]
    return Density(ordered, max(float(bandwidth), 1e-3))
