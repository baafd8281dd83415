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


def cubic_spline(times: np.ndarray, values: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Evaluate the cubic spline through few knots whose third derivative is continuous at the second and the last but one (not-a-knot).

    Parameters
    ----------
    times : np.ndarray
        Times of the knots (n,), ascending; two at least. Two give a straight line, three a parabola.
    values : np.ndarray
        Values (n, axes) at the knots.
    at : np.ndarray
        Times (m,) at which the spline is evaluated.

    Returns
    -------
    np.ndarray
        Values (m, axes).

    References
    ----------
    de Boor (1978), A Practical Guide to Splines, chapter IV.
    """
    span = np.diff(times)
    slope = np.diff(values, axis=0) / span[:, None]
    bend = _second_derivatives(span, slope)
    left = np.clip(np.searchsorted(times, at, side="right") - 1, 0, len(span) - 1)
    after, before, width = (at - times[left])[:, None], (times[left + 1] - at)[:, None], span[left][:, None]
    line = values[left] + after * slope[left]
    curve: np.ndarray = line - after * before / (6 * width) * (
        (width + before) * bend[left] + (width + after) * bend[left + 1]
    )
    return curve


def _second_derivatives(span: np.ndarray, slope: np.ndarray) -> np.ndarray:
    """Second derivatives (n, axes) of a not-a-knot spline at its knots, given spans (n - 1,) and slopes (n - 1, axes) of the chords."""
    knots = len(span) + 1
    if knots < 4:
        constant = np.zeros(slope.shape[1]) if knots == 2 else 2 * (slope[1] - slope[0]) / span.sum()
        return np.tile(constant, (knots, 1))
    inside = np.arange(1, knots - 1)
    system, right = np.zeros((knots, knots)), np.zeros((knots, slope.shape[1]))
    system[inside, inside - 1], system[inside, inside + 1] = span[:-1], span[1:]
    system[inside, inside] = 2 * (span[:-1] + span[1:])
    right[inside] = 6 * np.diff(slope, axis=0)
    system[0, :3] = span[1], -(span[0] + span[1]), span[0]
    system[-1, -3:] = span[-1], -(span[-1] + span[-2]), span[-2]
    return np.linalg.solve(system, right)


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
