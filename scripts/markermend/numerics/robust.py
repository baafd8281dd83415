"""Building blocks of the detectors: robust scale, filters and morphology that never look across a gap.

A signal is a float vector with NaN where nothing was measured. Each function works on its valid runs one by one, keeps
its length, and leaves NaN where NaN was. Lengths are in samples; `samples` makes them from seconds.
"""

from __future__ import annotations

import numpy as np
from scipy import ndimage

NORMAL = 1.4826
"""Standard deviation of a normal distribution with median absolute deviation 1."""


def mad_std(values: np.ndarray) -> float:
    """Robust standard deviation about the median (1.4826 times the median absolute deviation); NaN ignored, 0 if all are."""
    finite = values[np.isfinite(values)]
    return float(NORMAL * np.median(np.abs(finite - np.median(finite)))) if finite.size else 0.0


def moving_median_across_gaps(signal: np.ndarray, window: int) -> np.ndarray:
    """Moving median that joins valid runs as if there were no gaps between: for scales, not for detection.

    Within half a window of the ends it stays what it is where the window is whole.
    """
    out = np.full(len(signal), np.nan)
    valid = np.flatnonzero(~np.isnan(signal))
    half = min(window, len(valid)) // 2
    if len(valid):
        median = ndimage.median_filter(signal[valid], 2 * half + 1, mode="nearest")
        out[valid] = median[np.clip(np.arange(len(valid)), half, len(valid) - 1 - half)]
    return out
