"""Order statistics of few values, for whole arrays of them at once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def sorted_from(values: Sequence[np.ndarray], rank: int) -> list[np.ndarray]:
    """Sort corresponding elements of arrays from a rank upwards, without branches and without copies of columns.

    Parameters
    ----------
    values : sequence of np.ndarray
        The arrays, of one shape, without NaN.
    rank : int
        The smallest rank that is needed.

    Returns
    -------
    list of np.ndarray
        Arrays of which those from the rank on have the elements of that rank.
    """
    ranked = list(values)
    for last in range(len(ranked) - 1, max(rank, 1) - 1, -1):
        for k in range(last):
            low, high = ranked[k], ranked[k + 1]
            ranked[k], ranked[k + 1] = np.minimum(low, high), np.maximum(low, high)
    return ranked


def median(values: Sequence[np.ndarray]) -> np.ndarray:
    """Take the median of corresponding elements of few arrays.

    Parameters
    ----------
    values : sequence of np.ndarray
        The arrays, of one shape, without NaN; one at least.

    Returns
    -------
    np.ndarray
        Medians, of their shape.
    """
    half = len(values) // 2
    ranked = sorted_from(values, half - 1 if len(values) % 2 == 0 else half)
    return (ranked[half - 1] + ranked[half]) / 2 if len(values) % 2 == 0 else ranked[half]
