"""Low-rank matrix completion: the missing entries of a matrix from the principal components of the observed ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.numerics.interpolation import interpolate_missing
from markermend.numerics.patterns import group_rows


def complete_matrix(
    matrix: np.ndarray, *, explained: float, shrinkage: bool, tolerance: float, iterations: int
) -> tuple[np.ndarray, np.ndarray]:
    """Fill the missing entries of a matrix by its own low-rank approximation, iterated to convergence.

    The approximation consists of the column means and as many principal components as explain a share of the variance
    of the complete rows. Missing entries start as their conditional means under the complete rows' components; where
    there are no more complete rows than columns, as linear interpolation in time, which then also sets the rank.

    Parameters
    ----------
    matrix : np.ndarray
        Matrix (rows, columns), NaN = missing; rows in order of time, every column observed somewhere.
    explained : float
        Share of the variance that the components explain.
    shrinkage : bool
        Whether each component is damped by the share of noise in its variance, the noise being the mean variance of
        the components left out (probabilistic principal components). Without it the iteration alone decides between
        components that differ in missing entries only.
    tolerance : float
        The iteration ends when no missing entry moves by more than this, in the unit of the matrix.
    iterations : int
        Largest number of iterations.

    Returns
    -------
    filled : np.ndarray
        Complete matrix (rows, columns).
    misfit : np.ndarray
        Root-mean-square misfit of the observed entries after each iteration; it never grows without shrinkage.

    References
    ----------
    Troyanskaya et al. (2001), Bioinformatics 17(6) (SVDimpute); Tipping & Bishop (1999), J. R. Stat. Soc. B 61(3).
    """
    missing = np.isnan(matrix)
    incomplete = missing.any(axis=1)
    filled, rank = _initial(matrix, incomplete, explained)
    absent, some = missing[incomplete], filled[incomplete]
    # Only incomplete rows change: the others enter by their sums, about a fixed point near the mean.
    origin = filled.mean(axis=0)
    complete, some = filled[~incomplete] - origin, some - origin
    products, total = complete.T @ complete, complete.sum(axis=0)
    misfit = []
    for _ in range(iterations):
        mean = (total + some.sum(axis=0)) / len(matrix)
        scatter = products + some.T @ some - len(matrix) * np.outer(mean, mean)
        components = _Components.of(scatter, rank, shrinkage=shrinkage)
        centred = some - mean
        change = components.change(centred)[absent]
        square = components.residual_square() - (change**2).sum()
        misfit.append(np.sqrt(max(square, 0.0) / np.count_nonzero(~missing)))
        some[absent] += change
        if np.abs(change).max(initial=0.0) <= tolerance:
            break
    filled[missing] = (some + origin)[absent]
    return filled, np.array(misfit)


@dataclass(frozen=True)
class _Components:
    """The leading components of a scatter matrix: basis (columns, rank), squared sizes (rank,), damping (rank,).

    omitted: squared sizes of the components left out, ascending.
    """

    basis: np.ndarray
    sizes: np.ndarray
    damping: np.ndarray
    omitted: np.ndarray

    @classmethod
    def of(cls, scatter: np.ndarray, rank: int, *, shrinkage: bool) -> _Components:
        """Decompose a scatter matrix (columns, columns)."""
        sizes, vectors = np.linalg.eigh(scatter)
        sizes = np.maximum(sizes, 0.0)
        basis, kept = vectors[:, len(vectors) - rank :], sizes[len(sizes) - rank :]
        omitted = sizes[: len(sizes) - rank]
        noise = float(omitted.mean()) if shrinkage and len(omitted) else 0.0
        damping = np.maximum(kept - noise, 0.0) / np.maximum(kept, 1e-300)
        return cls(basis, kept, damping, omitted)

    def change(self, centred: np.ndarray) -> np.ndarray:
        """Approximation minus centred rows (n, columns)."""
        difference: np.ndarray = (centred @ self.basis * self.damping) @ self.basis.T - centred
        return difference

    def residual_square(self) -> float:
        """Sum of squares that the approximation leaves of all rows, observed and filled."""
        return float(self.omitted.sum() + ((1 - self.damping) ** 2 * self.sizes).sum())


def _initial(matrix: np.ndarray, incomplete: np.ndarray, explained: float) -> tuple[np.ndarray, int]:
    """First guess of the complete matrix, and the rank of its approximation."""
    filled = np.column_stack([interpolate_missing(column) for column in matrix.T])
    complete = filled[~incomplete]
    enough = len(complete) > matrix.shape[1]
    rank = _rank(complete if enough else filled, explained)
    if enough and incomplete.any():
        filled[incomplete] = conditional_mean(complete, matrix[incomplete], rank)
    return filled, rank


def conditional_mean(complete: np.ndarray, incomplete: np.ndarray, rank: int) -> np.ndarray:
    """Fill incomplete rows with their conditional means under the probabilistic components of complete rows.

    Parameters
    ----------
    complete : np.ndarray
        Rows (n, columns) without NaN.
    incomplete : np.ndarray
        Rows (m, columns), NaN = missing.
    rank : int
        Number of principal components.

    Returns
    -------
    np.ndarray
        Rows (m, columns) without NaN.

    References
    ----------
    Tipping & Bishop (1999), J. R. Stat. Soc. B 61(3).
    """
    mean = complete.mean(axis=0)
    sizes, vectors = np.linalg.eigh(np.cov(complete, rowvar=False))
    basis, kept = vectors[:, len(sizes) - rank :], np.maximum(sizes[len(sizes) - rank :], 0.0)
    noise = np.maximum(sizes[: len(sizes) - rank], 0.0).mean() if rank < len(sizes) else 0.0
    # Rounding leaves no component without any noise.
    penalty = np.diag(np.maximum(noise, 1e-10 * kept[-1]) / np.maximum(kept, 1e-10 * kept[-1]))
    out = incomplete.copy()
    for absent, rows in group_rows(np.isnan(incomplete)):
        seen = basis[~absent]
        scores = np.linalg.solve(seen.T @ seen + penalty, seen.T @ (incomplete[rows] - mean)[:, ~absent].T)
        out[np.ix_(rows, np.flatnonzero(absent))] = (mean + (basis @ scores).T)[:, absent]
    return out


def _rank(matrix: np.ndarray, explained: float) -> int:
    """Number of principal components of a matrix that explain the share of its variance."""
    centred = matrix - matrix.mean(axis=0)
    variance = np.maximum(np.linalg.eigvalsh(centred.T @ centred)[::-1], 0.0)
    return components_for_share(variance, explained)


def components_for_share(sizes: np.ndarray, share: float) -> int:
    """Count the leading components that make up a share of the total.

    Parameters
    ----------
    sizes : np.ndarray
        Variances or singular values (n,), descending.
    share : float
        Share of their sum.

    Returns
    -------
    int
        Number of components, at least one and at most n.
    """
    return min(int(np.searchsorted(np.cumsum(sizes), share * sizes.sum())) + 1, len(sizes))
