"""Distances of points to others at the same time."""

from __future__ import annotations

import numpy as np


def distances(points: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Compute the distances of a point to others in each frame.

    Parameters
    ----------
    points : ndarray of float, shape (frames, 3)
        The point in each frame, mm; NaN = missing.
    others : ndarray of float, shape (frames, n, 3)
        The others in each frame, mm; NaN = missing.

    Returns
    -------
    ndarray of float, shape (frames, n)
        Distances, mm; NaN where either is missing.
    """
    difference = others - points[:, None]
    distance: np.ndarray = np.sqrt(np.einsum("tni,tni->tn", difference, difference))
    return distance
