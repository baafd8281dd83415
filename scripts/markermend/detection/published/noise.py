"""Heavy noise of one coordinate as published (skurowski2022 3.4.3)."""

from __future__ import annotations

import numpy as np

from markermend.detection.published import increments
from markermend.detection.published.increments import difference_high_pass
from markermend.numerics import filters, intervals, morphology
from markermend.numerics.intervals import runs
from markermend.options.published import PublishedNoiseOptions


def find_noise(signal: np.ndarray, *, rate: float, options: PublishedNoiseOptions) -> tuple[np.ndarray, np.ndarray]:
    """Find the stretches of heavy noise of one coordinate (skurowski2022 eq 26-30).

    signal: (frames,), mm, NaN = missing; nothing is found across a gap. Returns a mask and a score, (frames,). A stretch
    goes from its first to its last sample that is far from what stands before it: the filter's smear does not count.
    """
    shortest = intervals.samples(options.min_duration_s, rate)
    element = 2 * shortest - 1
    change = difference_high_pass(signal, window_s=options.window_s, order=options.polynomial_order, rate=rate)
    level = increments.threshold(
        change, scale=options.scale_estimator, sigmas=options.threshold_sigmas, floor_mm=options.floor_mm
    )
    closed = morphology.closing(np.abs(change), element)
    raw = np.where(np.isnan(closed), np.nan, closed > level)
    areas = morphology.closing(raw, element) > 0
    plain = filters.difference(signal)
    jump = np.abs(plain - filters.moving_median(plain, element)) > level
    mask, score = np.zeros(len(signal), bool), np.zeros(len(signal))
    for start, stop in runs(areas):
        own = start + np.flatnonzero(jump[start:stop])
        if own.size < options.min_sudden_changes:
            continue
        span = slice(own[0], own[-1])
        if own[-1] - own[0] >= shortest and own.size >= options.min_sudden_share * (own[-1] - own[0]):
            mask[span] = True
            score[span] = np.abs(change[own]).max() / max(level, 1e-9)
    return mask, score
