"""Run a detector of one signal on each coordinate of each marker, and merge what it finds (skurowski2022)."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.numerics import interpolation, intervals
from markermend.prediction.scene import Scene

SignalDetector = Callable[[np.ndarray, str], tuple[np.ndarray, np.ndarray]]
"""A detector of one signal (frames,), mm, NaN = missing, given with the name of its marker: a mask and a score in units of
the threshold, both (frames,)."""


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
    signals: np.ndarray, detect: SignalDetector, *, markers: Sequence[str], earlier: np.ndarray
) -> list[Event]:
    """Run a detector on each coordinate of each marker, and merge its findings to events of markers.

    Parameters
    ----------
    signals : np.ndarray
        Signals (frames, markers, 3), mm, NaN = missing.
    detect : SignalDetector
        The detector.
    markers : Sequence[str]
        Names of the markers.
    earlier : np.ndarray
        What earlier detectors claimed, bool, like the signals; nothing is found where any coordinate of a marker is.

    Returns
    -------
    list[Event]
        Disjoint events, sorted.
    """
    fired = np.zeros(signals.shape, bool)
    score = np.zeros(signals.shape)
    for m in range(signals.shape[1]):
        for axis in range(3):
            fired[:, m, axis], score[:, m, axis] = detect(signals[:, m, axis], markers[m])
    fired &= ~earlier.any(axis=2, keepdims=True)
    found: np.ndarray = np.any(fired, axis=2)
    return events.from_mask(found, np.where(fired, score, 0.0).max(axis=2), fired, markers)


def detect_coordinatewise(
    scene: Scene, detect: SignalDetector, *, markers: Sequence[str], earlier: np.ndarray, slope_window_s: float
) -> list[Event]:
    """Run a detector on each coordinate of the trajectories, with what earlier detectors claimed bridged.

    Parameters
    ----------
    scene : Scene
        What is observed.
    detect : SignalDetector
        The detector.
    markers : Sequence[str]
        Names of the markers.
    earlier : np.ndarray
        What earlier detectors claimed, bool, like the positions.
    slope_window_s : float
        Window over which the slopes of the bridges are taken, s.

    Returns
    -------
    list[Event]
        Disjoint events, sorted.
    """
    signals = bridge_claimed(scene.positions, earlier, intervals.samples(slope_window_s, scene.rate))
    return detect_each(signals, detect, markers=markers, earlier=earlier)
