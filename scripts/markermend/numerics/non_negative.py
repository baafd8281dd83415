"""Least squares with coefficients that are not negative."""

from __future__ import annotations

import numpy as np

TOLERANCE = 1e-12
"""Smallest gradient that counts, in units of the largest one."""

ROWS = 100_000
"""Rows that are decomposed at once: the decomposition of millions would take several times their memory."""


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
    design, target = _reduced(design, target)
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


def _reduced(design: np.ndarray, target: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A problem of at most 1 + columns rows with the same solution, from one decomposition after the other of some of the rows."""
    columns, rows = design.shape[1], np.zeros((0, design.shape[1] + 1))
    for start in range(0, len(design), ROWS):
        own = slice(start, start + ROWS)
        some = np.concatenate([rows, np.column_stack([design[own], target[own]])])
        rows = np.asarray(np.linalg.qr(some, mode="r")) if len(some) > columns + 1 else some
    return rows[:, :columns], rows[:, columns]


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
