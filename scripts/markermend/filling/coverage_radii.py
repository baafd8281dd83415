"""How far off is a filling? Radii of the balls that hold the true position with a given probability."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from markermend.options.filling import RadiusOptions

PROBABILITIES = 0.68, 0.95
"""Those of the balls `error` and `error95`."""
_QUANTILES = 0.467699, 1.644854
"""Of the standard normal distribution at the two probabilities."""


def radii(missed: Sequence[np.ndarray], options: RadiusOptions) -> tuple[float, float]:
    """Radii of the 68 and 95 % balls in units of the stated standard deviation.

    missed: for each pseudo-gap, distances (n,) between filling and truth in these units, NaN = unknown. The
    distribution of the distances is a mixture of theirs, each pseudo-gap one part however long it is, and of a
    log-normal one through the radii believed before.
    """
    parts = [known for values in missed if len(known := values[~np.isnan(values)])]
    spread = math.log(options.outer / options.inner) / (_QUANTILES[1] - _QUANTILES[0])
    middle = math.log(options.inner) - _QUANTILES[0] * spread
    distances = np.concatenate([*parts, np.zeros(0)])
    shares = np.concatenate([*(np.full(len(part), 1 / len(part)) for part in parts), np.zeros(0)])
    order = np.argsort(distances)
    distances, below = distances[order], np.concatenate([[0.0], np.cumsum(shares[order])])

    def quantile(probability: float) -> float:
        low, high = -20.0, 20.0
        while high - low > 1e-6:
            logarithm = (low + high) / 2
            believed = 0.5 * (1 + math.erf((logarithm - middle) / (spread * math.sqrt(2))))
            found = below[np.searchsorted(distances, math.exp(logarithm), side="right")]
            reached = options.trials * believed + found >= probability * (options.trials + len(parts))
            low, high = (low, logarithm) if reached else (logarithm, high)
        return math.exp(high)

    return quantile(PROBABILITIES[0]), quantile(PROBABILITIES[1])
