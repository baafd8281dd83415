"""Choice of the points that say most about all others, by the pivots of a Cholesky factor."""

from __future__ import annotations

import numpy as np


def pivoted_cholesky(covariance: np.ndarray, *, tolerance: float) -> tuple[np.ndarray, np.ndarray]:
    """Factor a covariance; each pivot is the point of the largest variance given the pivots before it.

    Parameters
    ----------
    covariance : np.ndarray
        Covariance of n points (n, n).
    tolerance : float
        No pivot is added where the variance of all points, given the pivots, is below this.

    Returns
    -------
    pivots : np.ndarray
        Indices of the pivots (r,).
    factor : np.ndarray
        Lower triangular Cholesky factor (r, r) of the covariance of the pivots.

    References
    ----------
    Harbrecht, Peters & Schneider (2012), Applied Numerical Mathematics 62, algorithm 1.
    """
    from scipy.linalg.lapack import dpstrf  # 0.1 s to import, and most detectors never get here

    full, order, rank, _ = dpstrf(covariance, tol=tolerance, lower=1)
    return order[:rank] - 1, np.tril(full[:rank, :rank])
