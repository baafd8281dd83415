"""Isolated peaks of each coordinate, as published (skurowski2022 3.4.2)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.core.events import Event
from markermend.detection.published import coordinatewise, increments
from markermend.numerics import filters, intervals, morphology
from markermend.numerics.intervals import runs
from markermend.options.detection.published import PublishedPeaksOptions
from markermend.prediction.scene import Scene


def detect_peaks(
    scene: Scene, *, markers: Sequence[str], earlier: np.ndarray, options: PublishedPeaksOptions
) -> list[Event]:
    """Find the isolated peaks of a recording.

    Parameters
    ----------
    scene : Scene
        What is observed; nothing is found where it is missing.
    markers : Sequence[str]
        Names of the markers.
    earlier : np.ndarray
        What earlier detectors claimed, bool, like the positions: it is bridged, and not found again.
    options : PublishedPeaksOptions
        Windows, thresholds and balance ratio of the published detector.

    Returns
    -------
    list[Event]
        Disjoint events, sorted.
    """

    def detect(signal: np.ndarray, marker: str) -> tuple[np.ndarray, np.ndarray]:
        return find_peaks(signal, rate=scene.rate, options=options)

    return coordinatewise.detect_coordinatewise(
        scene, detect, markers=markers, earlier=earlier, slope_window_s=options.slope_window_s
    )


def detrended_increments(signal: np.ndarray, *, trend: str, window: int) -> np.ndarray:
    """Remove the trend from the increments of a signal by a moving median.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), mm, NaN = missing.
    trend : {"median_of_difference", "difference_of_median"}
        Whether the median of the increments is subtracted from them, or that of the signal before the increments are
        taken.
    window : int
        Window of the median, samples.

    Returns
    -------
    np.ndarray
        Increments (frames,), mm, NaN where the signal is.

    Raises
    ------
    ValueError
        For another trend.

    References
    ----------
    skurowski2022 eq 18, 19.
    """
    if trend == "median_of_difference":
        change = filters.difference(signal)
        departure: np.ndarray = change - filters.moving_median(change, window)
        return departure
    if trend == "difference_of_median":
        return filters.difference(signal - filters.moving_median(signal, window))
    raise ValueError(f"trend {trend!r} is neither median_of_difference nor difference_of_median")


def find_peaks(signal: np.ndarray, *, rate: float, options: PublishedPeaksOptions) -> tuple[np.ndarray, np.ndarray]:
    """Find the isolated peaks of one coordinate.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), mm, NaN = missing; nothing is found across a gap.
    rate : float
        Sampling rate, Hz.
    options : PublishedPeaksOptions
        Windows, thresholds and balance ratio of the published detector.

    Returns
    -------
    mask : np.ndarray
        Samples of peaks, bool (frames,).
    score : np.ndarray
        Size of their largest increment (frames,), in units of the threshold; 0 elsewhere.

    References
    ----------
    skurowski2022 eq 18-25.
    """
    longest = intervals.samples(options.max_duration_s, rate)
    window = intervals.samples(2 * options.max_duration_s + options.margin_s, rate, odd=True)
    change = detrended_increments(
        signal, trend=options.trend_removal, window=intervals.samples(options.window_s, rate, odd=True)
    )
    level = increments.threshold(
        change, scale=options.scale_estimator, sigmas=options.threshold_sigmas, floor_mm=options.floor_mm
    )
    sudden = np.where(np.abs(change) > level, change, 0.0)
    sudden[np.isnan(change)] = np.nan
    mask, score = np.zeros(len(signal), bool), np.zeros(len(signal))
    for start, stop in runs(_balanced(sudden, window, options.balance_ratio)):
        low = max(0, start - window // 2)
        own = low + np.flatnonzero(np.nan_to_num(sudden[low : stop + window // 2]))
        opposite = own[sudden[own] * sudden[own[0]] < 0] if own.size else own
        if opposite.size and opposite[-1] == own[-1] and own[-1] - own[0] <= longest:
            mask[own[0] : own[-1]] = True
            score[own[0] : own[-1]] = np.abs(sudden[own]).max() / max(level, 1e-9)
    return mask, score


def _balanced(sudden: np.ndarray, window: int, ratio: float) -> np.ndarray:
    """Where sudden changes (frames,) cancel over a window, and there are none on either side (skurowski2022 eq 20-25)."""
    total, absolute = filters.moving_sum(sudden, window), filters.moving_sum(np.abs(sudden), window)
    candidate = ((absolute > 0) & (absolute > ratio * np.abs(total))).astype(float)
    candidate[np.isnan(sudden)] = np.nan
    isolated: np.ndarray = morphology.top_hat(morphology.closing(candidate, window), window) > 0
    return isolated
