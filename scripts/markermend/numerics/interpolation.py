"""Curves and lines across stretches of a signal that are missing or not to be believed."""

from __future__ import annotations

import numpy as np

from markermend.numerics.intervals import runs


def bridge_cubic(signal: np.ndarray, detected: np.ndarray, reach: int) -> np.ndarray:
    """Signal with its detected samples replaced by cubic curves between what stands beside them.

    The slope at either border is the mean over `reach` samples beyond it. Detected samples at the end of a valid run
    have nothing to lean on and become NaN.
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
        slope0 = (out[before] - out[before - back]) / max(back, 1)
        slope1 = (out[after + ahead] - out[after]) / max(ahead, 1)
        span = after - before
        t = np.arange(1, span) / span
        out[start:stop] = (
            (1 + 2 * t) * (1 - t) ** 2 * out[before]
            + t * (1 - t) ** 2 * span * slope0
            + t**2 * (3 - 2 * t) * out[after]
            + t**2 * (t - 1) * span * slope1
        )
    return out


def bridge_linear(signal: np.ndarray, longest: int) -> np.ndarray:
    """A signal (frames, axes) with straight lines across gaps of at most so many samples."""
    out = signal.copy()
    missing = np.isnan(signal).any(axis=1)
    known = np.flatnonzero(~missing)
    for start, stop in runs(missing):
        if stop - start <= longest and start > 0 and stop < len(signal):
            for axis in range(signal.shape[1]):
                out[start:stop, axis] = np.interp(np.arange(start, stop), known, signal[known, axis])
    return out
