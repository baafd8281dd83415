"""Bridges across stretches of a signal: cubic Hermite curves over detected samples, straight lines over gaps."""

from __future__ import annotations

import numpy as np

from markermend.numerics.intervals import runs


def bridge_cubic(signal: np.ndarray, detected: np.ndarray, reach: int) -> np.ndarray:
    """Replace the detected samples of a signal by cubic Hermite curves between the adjacent samples.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), NaN = missing.
    detected : np.ndarray
        Samples to replace, bool (frames,).
    reach : int
        Samples beyond either border whose mean slope is that at the border; fewer where the run ends earlier.

    Returns
    -------
    np.ndarray
        Bridged signal (frames,); detected samples at the end of a valid run become NaN.
    """
    out = np.where(detected, np.nan, signal)
    valid = ~np.isnan(out)
    for start, stop in runs(detected & ~np.isnan(signal)):
        before, after = start - 1, stop
        if before < 0 or after >= len(signal) or not (valid[before] and valid[after]):
            continue
        left, right = np.flatnonzero(~valid[:before]), np.flatnonzero(~valid[after:])
        back = min(reach, before - (left[-1] + 1 if left.size else 0))
        ahead = min(reach, (right[0] if right.size else len(signal) - after) - 1)
        slope_before = (out[before] - out[before - back]) / max(back, 1)
        slope_after = (out[after + ahead] - out[after]) / max(ahead, 1)
        out[start:stop] = _hermite(out[before], out[after], slope_before, slope_after, after - before)
    return out


def _hermite(value0: float, value1: float, slope0: float, slope1: float, span: int) -> np.ndarray:
    """Cubic Hermite curve at the span - 1 samples between two borders, whose values and slopes per sample it has."""
    t = np.arange(1, span) / span
    curve: np.ndarray = (
        (1 + 2 * t) * (1 - t) ** 2 * value0
        + t * (1 - t) ** 2 * span * slope0
        + t**2 * (3 - 2 * t) * value1
        + t**2 * (t - 1) * span * slope1
    )
    return curve


def interpolate_missing(values: np.ndarray) -> np.ndarray:
    """Fill the missing entries of a vector by linear interpolation; the nearest entry stands in beyond the ends.

    Parameters
    ----------
    values : np.ndarray
        Vector (n,), NaN = missing; at least one entry is known.

    Returns
    -------
    np.ndarray
        Vector (n,) without NaN.
    """
    known = np.flatnonzero(~np.isnan(values))
    filled: np.ndarray = np.interp(np.arange(len(values)), known, values[known])
    return filled


def bridge_linear(signal: np.ndarray, max_gap: int) -> np.ndarray:
    """Draw straight lines across the short gaps of a signal.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames, axes), NaN = missing.
    max_gap : int
        Longest gap that is bridged, samples.

    Returns
    -------
    np.ndarray
        Bridged copy (frames, axes); longer gaps and those at either end stay NaN.
    """
    out = signal.copy()
    missing = np.isnan(signal).any(axis=1)
    known = np.flatnonzero(~missing)
    for start, stop in runs(missing):
        if stop - start <= max_gap and start > 0 and stop < len(signal):
            for axis in range(signal.shape[1]):
                out[start:stop, axis] = np.interp(np.arange(start, stop), known, signal[known, axis])
    return out
