"""Isolated peaks of one coordinate as published (skurowski2022 3.4.2)."""

from __future__ import annotations

import numpy as np

from markermend.detection.published import increments
from markermend.numerics import filters, intervals, morphology
from markermend.numerics.intervals import runs
from markermend.options.published import PublishedPeaksOptions


def without_trend(signal: np.ndarray, *, trend: str, window: int) -> np.ndarray:
    """Differences without the slow trend (skurowski2022 eq 18, 19): either order of median and difference."""
    if trend == "median_of_difference":
        change = filters.difference(signal)
        return change - filters.moving_median(change, window)
    if trend == "difference_of_median":
        return filters.difference(signal - filters.moving_median(signal, window))
    raise ValueError(f"trend {trend!r} is neither median_of_difference nor difference_of_median")


def find_peaks(signal: np.ndarray, *, rate: float, options: PublishedPeaksOptions) -> tuple[np.ndarray, np.ndarray]:
    """Find the isolated peaks of one coordinate (skurowski2022 eq 18-25).

    signal: (frames,), mm, NaN = missing; nothing is found across a gap. Returns a mask and a score, (frames,).
    """
    longest = intervals.samples(options.max_duration_s, rate)
    window = intervals.samples(2 * options.max_duration_s + options.margin_s, rate, odd=True)
    change = without_trend(
        signal, trend=options.trend_removal, window=intervals.samples(options.window_s, rate, odd=True)
    )
    level = increments.threshold(
        change, scale=options.scale_estimator, sigmas=options.threshold_sigmas, floor_mm=options.floor_mm
    )
    kept = np.where(np.abs(change) > level, change, 0.0)
    kept[np.isnan(change)] = np.nan
    total, absolute = filters.moving_sum(kept, window), filters.moving_sum(np.abs(kept), window)
    candidate = ((absolute > 0) & (absolute > options.balance_ratio * np.abs(total))).astype(float)
    candidate[np.isnan(change)] = np.nan
    isolated = morphology.top_hat(morphology.closing(candidate, window), window) > 0
    mask, score = np.zeros(len(signal), bool), np.zeros(len(signal))
    for start, stop in runs(isolated):
        low = max(0, start - window // 2)
        own = low + np.flatnonzero(np.nan_to_num(kept[low : stop + window // 2]))
        opposite = own[kept[own] * kept[own[0]] < 0] if own.size else own
        if opposite.size and opposite[-1] == own[-1] and own[-1] - own[0] <= longest:
            mask[own[0] : own[-1]] = True
            score[own[0] : own[-1]] = np.abs(kept[own]).max() / max(level, 1e-9)
    return mask, score
