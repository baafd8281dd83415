"""Detection coordinate by coordinate, as in skurowski2022: one signal at a time, merged to intervals of markers."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from markermend import events
from markermend.events import Event
from markermend.robust import bridge

Find = Callable[[np.ndarray, str], tuple[np.ndarray, np.ndarray]]
"""A detector of one signal (frames,), NaN = missing, given with the name of its marker: returns a mask and a score in
units of the threshold, (frames,)."""


def merge(positions: np.ndarray, find: Find, *, markers: Sequence[str], earlier: np.ndarray, reach: int) -> list[Event]:
    """Run a detector on each coordinate of each marker and merge what it finds to events of markers.

    positions: (frames, markers, 3), mm, NaN = missing. earlier: bool (frames, markers), samples that detectors before
    claimed: they are bridged by curves whose slopes are taken over `reach` samples, and cannot be found again.
    """
    fired = np.zeros(positions.shape, bool)
    score = np.zeros(positions.shape)
    for m in range(positions.shape[1]):
        for axis in range(3):
            signal = bridge(positions[:, m, axis], earlier[:, m], reach)
            fired[:, m, axis], score[:, m, axis] = find(signal, markers[m])
    fired &= ~earlier[:, :, None]
    found: np.ndarray = np.any(fired, axis=2)
    return events.from_mask(found, np.where(fired, score, 0.0).max(axis=2), fired, markers)
