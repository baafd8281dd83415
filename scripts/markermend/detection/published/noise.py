"""Heavy noise of each coordinate, as published (skurowski2022 3.4.3)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.core.events import Event
from markermend.detection.published import coordinatewise
from markermend.detection.published.coordinatewise import SignalDetector
from markermend.detection.published.increments import high_passed_increments
from markermend.numerics import filters, intervals, morphology
from markermend.numerics.intervals import runs
from markermend.options.detection.published import PublishedNoiseOptions
from markermend.prediction.scene import Scene


def detect_noise(
    scene: Scene, *, markers: Sequence[str], earlier: np.ndarray, options: PublishedNoiseOptions
) -> list[Event]:
    """Find the stretches of heavy noise of a recording.

    Parameters
    ----------
    scene : Scene
        What is observed; nothing is found where it is missing.
    markers : Sequence[str]
        Names of the markers.
    earlier : np.ndarray
        What earlier detectors claimed, bool, like the positions: it is bridged, and not found again.
    options : PublishedNoiseOptions
        Windows, thresholds and shortest stretch of the published detector.

    Returns
    -------
    list[Event]
        Disjoint events, sorted.
    """
    return coordinatewise.detect_coordinatewise(
        scene, signal_detector(scene.rate, options), markers=markers, earlier=earlier, options=options
    )


def signal_detector(rate: float, options: PublishedNoiseOptions) -> SignalDetector:
    """Make the detector of the stretches of heavy noise of one coordinate.

    Parameters
    ----------
    rate : float
        Sampling rate, Hz.
    options : PublishedNoiseOptions
        Windows, thresholds and shortest stretch of the published detector.

    Returns
    -------
    SignalDetector
        The detector.

    References
    ----------
    skurowski2022 eq 26-30.
    """

    def change(signal: np.ndarray) -> np.ndarray:
        return high_passed_increments(signal, window_s=options.window_s, order=options.polynomial_order, rate=rate)

    def find(signal: np.ndarray, change: np.ndarray, level: float, marker: str) -> tuple[np.ndarray, np.ndarray]:
        return find_noise(signal, change, level, rate=rate, options=options)

    return SignalDetector(change, find)


def find_noise(
    signal: np.ndarray, change: np.ndarray, level: float, *, rate: float, options: PublishedNoiseOptions
) -> tuple[np.ndarray, np.ndarray]:
    """Find the stretches of heavy noise of one coordinate.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), mm, NaN = missing; nothing is found across a gap.
    change : np.ndarray
        Its high-passed increments (frames,), mm.
    level : float
        Smallest sudden change, mm.
    rate : float
        Sampling rate, Hz.
    options : PublishedNoiseOptions
        Structuring element and shortest stretch of the published detector.

    Returns
    -------
    mask : np.ndarray
        Samples of heavy noise, bool (frames,): each stretch goes from its first to its last sudden change, so that the
        smear of the filter does not count.
    score : np.ndarray
        Size of the largest high-passed increment (frames,), in units of the threshold; 0 elsewhere.

    References
    ----------
    skurowski2022 eq 28-30.
    """
    shortest = intervals.samples(options.min_duration_s, rate)
    element = intervals.samples(options.element_s, rate, odd=True)
    closed = morphology.closing(np.abs(change), element)
    raw = np.where(np.isnan(closed), np.nan, closed > level)
    areas = morphology.closing(raw, element) > 0
    plain = filters.difference(signal)
    sudden = np.abs(plain - filters.moving_median(plain, element)) > level
    mask, score = np.zeros(len(signal), bool), np.zeros(len(signal))
    for start, stop in runs(areas):
        own = start + np.flatnonzero(sudden[start:stop])
        if own.size < options.min_sudden_changes:
            continue
        span = slice(own[0], own[-1])
        if own[-1] - own[0] >= shortest and own.size >= options.min_sudden_share * (own[-1] - own[0]):
            mask[span] = True
            score[span] = np.abs(change[own]).max() / max(level, 1e-9)
    return mask, score
