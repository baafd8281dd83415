"""Isolated peaks of each coordinate, as published (skurowski2022 3.4.2)."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from markermend.core.events import Event
from markermend.detection.published import coordinatewise
from markermend.detection.published.coordinatewise import SignalDetector
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
    return coordinatewise.detect_coordinatewise(
        scene, signal_detector(scene.rate, options), markers=markers, earlier=earlier, options=options
    )


def signal_detector(rate: float, options: PublishedPeaksOptions) -> SignalDetector:
    """Make the detector of the isolated peaks of one coordinate.

    Parameters
    ----------
    rate : float
        Sampling rate, Hz.
    options : PublishedPeaksOptions
        Windows, thresholds and balance ratio of the published detector.

    Returns
    -------
    SignalDetector
        The detector.

    References
    ----------
    skurowski2022 eq 18-25.
    """

    def change(signal: np.ndarray) -> np.ndarray:
        window = intervals.samples(options.window_s, rate, odd=True)
        return detrended_increments(signal, trend=options.trend_removal, window=window)

    def find(signal: np.ndarray, change: np.ndarray, level: float, marker: str) -> tuple[np.ndarray, np.ndarray]:
        return find_peaks(change, level, rate=rate, options=options)

    return SignalDetector(change, find)


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


def find_peaks(
    change: np.ndarray, level: float, *, rate: float, options: PublishedPeaksOptions
) -> tuple[np.ndarray, np.ndarray]:
    """Find the isolated peaks of one coordinate in its increments.

    Parameters
    ----------
    change : np.ndarray
        Increments without trend (frames,), mm, NaN = missing; nothing is found across a gap.
    level : float
        Smallest sudden change, mm.
    rate : float
        Sampling rate, Hz.
    options : PublishedPeaksOptions
        Windows and balance ratio of the published detector.

    Returns
    -------
    mask : np.ndarray
        Samples of peaks, bool (frames,).
    score : np.ndarray
        Size of their largest increment (frames,), in units of the threshold; 0 elsewhere.

    References
    ----------
    skurowski2022 eq 20-25.
    """
    longest = intervals.samples(options.max_duration_s, rate)
    window = intervals.samples(2 * options.max_duration_s + options.margin_s, rate, odd=True)
    sudden = np.where(np.abs(change) > level, change, 0.0)
    sudden[np.isnan(change)] = np.nan
    locate = _outermost if options.localisation == "window" else partial(_largest, ratio=options.balance_ratio)
    mask, score = np.zeros(len(change), bool), np.zeros(len(change))
    for start, stop in runs(_isolated(sudden, window, options)):
        if options.localisation == "window":
            start, stop = max(0, start - window // 2), stop + window // 2
        own = start + np.flatnonzero(np.nan_to_num(sudden[start:stop]))
        first, last = locate(sudden[own], own, longest)
        mask[first:last] = True
        score[first:last] = np.abs(sudden[own]).max(initial=0.0) / max(level, 1e-9)
    return mask, score


def _outermost(change: np.ndarray, at: np.ndarray, longest: int) -> tuple[int, int]:
    """The first and last of sudden changes at sorted frames if they are opposite and not too far apart, else nothing."""
    if not at.size or change[0] * change[-1] >= 0 or at[-1] - at[0] > longest:
        return 0, 0
    return int(at[0]), int(at[-1])


def _largest(change: np.ndarray, at: np.ndarray, longest: int, *, ratio: float) -> tuple[int, int]:
    """The largest of sudden changes at sorted frames and the largest that it cancels with and is not too far from it, else nothing."""
    if not at.size:
        return 0, 0
    largest = int(np.argmax(np.abs(change)))
    absolute, total = np.abs(change) + np.abs(change[largest]), np.abs(change + change[largest])
    cancels = (absolute > ratio * total) & (np.abs(at - at[largest]) <= longest)
    if not cancels.any():
        return 0, 0
    other = int(np.argmax(np.where(cancels, np.abs(change), 0.0)))
    first, last = sorted((int(at[largest]), int(at[other])))
    return first, last


def _isolated(sudden: np.ndarray, window: int, options: PublishedPeaksOptions) -> np.ndarray:
    """Where sudden changes (frames,) cancel over a window, and there are none on either side (skurowski2022 eq 20-25)."""
    total, absolute = filters.moving_sum(sudden, window), filters.moving_sum(np.abs(sudden), window)
    candidate = ((absolute > 0) & (absolute > options.balance_ratio * np.abs(total))).astype(float)
    candidate[np.isnan(sudden)] = np.nan
    if options.joined_candidates:
        candidate = morphology.closing(candidate, window)
    isolated: np.ndarray = morphology.top_hat(candidate, window) > 0
    return isolated
