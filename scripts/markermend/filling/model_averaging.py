"""Probabilistic model averaging: weights by the likelihood of distances to references, and the weighted mean."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.numerics.kernel_density import Density


def pma_likelihood(
    positions: np.ndarray, references: np.ndarray, densities: Sequence[Density], *, window: int, floor: float
) -> np.ndarray:
    """Compute the likelihood of positions from their distances to references.

    Parameters
    ----------
    positions : ndarray, shape (members, n, 3)
        Predictions of each member, mm.
    references : ndarray, shape (n, k, 3)
        Positions of the references, mm; one that is missing (NaN) does not count in that frame.
    densities : sequence of Density
        Densities of the k distances.
    window : int
        Frames of the moving average over the likelihoods.
    floor : float
        Least likelihood; positions that are NaN get it.

    Returns
    -------
    ndarray, shape (members, n)
        Likelihoods.

    References
    ----------
    tits2018, eq 20-23.
    """
    distance = np.linalg.norm(positions[:, :, None] - references, axis=3)
    logarithm = np.zeros(positions.shape[:2])
    for r, density in enumerate(densities):
        seen = ~np.isnan(references[:, r]).any(axis=1)
        logarithm[:, seen] += density.log_density(distance[:, seen, r])
    likelihood = np.maximum(np.exp(np.nan_to_num(logarithm, nan=-np.inf)), floor)
    return _moving_average(likelihood, window)


def weighted_mean(positions: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Average the predictions of several members.

    Members without a prediction do not count. Where all weights vanish, all members with a prediction weigh the same.
    Where any member predicts all frames, those that do not are left out, so that no jump arises where one ends.

    Parameters
    ----------
    positions : ndarray, shape (members, n, 3)
        Predictions, mm; NaN where a member has none.
    weights : ndarray, shape (members, n)
        Weights of the members.

    Returns
    -------
    mean : ndarray, shape (n, 3)
        Weighted mean, mm; NaN where no member has a prediction.
    scaled : ndarray, shape (members, n)
        The weights used, scaled to the sum 1; 0 where no member has a prediction.

    References
    ----------
    tits2018, eq 24.
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


def mixture_deviation(positions: np.ndarray, mean: np.ndarray, errors: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Compute the standard deviation of the mixture of several predictions.

    Parameters
    ----------
    positions : ndarray, shape (members, n, 3)
        Predictions, mm; NaN where a member has none.
    mean : ndarray, shape (n, 3)
        Their weighted mean, mm.
    errors : ndarray, shape (members, n)
        Standard deviation of each prediction per axis, mm.
    weights : ndarray, shape (members, n)
        Weights with the sum 1.

    Returns
    -------
    ndarray, shape (n,)
        Standard deviation per axis, mm: the members' own variances and that of their predictions together.
    """
    apart = ((np.nan_to_num(positions) - mean) ** 2).mean(axis=2)
    variance = (weights * (errors**2 + np.where(weights > 0, apart, 0))).sum(axis=0)
    deviation: np.ndarray = np.sqrt(variance)
    return deviation


def _moving_average(values: np.ndarray, window: int) -> np.ndarray:
    """Centred moving average along the second axis; at the ends over the frames that there are."""
    if window <= 1:
        return values
    kernel = np.ones(window)
    full = np.stack([np.convolve(row, kernel) for row in values])
    count = np.convolve(np.ones(values.shape[1]), kernel)
    offset = (window - 1) // 2
    return (full / count)[:, offset : offset + values.shape[1]]
