"""The shape of a drift in a residual: its extent, its height, and whether the residual is at its baseline before and after."""

from __future__ import annotations

import numpy as np

from markermend.numerics.matched_filter import raised_cosine

LENGTH_FACTORS = (0.3, 0.36, 0.43, 0.5, 0.6, 0.72, 0.85, 1.0, 1.2, 1.45, 1.75, 2.1)
"""Multiples of the length of the template that are tried to fit where a drift begins and ends."""

BASELINE_LENGTHS = 3
"""The baseline is the median over this many lengths of a drift on either side."""


def fit_extent(residual: np.ndarray, peak: int, length: int, *, flank: float) -> tuple[int, int]:
    """Fit where a drift begins and ends: raised-cosine pulses of several lengths and shifts, by least squares.

    Parameters
    ----------
    residual : np.ndarray
        Residual (frames, 3), mm, NaN = missing.
    peak : int
        Frame at which the drift was found.
    length : int
        Length of the template by which it was found, frames.
    flank : float
        Part of the length on either side that is fitted as well.

    Returns
    -------
    tuple[int, int]
        The drift, [start, stop), inside the recording.
    """
    longest = int(LENGTH_FACTORS[-1] * length)
    reach = longest // 2 + int(flank * length)
    window = np.arange(max(0, peak - reach), min(len(residual), peak + reach + 1))
    known = ~np.isnan(residual[window]).any(axis=1)
    window = window[known]
    values = residual[window] - residual[window].mean(axis=0)
    tried = [
        (peak + shift - own // 2, own)
        for own in (int(factor * length) for factor in LENGTH_FACTORS)
        for shift in range(-own // 4, own // 4 + 1, max(1, own // 16))
    ]
    inside = [(start, own) for start, own in tried if start > 0 and start + own < len(residual)]
    best = (0.0, peak - length // 2, peak - length // 2 + length)
    if inside:
        starts, lengths = np.array(inside).T
        pulses = raised_cosine((window - starts[:, None] + 0.5) / lengths[:, None])
        pulses -= pulses.mean(axis=1, keepdims=True)
        explained = ((pulses @ values) ** 2).sum(axis=1) / np.einsum("kn,kn->k", pulses, pulses)
        best = max(best, *zip(explained.tolist(), starts.tolist(), (starts + lengths).tolist(), strict=True))
    return best[1], best[2]


def displacement(residual: np.ndarray, start: int, stop: int, *, flank: float) -> np.ndarray:
    """Measure how far a residual in the middle of a drift is from where it is on either side.

    Parameters
    ----------
    residual : np.ndarray
        Residual (frames, axes), mm, NaN = missing.
    start, stop : int
        The drift, [start, stop).
    flank : float
        Part of its length that is taken on either side.

    Returns
    -------
    np.ndarray
        Median of the middle third less the mean of the medians of both sides (axes,), mm; NaN where one is unknown.
    """
    side, third = int(np.ceil(flank * (stop - start))), (stop - start) // 3
    before, after = residual[max(0, start - side) : start], residual[stop : stop + side]
    middle = known_median(residual[start + third : stop - third])
    displaced: np.ndarray = middle - (known_median(before) + known_median(after)) / 2
    return displaced


def height(residual: np.ndarray, start: int, stop: int, *, flank: float) -> float:
    """Measure the height of a drift: the length of its displacement.

    Parameters
    ----------
    residual : np.ndarray
        Residual (frames, axes), mm, NaN = missing.
    start, stop : int
        The drift, [start, stop).
    flank : float
        Part of its length that is taken on either side.

    Returns
    -------
    float
        The height, mm; NaN where it is unknown.
    """
    return float(np.linalg.norm(displacement(residual, start, stop, flank=flank)))


def baseline_deviation(residual: np.ndarray, start: int, stop: int, *, flank: float) -> float:
    """Measure how far a residual is from its baseline just before or just after a drift.

    Parameters
    ----------
    residual : np.ndarray
        Residual (frames, axes), mm, NaN = missing.
    start, stop : int
        The drift, [start, stop).
    flank : float
        Part of its length that is taken on either side.

    Returns
    -------
    float
        The larger of the two deviations, mm.
    """
    side, around = int(np.ceil(flank * (stop - start))), BASELINE_LENGTHS * (stop - start)
    baseline = known_median(residual[max(0, start - around) : stop + around])
    sides = residual[max(0, start - side) : start], residual[stop : stop + side]
    return float(max(np.linalg.norm(known_median(side) - baseline) for side in sides))


def known_median(values: np.ndarray) -> np.ndarray:
    """Take the median of complete samples.

    Parameters
    ----------
    values : np.ndarray
        Values (n, axes), NaN = missing.

    Returns
    -------
    np.ndarray
        Median (axes,); NaN where no sample is complete.
    """
    known = values[~np.isnan(values).any(axis=1)]
    return np.median(known, axis=0) if len(known) else np.full(values.shape[1], np.nan)
