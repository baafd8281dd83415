"""Probabilistic model averaging: weights by the likelihood of distances to references, and the weighted mean."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.numerics.kernel_density import Density


def pma_likelihood(
    positions: np.ndarray, references: np.ndarray, densities: Sequence[Density], *, window: int, floor: float
) -> np.ndarray:
    """Likelihood (members, n) of positions by their distances to references; source: tits2018 eq 20-23.

    positions: (members, n, 3), mm. references: (n, k, 3), NaN = not seen, then it does not count. window: frames of the
    moving average. floor: least value. Positions that are NaN get the floor.
    """
    distance = np.linalg.norm(positions[:, :, None] - references, axis=3)
    logarithm = np.zeros(positions.shape[:2])
    for r, density in enumerate(densities):
        seen = ~np.isnan(references[:, r]).any(axis=1)
        logarithm[:, seen] += density.log_density(distance[:, seen, r])
    likelihood = np.maximum(np.exp(np.nan_to_num(logarithm, nan=-np.inf)), floor)
    return _moving_average(likelihood, window)


def _moving_average(values: np.ndarray, window: int) -> np.ndarray:
    """Centred moving average along the second axis; at the ends over what there is."""
    if window <= 1:
        return values
    kernel = np.ones(window)
    full = np.stack([np.convolve(row, kernel) for row in values])
    count = np.convolve(np.ones(values.shape[1]), kernel)
    offset = (window - 1) // 2
    return (full / count)[:, offset : offset + values.shape[1]]


def weighted_mean(positions: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Average positions (members, n, 3) by weights (members, n); source: tits2018 eq 24.

    NaN positions do not count; where all weights vanish, all members that tell something count alike. Members that tell
    all frames silence those that do not, so that no jump stands where one of them falls out. Also returns the weights
    scaled to the sum one; NaN where no member tells anything.
    """
    known = ~np.isnan(positions).any(axis=2)
    known &= known.all(axis=1)[:, None] | ~known.all(axis=1).any()
    usable = np.where(known, weights, 0.0)
    usable = np.where(usable.sum(axis=0) > 0, usable, known)
    total = usable.sum(axis=0)
    with np.errstate(invalid="ignore"):
        scaled = usable / total
    mean = np.where(known[..., None], positions, 0) * scaled[..., None]
    return mean.sum(axis=0), np.where(total > 0, scaled, 0.0)
