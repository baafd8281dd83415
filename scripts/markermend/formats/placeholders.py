"""Numbers that programs write for missing samples, such as 9999 in all three coordinates."""

from __future__ import annotations

import numpy as np


def find_placeholders(positions: np.ndarray, *, min_distance_mm: float) -> np.ndarray:
    """Find the samples that are no measurements: three equal coordinates, repeated bit for bit, far from everything.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        Positions, mm; NaN = missing.
    min_distance_mm : float
        Smallest distance along an axis from all samples whose coordinates differ, mm.

    Returns
    -------
    ndarray of bool, shape (frames, markers)
        The placeholders.
    """
    x, y, z = np.moveaxis(positions, 2, 0)
    equal: np.ndarray = (x == y) & (y == z)
    if not equal.any():
        return equal
    others = positions[~equal & ~np.isnan(x)]
    if not len(others):
        return np.zeros_like(equal)
    numbers, count = np.unique(x[equal], return_counts=True)
    low, high = others.min(axis=0), others.max(axis=0)
    far = ((numbers[:, None] < low - min_distance_mm) | (numbers[:, None] > high + min_distance_mm)).any(axis=1)
    placeholders: np.ndarray = equal & np.isin(x, numbers[far & (count > 1)])
    return placeholders
