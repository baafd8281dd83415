"""Slow changes of each coordinate of a residual, as published (skurowski2022 3.5)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from markermend.core.events import Event
from markermend.detection.published import coordinatewise
from markermend.detection.published.coordinatewise import SignalDetector
from markermend.numerics import intervals
from markermend.numerics.intervals import runs
from markermend.options.detection.published import PublishedSlowOptions
from markermend.options.detection.slow import SlowOptions
from markermend.options.prediction.predictors import PredictorOptions
from markermend.prediction.interface import ResidualSource
from markermend.prediction.lagged_regression.polynomial import Polynomial
from markermend.prediction.lagged_regression.replicated_network import ReplicatedNetwork
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.scene import Scene
from markermend.prediction.time_smoothers import MovingMedian, SavitzkyGolay

PREDICTORS = ("replicated_network", "polynomial", "savitzky_golay", "moving_median", "local_ridge")
"""The predictors whose residual may be examined: the four of the paper, and the local ridge."""


def detect_slow(
    scene: Scene,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    options: PublishedSlowOptions,
    predictor: ResidualSource,
) -> tuple[list[Event], dict[str, float | None]]:
    """Find the slow changes of a recording.

    Parameters
    ----------
    scene : Scene
        What is observed; nothing is found where it is missing.
    markers : Sequence[str]
        Names of the markers.
    earlier : np.ndarray
        What earlier detectors claimed, bool, like the positions: it is bridged for the predictor, and not found again.
    options : PublishedSlowOptions
        Predictor, and thresholds of the hysteresis.
    predictor : ResidualSource
        Source of the residuals; see `make_predictor`.

    Returns
    -------
    found : list[Event]
        Disjoint events, sorted.
    smallest : dict[str, float | None]
        Empty: which slow changes would have been found is not published.
    """
    reach = intervals.samples(options.slope_window_s, scene.rate)
    bridged = replace(scene, positions=coordinatewise.bridge_claimed(scene.positions, earlier, reach))
    found = coordinatewise.detect_each(
        predictor.residuals(bridged),
        signal_detector(scene.rate, options),
        markers=markers,
        earlier=earlier,
        options=options,
    )
    return found, {}


def signal_detector(rate: float, options: PublishedSlowOptions) -> SignalDetector:
    """Make the detector of the slow changes of one coordinate of the residual.

    Parameters
    ----------
    rate : float
        Sampling rate, Hz.
    options : PublishedSlowOptions
        Predictor, and thresholds of the hysteresis.

    Returns
    -------
    SignalDetector
        The detector.

    References
    ----------
    skurowski2022 3.5.
    """

    def centre(residual: np.ndarray) -> np.ndarray:
        centred: np.ndarray = residual - (np.nanmedian(residual) if np.isfinite(residual).any() else 0.0)
        return centred

    def find(signal: np.ndarray, deviation: np.ndarray, level: float, marker: str) -> tuple[np.ndarray, np.ndarray]:
        return find_slow(deviation, level, rate=rate, options=options)

    return SignalDetector(centre, find)


def make_detector(options: SlowOptions) -> Callable[..., tuple[list[Event], dict[str, float | None]]]:
    """Make the detector, with the predictor that the options name.

    Parameters
    ----------
    options : SlowOptions
        The options of the stage.

    Returns
    -------
    callable
        `detect_slow` with its predictor.
    """
    return partial(detect_slow, predictor=make_predictor(options.paper, options.predictors))


def make_predictor(options: PublishedSlowOptions, predictors: PredictorOptions) -> ResidualSource:
    """Make the predictor that the options name.

    Parameters
    ----------
    options : PublishedSlowOptions
        Predictor, and thresholds of the hysteresis.
    predictors : PredictorOptions
        Options of the predictors.

    Returns
    -------
    ResidualSource
        The predictor.

    Raises
    ------
    ValueError
        For a name that is not among PREDICTORS.
    """
    if options.predictor == "replicated_network":
        return make_network(options, predictors)
    if options.predictor == "polynomial":
        return Polynomial(predictors.polynomial)
    if options.predictor == "savitzky_golay":
        return SavitzkyGolay(window_s=options.smoothing_window_s, order=options.polynomial_order)
    if options.predictor == "moving_median":
        return MovingMedian(window_s=options.smoothing_window_s)
    if options.predictor == "local_ridge":
        return LocalRidge(predictors.local_ridge)
    raise ValueError(f"predictor {options.predictor!r} is none of {', '.join(PREDICTORS)}")


def make_network(options: PublishedSlowOptions, predictors: PredictorOptions) -> ReplicatedNetwork:
    """Make the replicated network.

    Parameters
    ----------
    options : PublishedSlowOptions
        What differs for detection.
    predictors : PredictorOptions
        Options of the predictors.

    Returns
    -------
    ReplicatedNetwork
        The network, untrained.
    """
    return ReplicatedNetwork(replace(predictors.replicated_network, **options.replicated_network_changes))


def hysteresis(level: np.ndarray, *, lower: float, min_upper: int) -> list[tuple[int, int]]:
    """Threshold a signal with hysteresis: stretches above a lower threshold that exceed an upper one for long enough.

    Parameters
    ----------
    level : np.ndarray
        Signal (frames,) in units of the upper threshold; NaN = missing, at which a stretch ends.
    lower : float
        The lower threshold, in the same units.
    min_upper : int
        Samples in a row, at least, that exceed the upper threshold.

    Returns
    -------
    list[tuple[int, int]]
        Half-open intervals, in order.

    References
    ----------
    skurowski2022 3.5, re-growing.
    """
    tops = np.array([start for start, stop in runs(np.nan_to_num(level) > 1) if stop - start >= min_upper], int)
    grown = list(runs(np.nan_to_num(level) > lower))
    return [(start, stop) for start, stop in grown if np.any((tops >= start) & (tops < stop))]


def find_slow(
    deviation: np.ndarray, upper: float, *, rate: float, options: PublishedSlowOptions
) -> tuple[np.ndarray, np.ndarray]:
    """Find the slow changes of one coordinate of the residual, upwards and downwards.

    Parameters
    ----------
    deviation : np.ndarray
        Deviation of the residual from its median (frames,), mm, NaN = missing; nothing is found across a gap.
    upper : float
        Upper threshold, mm.
    rate : float
        Sampling rate, Hz.
    options : PublishedSlowOptions
        Predictor, and thresholds of the hysteresis.

    Returns
    -------
    mask : np.ndarray
        Samples of slow changes, bool (frames,).
    score : np.ndarray
        Their largest deviation from the median (frames,), in units of the upper threshold; 0 elsewhere.

    References
    ----------
    skurowski2022 3.5, steps 1-4.
    """
    level = deviation / max(upper, 1e-9)
    mask, score = np.zeros(len(deviation), bool), np.zeros(len(deviation))
    min_upper = intervals.samples(options.min_upper_duration_s, rate)
    shortest = intervals.samples(options.min_duration_s, rate)
    lower = options.lower_sigmas / options.threshold_sigmas
    for sign in (1, -1):
        for start, stop in hysteresis(sign * level, lower=lower, min_upper=min_upper):
            if stop - start >= shortest:
                mask[start:stop] = True
                score[start:stop] = (sign * level[start:stop]).max()
    return mask, score
