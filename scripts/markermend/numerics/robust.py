"""Robust estimates of scale and location that outliers hardly move."""

from __future__ import annotations

import numpy as np

MAD_TO_STD = 1.4826
"""Standard deviation of a normal distribution whose median absolute deviation is 1."""


def mad_std(values: np.ndarray) -> float:
    """Estimate the standard deviation from the median absolute deviation (MAD) about the median.

    Parameters
    ----------
    values : np.ndarray
        Values of any shape; NaN and infinite ones are ignored.

    Returns
    -------
    float
        1.4826 times the MAD, in the unit of the values; 0 where no value is finite.
    """
    finite = values[np.isfinite(values)]
    return float(MAD_TO_STD * np.median(np.abs(finite - np.median(finite)))) if finite.size else 0.0


def moving_median_across_gaps(signal: np.ndarray, window: int) -> np.ndarray:
    """Take the moving median of the valid samples as if no gap lay between them.

    Meant for slowly varying scales, not for detection.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), NaN = missing.
    window : int
        Length of the window, valid samples; at most as many as there are.

    Returns
    -------
    np.ndarray
        Medians (frames,); within half a window of the ends, that of the nearest whole window. NaN where the signal is.
    """
    from scipy import ndimage  # 0.15 s to import, which many stages do not need

    out = np.full(len(signal), np.nan)
    valid = np.flatnonzero(~np.isnan(signal))
    half = min(window, len(valid)) // 2
    if len(valid):
        median = ndimage.median_filter(signal[valid], 2 * half + 1, mode="nearest")
        out[valid] = median[np.clip(np.arange(len(valid)), half, len(valid) - 1 - half)]
    return out
