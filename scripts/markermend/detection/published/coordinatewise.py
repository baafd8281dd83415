"""Detection coordinate by coordinate, as in skurowski2022: one signal at a time, merged to intervals of markers."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.numerics import interpolation, intervals
from markermend.prediction.scene import Scene

Find = Callable[[np.ndarray, str], tuple[np.ndarray, np.ndarray]]
"""A detector of one signal (frames,), NaN = missing, given with the name of its marker: returns a mask and a score in
units of the threshold, (frames,)."""


def bridged(positions: np.ndarray, earlier: np.ndarray, reach: int) -> np.ndarray:
    """Positions with what detectors before claimed replaced by curves whose slopes are taken over `reach` samples.

    positions: (frames, markers, 3), mm, NaN = missing. earlier: bool, likewise: each coordinate by itself.
    """
    out = positions.copy()
    for marker, axis in np.argwhere(earlier.any(axis=0)):
        out[:, marker, axis] = interpolation.bridge_cubic(positions[:, marker, axis], earlier[:, marker, axis], reach)
    return out


def find_in_each(signals: np.ndarray, find: Find, *, markers: Sequence[str], earlier: np.ndarray) -> list[Event]:
    """Run a detector on each coordinate of each marker and merge what it finds to events of markers.

    signals: (frames, markers, 3), mm, NaN = missing. earlier: bool, likewise; where it claims any coordinate of a
    marker, nothing is found again.
    """
    fired = np.zeros(signals.shape, bool)
    score = np.zeros(signals.shape)
    for m in range(signals.shape[1]):
        for axis in range(3):
            fired[:, m, axis], score[:, m, axis] = find(signals[:, m, axis], markers[m])
    fired &= ~earlier.any(axis=2, keepdims=True)
    found: np.ndarray = np.any(fired, axis=2)
    return events.from_mask(found, np.where(fired, score, 0.0).max(axis=2), fired, markers)


def detect(scene: Scene, find: Find, *, markers: Sequence[str], earlier: np.ndarray, bridge_s: float) -> list[Event]:
    """Run a detector on each coordinate, with what detectors before claimed replaced by curves.

    scene: positions (frames, markers, 3), mm, NaN = missing. earlier: bool, likewise. bridge_s: slopes of the curves
    are taken over this time.
    """
    signals = bridged(scene.positions, earlier, intervals.samples(bridge_s, scene.rate))
    return find_in_each(signals, find, markers=markers, earlier=earlier)
