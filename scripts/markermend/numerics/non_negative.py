"""Least squares with coefficients that are not negative."""

from __future__ import annotations

import numpy as np

TOLERANCE = 1e-12
"""Smallest gradient that counts, in units of the largest one."""


def non_negative_least_squares(design: np.ndarray, target: np.ndarray) -> np.ndarray:
    """Fit a target by few columns with coefficients of at least 0, by the active set method.

    Parameters
    ----------
    design : np.ndarray
        Columns (n, columns).
    target : np.ndarray
        Target (n,).

    Returns
    -------
    np.ndarray
        Coefficients (columns,).

    References
    ----------
    Lawson, Hanson (1974), Solving Least Squares Problems, chapter 23.
    """
    if len(design) > design.shape[1]:
        orthogonal, design = np.linalg.qr(design)
        target = orthogonal.T @ target
    fitted, used = np.zeros(design.shape[1]), np.zeros(design.shape[1], bool)
    least = TOLERANCE * float(np.abs(design.T @ target).max(initial=0.0))
    for _ in range(3 * len(fitted)):
        gradient = design.T @ (target - design @ fitted)
        gradient[used] = 0
        if not (gradient > least).any():
            break
        used[np.argmax(gradient)] = True
        fitted = _feasible(design, target, fitted, used)
    return fitted


def _feasible(design: np.ndarray, target: np.ndarray, fitted: np.ndarray, used: np.ndarray) -> np.ndarray:
    """The coefficients of the used columns (mask, altered), of which those that would be negative are used no more."""
    while True:
        best = np.zeros_like(fitted)
        best[used] = np.linalg.lstsq(design[:, used], target, rcond=None)[0]
        negative = used & (best <= 0)
        if not negative.any():
            return best
        step = float((fitted[negative] / (fitted[negative] - best[negative])).min())
        fitted = fitted + step * (best - fitted)
        used &= fitted > TOLERANCE * fitted.max()
        fitted[~used] = 0
