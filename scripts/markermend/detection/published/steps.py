"""Steps of one coordinate as published (skurowski2022 3.4.4)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.core import events
from markermend.core.events import Event, OpenStep
from markermend.detection.published import coordinatewise, increments
from markermend.detection.published.increments import difference_high_pass
from markermend.numerics import filters, intervals
from markermend.options.published import PublishedStepsOptions
from markermend.prediction.scene import Scene


def find_steps(
    signal: np.ndarray, *, rate: float, options: PublishedStepsOptions
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Find the steps of one coordinate (skurowski2022 3.4.4): intervals between opposite jumps.

    signal: (frames,), mm, NaN = missing; nothing is found across a gap. Returns a mask, a score, both (frames,), and the
    frames of jumps without a counterpart (open steps).
    """
    change = difference_high_pass(signal, window_s=options.window_s, order=options.polynomial_order, rate=rate)
    level = increments.threshold(
        change, scale=options.scale_estimator, sigmas=options.threshold_sigmas, floor_mm=options.floor_mm
    )
    window = max(intervals.samples(options.window_s, rate, odd=True), 2 * options.polynomial_order + 1)
    at = increments.edges(change, level, window // 2)
    pairs, alone = increments.derivative_pairs(
        change,
        at,
        shortest=intervals.samples(options.min_duration_s, rate),
        longest=intervals.samples(options.max_duration_s, rate),
        ratio=options.min_jump_ratio,
    )
    mask, score = np.zeros(len(signal), bool), np.zeros(len(signal))
    for start, stop in pairs:
        mask[start:stop] = True
        score[start:stop] = min(abs(change[start]), abs(change[stop])) / max(level, 1e-9)
    return mask, score, alone


def _detect_in_coordinates(
    scene: Scene, *, markers: Sequence[str], earlier: np.ndarray, options: PublishedStepsOptions
) -> tuple[list[Event], list[OpenStep]]:
    """See detect_steps: coordinate by coordinate."""
    alone: dict[tuple[str, int], float] = {}

    def find(signal: np.ndarray, marker: str) -> tuple[np.ndarray, np.ndarray]:
        mask, score, left = find_steps(signal, rate=scene.rate, options=options)
        change = filters.difference(signal)
        change -= filters.moving_median(change, intervals.samples(options.window_s, scene.rate, odd=True))
        for frame in left.tolist():
            alone[marker, frame] = float(np.hypot(alone.get((marker, frame), 0.0), change[frame]))
        return mask, score

    found = coordinatewise.detect(scene, find, markers=markers, earlier=earlier, bridge_s=options.slope_window_s)
    within = events.mask(found, len(scene.positions), markers)
    return found, [OpenStep(*at, size) for at, size in sorted(alone.items()) if not within[at[1], markers.index(at[0])]]
