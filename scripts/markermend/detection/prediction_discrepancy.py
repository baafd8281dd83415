"""What frozen positions and noisy tails have in common: samples in the file that nobody measured, and that tells.

Where a marker was out of sight, a capture program may repeat its last position, or let the samples next to the gap wander
off. Both look like measurements. What gives them away is that the neighbours and the marker's own course around them say
otherwise.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.core.events import Event
from markermend.detection import inputs
from markermend.prediction.scene import Predictor, Scene

Place = tuple[int, int, int]
"""A stretch of one marker: its index, and the half-open interval."""


def hiding(scene: Scene, places: Sequence[Place]) -> Scene:
    """The scene without any of the places: none of them vouches for another."""
    covered = np.zeros(scene.positions.shape, bool)
    for m, start, stop in places:
        covered[start:stop, m] = True
    return inputs.without(scene, covered)


def disagreement(
    scene: Scene, hidden: Scene, place: Place, *, predictor: Predictor, sigmas: float, floor_mm: float
) -> tuple[np.ndarray, np.ndarray]:
    """How far the samples of a place are from where they should be, in units of what can be told.

    hidden: the scene without the place. Returns the distance (n,) in units of `sigmas` standard deviations of the
    prediction (per axis) or of `floor_mm`, whichever is more, and the difference (n, 3), mm; 0 where nothing can be
    told or nothing is measured.
    """
    m, start, stop = place
    prediction = predictor.predict(hidden, m, start, stop)
    difference = scene.positions[start:stop, m] - prediction.positions[1:-1]
    level = np.maximum(sigmas * prediction.error[1:-1], floor_mm)
    size = np.linalg.norm(difference, axis=1) / level
    known = np.isfinite(size)
    return np.where(known, size, 0.0), np.where(known[:, None], difference, 0.0)


def event(marker: str, start: int, stop: int, score: np.ndarray) -> Event:
    """The finding over [start, stop): all axes, since the sample as a whole was not measured."""
    return Event(marker, start, stop, float(max(1.0, score.max())))
