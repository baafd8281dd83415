"""The mean and the standard deviation of a mixture of predictions."""

from __future__ import annotations

import numpy as np


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
    predicted = ~np.isnan(positions).any(axis=2)
    predicted &= predicted.all(axis=1)[:, None] | ~predicted.all(axis=1).any()
    usable = np.where(predicted, weights, 0.0)
    usable = np.where(usable.sum(axis=0) > 0, usable, predicted)
    total = usable.sum(axis=0)
    with np.errstate(invalid="ignore"):
        scaled = usable / total
    mean = np.where(predicted[..., None], positions, 0) * scaled[..., None]
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
    squared_distance = ((np.nan_to_num(positions) - mean) ** 2).mean(axis=2)
    variance = (weights * (errors**2 + np.where(weights > 0, squared_distance, 0))).sum(axis=0)
    deviation: np.ndarray = np.sqrt(variance)
    return deviation
