"""Predictions from a coordinate's own course, smoothed (skurowski2022 3.3.1): what is quicker than that is the residual."""

from __future__ import annotations

import numpy as np

from markermend.numerics import filters, intervals
from markermend.prediction.scene import Scene


class MovingMedian:
    """The median of a coordinate over a window about each frame (skurowski2022 eq 18)."""

    def __init__(self, *, window_s: float) -> None:
        """window_s: of the median."""
        self.window_s = window_s

    def residuals(self, scene: Scene, markers: np.ndarray | None = None) -> np.ndarray:
        """Observed minus smoothed, (frames, markers, 3), mm; NaN where missing and for markers not asked for."""
        window = intervals.samples(self.window_s, scene.rate, odd=True)
        out = np.full(scene.positions.shape, np.nan)
        for marker in range(scene.positions.shape[1]) if markers is None else markers:
            for axis in range(3):
                out[:, marker, axis] = self._high_pass(scene.positions[:, marker, axis], window)
        return out

    def _high_pass(self, signal: np.ndarray, window: int) -> np.ndarray:
        """Signal (frames,) less what is slow in it."""
        return signal - filters.moving_median(signal, window)


class SavitzkyGolay(MovingMedian):
    """The polynomial fitted to a coordinate over a window about each frame (skurowski2022 eq 6, 7)."""

    def __init__(self, *, window_s: float, order: int) -> None:
        """window_s, order: of the polynomial; the window is widened to what the order needs."""
        super().__init__(window_s=window_s)
        self.order = order

    def _high_pass(self, signal: np.ndarray, window: int) -> np.ndarray:
        """See MovingMedian."""
        return filters.high_pass(signal, max(window, 2 * self.order + 1), self.order)
