"""Steps of each coordinate, as published (skurowski2022 3.4.4)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.core import events
from markermend.core.events import Event, OpenStep
from markermend.detection.published import coordinatewise, increments
from markermend.detection.published.coordinatewise import SignalDetector
from markermend.detection.published.increments import high_passed_increments
from markermend.numerics import filters, intervals
from markermend.options.detection.published import PublishedStepsOptions
from markermend.prediction.scene import Scene


def detect_steps(
    scene: Scene, *, markers: Sequence[str], earlier: np.ndarray, options: PublishedStepsOptions
) -> tuple[list[Event], list[OpenStep]]:
    """Find the steps of a recording, and the jumps without a counterpart.

    Parameters
    ----------
    scene : Scene
        What is observed; nothing is found where it is missing.
    markers : Sequence[str]
        Names of the markers.
    earlier : np.ndarray
        What earlier detectors claimed, bool, like the positions: it is bridged, and not found again.
    options : PublishedStepsOptions
        Windows, thresholds and lengths of the published detector.

    Returns
    -------
    found : list[Event]
        Disjoint events, sorted.
    open_steps : list[OpenStep]
        Jumps without a counterpart outside of the events, by marker and frame.
    """
    window = intervals.samples(options.window_s, scene.rate, odd=True)
    size_mm: dict[tuple[str, int], float] = {}

    def high_pass(signal: np.ndarray) -> np.ndarray:
        return high_passed_increments(
            signal, window_s=options.window_s, order=options.polynomial_order, rate=scene.rate
        )

    def find(signal: np.ndarray, change: np.ndarray, level: float, marker: str) -> tuple[np.ndarray, np.ndarray]:
        mask, score, alone = find_steps(change, level, rate=scene.rate, options=options)
        jumps = filters.difference(signal)
        jumps -= filters.moving_median(jumps, window)
        for frame in alone.tolist():
            size_mm[marker, frame] = float(np.hypot(size_mm.get((marker, frame), 0.0), jumps[frame]))
        return mask, score

    found = coordinatewise.detect_coordinatewise(
        scene, SignalDetector(high_pass, find), markers=markers, earlier=earlier, options=options
    )
    within = events.mask(found, len(scene.positions), markers)
    return found, [
        OpenStep(marker, frame, size)
        for (marker, frame), size in sorted(size_mm.items())
        if not within[frame, markers.index(marker)]
    ]


def find_steps(
    change: np.ndarray, level: float, *, rate: float, options: PublishedStepsOptions
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Find the steps of one coordinate: intervals between opposite jumps.

    Parameters
    ----------
    change : np.ndarray
        High-passed increments (frames,), mm, NaN = missing; nothing is found across a gap.
    level : float
        Smallest jump, mm.
    rate : float
        Sampling rate, Hz.
    options : PublishedStepsOptions
        Windows and lengths of the published detector.

    Returns
    -------
    mask : np.ndarray
        Samples of steps, bool (frames,).
    score : np.ndarray
        Size of the smaller of the two jumps (frames,), in units of the threshold; 0 elsewhere.
    alone : np.ndarray
        Frames of the jumps without a counterpart.

    References
    ----------
    skurowski2022 3.4.4.
    """
    window = max(intervals.samples(options.window_s, rate, odd=True), 2 * options.polynomial_order + 1)
    at = increments.edges(change, level, window // 2)
    pairs, alone = increments.derivative_pairs(
        change,
        at,
        shortest=intervals.samples(options.min_duration_s, rate),
        longest=intervals.samples(options.max_duration_s, rate),
        ratio=options.min_jump_ratio,
    )
    mask, score = np.zeros(len(change), bool), np.zeros(len(change))
    for start, stop in pairs:
        mask[start:stop] = True
        score[start:stop] = min(abs(change[start]), abs(change[stop])) / max(level, 1e-9)
    return mask, score, alone
