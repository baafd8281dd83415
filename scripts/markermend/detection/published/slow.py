"""Hills and valleys of a residual: slow changes as published, coordinate by coordinate (skurowski2022 3.5)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from markermend.core.events import Event
from markermend.detection.published import coordinatewise, increments
from markermend.numerics import intervals
from markermend.numerics.intervals import runs
from markermend.options.prediction import PredictorOptions
from markermend.options.published import PublishedSlowOptions
from markermend.prediction.lagged_regression.polynomial import Polynomial
from markermend.prediction.lagged_regression.replicated_network import ReplicatedNetwork
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.scene import ResidualSource, Scene
from markermend.prediction.time_smoothers import MovingMedian, SavitzkyGolay

PREDICTORS = ("replicated_network", "polynomial", "savitzky_golay", "moving_median", "local_ridge")
"""Whose residual may be judged: the four of the paper, and the local ridge."""


def predictor(options: PublishedSlowOptions, families: PredictorOptions) -> ResidualSource:
    """Make the predictor that the options name; families: options of the predictors.

    Raises ValueError for a name that is not in PREDICTORS.
    """
    if options.predictor == "replicated_network":
        return ReplicatedNetwork(families.replicated_network)
    if options.predictor == "polynomial":
        return Polynomial(families.polynomial)
    if options.predictor == "savitzky_golay":
        return SavitzkyGolay(window_s=options.smoothing_window_s, order=options.polynomial_order)
    if options.predictor == "moving_median":
        return MovingMedian(window_s=options.smoothing_window_s)
    if options.predictor == "local_ridge":
        return LocalRidge(families.local_ridge)
    raise ValueError(f"predictor {options.predictor!r} is none of {', '.join(PREDICTORS)}")


def regrow(level: np.ndarray, *, lower: float, top: int) -> list[tuple[int, int]]:
    """Hysteresis with re-growing: stretches of a level above `lower` that exceed 1 for `top` samples in a row at least.

    level: (frames,), NaN = missing, at which a stretch ends.
    """
    tops = np.array([start for start, stop in runs(np.nan_to_num(level) > 1) if stop - start >= top], int)
    grown = list(runs(np.nan_to_num(level) > lower))
    return [(start, stop) for start, stop in grown if np.any((tops >= start) & (tops < stop))]


def find_slow(residual: np.ndarray, *, rate: float, options: PublishedSlowOptions) -> tuple[np.ndarray, np.ndarray]:
    """Find the hills and valleys of one coordinate of the residual (skurowski2022 3.5, steps 1-4).

    residual: (frames,), mm, NaN = missing; nothing is found across a gap. Returns a mask and a score, (frames,).
    """
    finite = residual[np.isfinite(residual)]
    centre = float(np.median(finite)) if finite.size else 0.0
    sigma = increments.threshold(residual, scale=options.scale_estimator, sigmas=1.0, floor_mm=1e-9)
    level = (residual - centre) / (options.threshold_sigmas * sigma)
    mask, score = np.zeros(len(residual), bool), np.zeros(len(residual))
    top, shortest = (
        intervals.samples(options.min_upper_duration_s, rate),
        intervals.samples(options.min_duration_s, rate),
    )
    for sign in (1, -1):
        for start, stop in regrow(sign * level, lower=options.lower_sigmas / options.threshold_sigmas, top=top):
            if stop - start >= shortest:
                mask[start:stop] = True
                score[start:stop] = (sign * level[start:stop]).max()
    return mask, score


def detect(
    scene: Scene,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    options: PublishedSlowOptions,
    predictor: ResidualSource,
) -> list[Event]:
    """Find the slow changes of a recording in the residuals of its coordinates.

    earlier: bool, like positions, what detectors before claimed: bridged for the predictor, and not found again.
    """
    reach = intervals.samples(options.slope_window_s, scene.rate)
    bridged = replace(scene, positions=coordinatewise.bridged(scene.positions, earlier, reach))
    return coordinatewise.find_in_each(
        predictor.residuals(bridged),
        lambda residual, _: find_slow(residual, rate=scene.rate, options=options),
        markers=markers,
        earlier=earlier,
    )
