"""Low-rank completion: the missing entries of a matrix by singular vectors of what is there."""

from __future__ import annotations

import numpy as np


def complete_matrix(
    matrix: np.ndarray, *, explained: float, shrinkage: bool, tolerance: float, iterations: int
) -> tuple[np.ndarray, np.ndarray]:
    """Fill the missing entries of a matrix by its own low-rank approximation, iterated to convergence.

    matrix: (rows, columns), NaN = missing, every column observed somewhere; rows in order of time. Missing entries
    start as what the components of the complete rows make of the rest of their row; where there are no more complete
    rows than columns, as straight lines in time. The approximation is the column means plus so many singular vectors as
    explain the share `explained` of the variance of the complete rows (or of those lines). shrinkage: damp each
    component by the share of noise in its variance, the noise being what the others leave over (probabilistic principal
    components); otherwise nothing tells components apart that only missing entries would show. Stops when no missing
    entry moves by more than `tolerance`. Returns the filled matrix and, per iteration, the root mean square misfit of
    the observed entries, which never grows without shrinkage.
    """
    missing = np.isnan(matrix)
    filled = np.column_stack([_bridged(column) for column in matrix.T])
    holed = missing.any(axis=1)
    whole = filled[~holed]
    trusted = len(whole) > matrix.shape[1]
    rank = _rank(whole if trusted else filled, explained)
    if trusted and holed.any():
        filled[holed] = conditional_mean(whole, matrix[holed], rank)
    absent, some = missing[holed], filled[holed]
    # Only rows with holes change: the others enter by their sums, about a fixed point near the mean.
    origin = filled.mean(axis=0)
    whole, some = filled[~holed] - origin, some - origin
    products, total = whole.T @ whole, whole.sum(axis=0)
    misfit = []
    for _ in range(iterations):
        mean = (total + some.sum(axis=0)) / len(matrix)
        sizes, vectors = np.linalg.eigh(products + some.T @ some - len(matrix) * np.outer(mean, mean))
        sizes = np.maximum(sizes, 0.0)
        basis, kept, rest = vectors[:, len(vectors) - rank :], sizes[len(sizes) - rank :], sizes[: len(sizes) - rank]
        noise = float(rest.mean()) if shrinkage and len(rest) else 0.0
        damping = np.maximum(kept - noise, 0.0) / np.maximum(kept, 1e-300)
        centred = some - mean
        change = ((centred @ basis * damping) @ basis.T - centred)[absent]
        apart = rest.sum() + ((1 - damping) ** 2 * kept).sum() - (change**2).sum()
        misfit.append(np.sqrt(max(apart, 0.0) / np.count_nonzero(~missing)))
        some[absent] += change
        if np.abs(change).max(initial=0.0) <= tolerance:
            break
    filled[missing] = (some + origin)[absent]
    return filled, np.array(misfit)


def _bridged(column: np.ndarray) -> np.ndarray:
    """A copy with straight lines over what is missing."""
    known = np.flatnonzero(~np.isnan(column))
    return np.interp(np.arange(len(column)), known, column[known])


def conditional_mean(whole: np.ndarray, holed: np.ndarray, rank: int) -> np.ndarray:
    """Rows with missing entries, filled with their expectation under the complete rows' probabilistic components."""
    mean = whole.mean(axis=0)
    sizes, vectors = np.linalg.eigh(np.cov(whole, rowvar=False))
    basis, kept = vectors[:, len(sizes) - rank :], np.maximum(sizes[len(sizes) - rank :], 0.0)
    noise = np.maximum(sizes[: len(sizes) - rank], 0.0).mean() if rank < len(sizes) else 0.0
    # Rounding leaves no component without any noise.
    penalty = np.diag(np.maximum(noise, 1e-10 * kept[-1]) / np.maximum(kept, 1e-10 * kept[-1]))
    out = holed.copy()
    patterns, inverse = np.unique(np.isnan(holed), axis=0, return_inverse=True)
    for number, absent in enumerate(patterns):
        rows = np.flatnonzero(inverse.reshape(-1) == number)
        seen = basis[~absent]
        scores = np.linalg.solve(seen.T @ seen + penalty, seen.T @ (holed[rows] - mean)[:, ~absent].T)
        out[np.ix_(rows, np.flatnonzero(absent))] = (mean + (basis @ scores).T)[:, absent]
    return out


def _rank(matrix: np.ndarray, explained: float) -> int:
    """How many singular vectors of the centred matrix explain the share of its variance."""
    centred = matrix - matrix.mean(axis=0)
    variance = np.maximum(np.linalg.eigvalsh(centred.T @ centred)[::-1], 0.0)
    return components_for_share(variance, explained)


def components_for_share(sizes: np.ndarray, share: float) -> int:
    """How many of the sizes (descending) make up the share of their sum, at least one."""
    return min(int(np.searchsorted(np.cumsum(sizes), share * sizes.sum())) + 1, len(sizes))
