"""Radii of the balls around filled positions that hold the true positions with a given probability."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.options.filling import RadiusOptions

PROBABILITIES = 0.68, 0.95
"""Those of the balls `error` and `error95`."""
_QUANTILES = 0.467699, 1.644854
"""Of the standard normal distribution at the two probabilities."""


@dataclass(frozen=True)
class _Mixture:
    """Mixture of a log-normal prior distribution and the empirical ones of pseudo-gaps.

    log_mean, log_deviation: of the prior. prior_weight: in pseudo-gaps. distances: all distances, ascending.
    cumulative: (distances + 1,), sum of the weights of the distances below, each pseudo-gap weighing 1.
    """

    log_mean: float
    log_deviation: float
    prior_weight: float
    distances: np.ndarray
    cumulative: np.ndarray
    parts: int

    def reaches(self, logarithm: float, probability: float) -> bool:
        """Whether distances up to exp(logarithm) have at least this probability."""
        prior = 0.5 * (1 + math.erf((logarithm - self.log_mean) / (self.log_deviation * math.sqrt(2))))
        found = self.cumulative[np.searchsorted(self.distances, math.exp(logarithm), side="right")]
        return bool(self.prior_weight * prior + found >= probability * (self.prior_weight + self.parts))

    def quantile(self, probability: float) -> float:
        """Bisect the logarithm of the distance."""
        low, high = -20.0, 20.0
        while high - low > 1e-6:
            middle = (low + high) / 2
            low, high = (low, middle) if self.reaches(middle, probability) else (middle, high)
        return math.exp(high)


def coverage_radii(standardized_errors: Sequence[np.ndarray], options: RadiusOptions) -> tuple[float, float]:
    """Estimate the radii of the 68 and 95 % balls in units of the stated standard deviation.

    They are quantiles of a mixture in which each pseudo-gap is one part, however long it is, and the prior
    distribution is a log-normal one through the prior radii.

    Parameters
    ----------
    standardized_errors : sequence of ndarray, shape (n,)
        For each pseudo-gap, distances between filled and true positions in stated standard deviations; NaN = unknown.
    options : RadiusOptions
        The prior radii and their weight.

    Returns
    -------
    tuple of float
        Radii of the 68 % and of the 95 % ball.
    """
    parts = [known for values in standardized_errors if len(known := values[~np.isnan(values)])]
    deviation = math.log(options.outer / options.inner) / (_QUANTILES[1] - _QUANTILES[0])
    distances = np.concatenate([*parts, np.zeros(0)])
    weights = np.concatenate([*(np.full(len(part), 1 / len(part)) for part in parts), np.zeros(0)])
    order = np.argsort(distances)
    mixture = _Mixture(
        log_mean=math.log(options.inner) - _QUANTILES[0] * deviation,
        log_deviation=deviation,
        prior_weight=options.prior_pseudo_gaps,
        distances=distances[order],
        cumulative=np.concatenate([[0.0], np.cumsum(weights[order])]),
        parts=len(parts),
    )
    return mixture.quantile(PROBABILITIES[0]), mixture.quantile(PROBABILITIES[1])
