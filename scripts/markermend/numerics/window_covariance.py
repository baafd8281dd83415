"""WindowCovariance: what do short windows of a recording's residuals look like where nothing happens?

Some systems smooth their trajectories, some jitter; some bodies move fast. The covariance of short windows, but for
polynomials of a low order, tells how well a sample follows from those about it, and what is off that.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from markermend.numerics.intervals import runs

ROUNDS = 8
"""Iterations of the covariance; it changes by less than a percent after."""


@dataclass(frozen=True, eq=False)
class WindowCovariance:
    """Covariance of windows, but for polynomials of an order, and up to a factor that is another in each window.

    covariance: (n, n). order: polynomials up to it may take any size. Windows shorter than n have a part of it.
    """

    covariance: np.ndarray
    order: int

    def precision(self, size: int) -> np.ndarray:
        """Inverse of the covariance of windows of `size` samples, (size, size), 0 on polynomials.

        In units in which the middle sample is expected with a standard deviation of 1, given the others.
        """
        free = _free(size, self.order)
        inverse = free @ np.linalg.inv(free.T @ self.covariance[:size, :size] @ free) @ free.T
        return inverse / inverse[size // 2, size // 2]

    def degrees_of_freedom(self, size: int) -> int:
        """Degrees of freedom that polynomials leave to windows of `size` samples."""
        return size - self.order - 1


def sliding_windows(values: np.ndarray, size: int) -> np.ndarray:
    """All windows of (frames, 3): (windows, 3, size)."""
    return np.lib.stride_tricks.sliding_window_view(values, size, axis=0)


def fit_window_covariance(
    residual: np.ndarray, *, size: int, order: int, shrinkage: float, max_windows: int
) -> WindowCovariance:
    """Learn the regularity of residuals (frames, markers, 3), mm; NaN = missing, windows with gaps are left out.

    Tyler's M-estimator (Tyler 1987), which gives each window the same weight however large it is: artifacts, fast motion
    and lively markers do not dominate. shrinkage: part of the mean variance that is added to all. max_windows: windows used.
    Where there are too few windows to learn from, samples count as independent.
    """
    free = _free(size, order)
    step = max(1, 3 * residual.shape[0] * residual.shape[1] // max_windows)
    parts = [own.reshape(-1, size)[::step] @ free for own in _whole(residual, size)]
    seen = np.concatenate(parts) if parts else np.zeros((0, free.shape[1]))
    seen = seen[(seen**2).sum(axis=1) > 0]
    inner = np.eye(free.shape[1])
    if len(seen) > size:
        for _ in range(ROUNDS):
            weight = 1 / np.einsum("id,de,ie->i", seen, np.linalg.inv(inner), seen, optimize=True)
            inner = (seen * weight[:, None]).T @ seen
            inner = inner / (np.trace(inner) / len(inner)) + shrinkage * np.eye(len(inner))
    return WindowCovariance(free @ inner @ free.T, order)


def _whole(residual: np.ndarray, size: int) -> Iterator[np.ndarray]:
    """The windows of all markers that have no gap."""
    for m in range(residual.shape[1]):
        for start, stop in runs(~np.isnan(residual[:, m, 0])):
            if stop - start >= size:
                yield sliding_windows(residual[start:stop, m], size)


def _free(size: int, order: int) -> np.ndarray:
    """Orthonormal basis of what no polynomial of the order reaches in a window, (size, size - order - 1)."""
    basis = np.vander(np.linspace(-1, 1, size), order + 1)
    return np.linalg.svd(basis)[0][:, order + 1 :]
