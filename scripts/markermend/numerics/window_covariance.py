"""Covariance of short windows of residuals up to scale: how well a sample is predicted by those around it.

Some systems smooth their trajectories, others jitter, and some bodies move fast. The covariance is estimated from each
recording, on the complement of polynomials of a low order, and up to a factor of each window.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from markermend.numerics.intervals import runs

ITERATIONS = 8
"""Iterations of the estimator; the covariance changes by less than a percent after them."""


@dataclass(frozen=True, eq=False)
class WindowCovariance:
    """Covariance of windows on the complement of polynomials, up to a factor that differs between windows.

    Attributes
    ----------
    covariance : np.ndarray
        Covariance (n, n); windows of fewer samples have its leading part.
    order : int
        Polynomials up to this order may take any size.
    """

    covariance: np.ndarray
    order: int

    def precision(self, size: int) -> np.ndarray:
        """Invert the covariance of windows on the complement of the polynomials.

        Parameters
        ----------
        size : int
            Length of the windows, samples, at most n.

        Returns
        -------
        np.ndarray
            Precision (size, size), 0 on polynomials, scaled such that the middle sample has a conditional standard
            deviation of 1 given the others.
        """
        return _precision(self, size)

    def degrees_of_freedom(self, size: int) -> int:
        """Count the degrees of freedom that polynomials leave to a window.

        Parameters
        ----------
        size : int
            Length of the window, samples.

        Returns
        -------
        int
            Degrees of freedom of one axis.
        """
        return size - self.order - 1


@lru_cache(maxsize=256)
def _precision(covariance: WindowCovariance, size: int) -> np.ndarray:
    """Precision of windows of a size, read-only; see `WindowCovariance.precision`."""
    basis = _polynomial_complement(size, covariance.order)
    inverse = basis @ np.linalg.inv(basis.T @ covariance.covariance[:size, :size] @ basis) @ basis.T
    precision: np.ndarray = inverse / inverse[size // 2, size // 2]
    precision.setflags(write=False)
    return precision


def sliding_windows(values: np.ndarray, size: int) -> np.ndarray:
    """View all windows of a signal.

    Parameters
    ----------
    values : np.ndarray
        Signal (frames, axes).
    size : int
        Length of the windows, samples, at most as many as there are frames.

    Returns
    -------
    np.ndarray
        Read-only view (frames - size + 1, axes, size).
    """
    shape, step = (len(values) - size + 1, *values.shape[1:], size), values.strides[0]
    # A third of the time of sliding_window_view, which counts where windows are small.
    return np.lib.stride_tricks.as_strided(values, shape, (*values.strides, step), writeable=False)


def fit_window_covariance(
    residual: np.ndarray, *, size: int, order: int, shrinkage: float, max_windows: int
) -> WindowCovariance:
    """Estimate the covariance of windows by Tyler's M-estimator, regularised by shrinkage.

    Every window has the same weight however large it is: artifacts, fast motion and noisy markers do not dominate.

    Parameters
    ----------
    residual : np.ndarray
        Residuals (frames, markers, 3), mm, NaN = missing: windows with a gap do not count.
    size : int
        Length of the windows, samples.
    order : int
        Order of the polynomials that are projected out.
    shrinkage : float
        Part of the mean variance that is added to every direction.
    max_windows : int
        Largest number, about, of windows that are used.

    Returns
    -------
    WindowCovariance
        The covariance; that of independent samples where there are too few windows.

    References
    ----------
    Tyler (1987), "A distribution-free M-estimator of multivariate scatter", Ann. Stat. 15(1).
    """
    basis = _polynomial_complement(size, order)
    step = max(1, 3 * residual.shape[0] * residual.shape[1] // max_windows)
    parts = [own.reshape(-1, size)[::step] @ basis for own in _complete_windows(residual, size)]
    windows = np.concatenate(parts) if parts else np.zeros((0, basis.shape[1]))
    windows = windows[(windows**2).sum(axis=1) > 0]
    scatter = np.eye(basis.shape[1])
    if len(windows) > size:
        for _ in range(ITERATIONS):
            weight = 1 / np.einsum("id,de,ie->i", windows, np.linalg.inv(scatter), windows, optimize=True)
            scatter = (windows * weight[:, None]).T @ windows
            scatter = scatter / (np.trace(scatter) / len(scatter)) + shrinkage * np.eye(len(scatter))
    return WindowCovariance(basis @ scatter @ basis.T, order)


def _complete_windows(residual: np.ndarray, size: int) -> Iterator[np.ndarray]:
    """The windows (n, 3, size) of all markers that have no gap."""
    for m in range(residual.shape[1]):
        for start, stop in runs(~np.isnan(residual[:, m, 0])):
            if stop - start >= size:
                yield sliding_windows(residual[start:stop, m], size)


def _polynomial_complement(size: int, order: int) -> np.ndarray:
    """Orthonormal basis (size, size - order - 1) of the windows orthogonal to all polynomials of the order."""
    polynomials = np.vander(np.linspace(-1, 1, size), order + 1)
    return np.linalg.svd(polynomials)[0][:, order + 1 :]
