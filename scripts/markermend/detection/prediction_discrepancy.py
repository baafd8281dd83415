"""The discrepancy between samples and their prediction: it shows which samples in the file were not measured.

Where a marker was out of sight, a capture program may repeat its last position, or let the samples beside the gap wander
off. Both look like measurements, but disagree with the prediction from the neighbours and from the marker's own trajectory
around them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.core.events import Event
from markermend.detection import inputs
from markermend.prediction.interface import Predictor
from markermend.prediction.scene import Scene

Stretch = tuple[int, int, int]
"""A stretch of one marker: its index, and the half-open interval."""


def hide_stretches(scene: Scene, stretches: Sequence[Stretch]) -> Scene:
    """Hide candidate stretches, so that none of them supports another.

    Parameters
    ----------
    scene : Scene
        What is observed. Not modified.
    stretches : Sequence[Stretch]
        The stretches.

    Returns
    -------
    Scene
        The scene without them.
    """
    covered = np.zeros(scene.positions.shape, bool)
    for m, start, stop in stretches:
        covered[start:stop, m] = True
    return inputs.without_claimed(scene, covered)


def discrepancy(
    scene: Scene, hidden: Scene, stretch: Stretch, *, predictor: Predictor, sigmas: float, floor_mm: float
) -> np.ndarray:
    """Measure how far the samples of a stretch are from their prediction.

    Parameters
    ----------
    scene : Scene
        What is observed.
    hidden : Scene
        The scene without the stretch.
    stretch : Stretch
        The stretch.
    predictor : Predictor
        The predictor.
    sigmas : float
        Threshold in standard deviations of the prediction, per axis.
    floor_mm : float
        Smallest threshold, mm.

    Returns
    -------
    np.ndarray
        Distances (n,) in units of the threshold; 0 where there is no prediction, or nothing is observed.
    """
    m, start, stop = stretch
    prediction = predictor.predict(hidden, m, start, stop)
    difference = scene.positions[start:stop, m] - prediction.positions[1:-1]
    threshold = np.maximum(sigmas * prediction.error[1:-1], floor_mm)
    distance = np.linalg.norm(difference, axis=1) / threshold
    return np.where(np.isfinite(distance), distance, 0.0)


def unmeasured_event(marker: str, start: int, stop: int, score: np.ndarray) -> Event:
    """Make the event of samples that were not measured: on all axes, since each sample is wrong as a whole.

    Parameters
    ----------
    marker : str
        Name of the marker.
    start, stop : int
        The stretch, [start, stop).
    score : np.ndarray
        Discrepancies, in units of the threshold.

    Returns
    -------
    Event
        The event, with the largest discrepancy as its score.
    """
    return Event(marker, start, stop, float(max(1.0, score.max())))
