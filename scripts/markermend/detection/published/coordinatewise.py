"""Run a detector of one signal on each coordinate of each marker, and merge what it finds (skurowski2022)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.detection.published import increments
from markermend.numerics import interpolation, intervals
from markermend.options.detection.published import (
    PublishedNoiseOptions,
    PublishedPeaksOptions,
    PublishedStepsOptions,
    ThresholdOptions,
)
from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class SignalDetector:
    """A detector of one signal, in two steps.

    Attributes
    ----------
    change : callable
        Maps a signal (frames,), mm, NaN = missing, to the changes of which the usual size sets the threshold, in the same form.
    find : callable
        Given a signal, its changes, the threshold (mm) and the name of the marker, returns a mask and a score in units of the
        threshold, both (frames,).
    """

    change: Callable[[np.ndarray], np.ndarray]
    find: Callable[[np.ndarray, np.ndarray, float, str], tuple[np.ndarray, np.ndarray]]


def bridge_claimed(positions: np.ndarray, earlier: np.ndarray, reach: int) -> np.ndarray:
    """Replace what earlier detectors claimed by cubic curves, each coordinate by itself.

    Parameters
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing. Not modified.
    earlier : np.ndarray
        What was claimed, bool, like the positions.
    reach : int
        Samples over which the slopes on either side are taken.

    Returns
    -------
    np.ndarray
        Positions (frames, markers, 3), mm.
    """
    bridged = positions.copy()
    for marker, axis in np.argwhere(earlier.any(axis=0)):
        bridged[:, marker, axis] = interpolation.bridge_cubic(
            positions[:, marker, axis], earlier[:, marker, axis], reach
        )
    return bridged


def detect_each(
    signals: np.ndarray,
    detector: SignalDetector,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    options: ThresholdOptions,
) -> list[Event]:
    """Run a detector on each coordinate of each marker, and merge its findings to events of markers.

    Parameters
    ----------
    signals : np.ndarray
        Signals (frames, markers, 3), mm, NaN = missing.
    detector : SignalDetector
        The detector.
    markers : Sequence[str]
        Names of the markers.
    earlier : np.ndarray
        What earlier detectors claimed, bool, like the signals; nothing is found where any coordinate of a marker is.
    options : ThresholdOptions
        The threshold.

    Returns
    -------
    list[Event]
        Disjoint events, sorted.
    """
    fired = np.zeros(signals.shape, bool)
    score, changes = np.zeros(signals.shape), np.empty(signals.shape)
    for place in np.ndindex(signals.shape[1:]):
        changes[:, *place] = detector.change(signals[:, *place])
    levels = increments.thresholds(changes, options)
    for m, axis in np.ndindex(levels.shape):
        fired[:, m, axis], score[:, m, axis] = detector.find(
            signals[:, m, axis], changes[:, m, axis], float(levels[m, axis]), markers[m]
        )
    fired &= ~earlier.any(axis=2, keepdims=True)
    found: np.ndarray = np.any(fired, axis=2)
    return events.from_mask(found, np.where(fired, score, 0.0).max(axis=2), fired, markers)


def detect_coordinatewise(
    scene: Scene,
    detector: SignalDetector,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    options: PublishedPeaksOptions | PublishedNoiseOptions | PublishedStepsOptions,
) -> list[Event]:
    """Run a detector on each coordinate of the trajectories, with what earlier detectors claimed bridged.

    Parameters
    ----------
    scene : Scene
        What is observed.
    detector : SignalDetector
        The detector.
    markers : Sequence[str]
        Names of the markers.
    earlier : np.ndarray
        What earlier detectors claimed, bool, like the positions.
    options : PublishedPeaksOptions or PublishedNoiseOptions or PublishedStepsOptions
        The threshold, and the window over which the slopes of the bridges are taken.

    Returns
    -------
    list[Event]
        Disjoint events, sorted.
    """
    signals = bridge_claimed(scene.positions, earlier, intervals.samples(options.slope_window_s, scene.rate))
    return detect_each(signals, detector, markers=markers, earlier=earlier, options=options)
