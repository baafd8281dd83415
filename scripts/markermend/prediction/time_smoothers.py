"""Smoothers of each coordinate's own trajectory as predictors: the residual is what is faster (skurowski2022 3.3.1)."""

from __future__ import annotations

import numpy as np

from markermend.numerics import filters, intervals
from markermend.prediction.scene import Scene


class MovingMedian:
    """The moving median of each coordinate (skurowski2022 eq 18).

    Parameters
    ----------
    window_s : float
        Length of the window, s.
    """

    def __init__(self, *, window_s: float) -> None:
        self.window_s = window_s

    def residuals(self, scene: Scene, markers: np.ndarray | None = None) -> np.ndarray:
        """Subtract the smoothed trajectory from the observed one. See `ResidualSource.residuals`."""
        window = intervals.samples(self.window_s, scene.rate, odd=True)
        out = np.full(scene.positions.shape, np.nan)
        for marker in range(scene.positions.shape[1]) if markers is None else markers:
            for axis in range(3):
                out[:, marker, axis] = self._high_pass(scene.positions[:, marker, axis], window)
        return out

    def _high_pass(self, signal: np.ndarray, window: int) -> np.ndarray:
        """Signal (frames,) minus its smooth over a centred window of samples."""
        rest: np.ndarray = signal - filters.moving_median(signal, window)
        return rest


class SavitzkyGolay(MovingMedian):
    """The Savitzky-Golay filter of each coordinate (skurowski2022 eq 6, 7).

    Parameters
    ----------
    window_s : float
        Length of the window, s; it is widened where the order needs more samples.
    order : int
        Order of the polynomial.
    """

    def __init__(self, *, window_s: float, order: int) -> None:
        super().__init__(window_s=window_s)
        self.order = order

    def _high_pass(self, signal: np.ndarray, window: int) -> np.ndarray:
        """See MovingMedian."""
        return filters.high_pass(signal, max(window, 2 * self.order + 1), self.order)
