"""Frozen markers: one position repeated, bit for bit, while the marker is predicted to move."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from markermend.core.events import Event
from markermend.detection import inputs, prediction_discrepancy
from markermend.detection.prediction_discrepancy import Stretch
from markermend.numerics.intervals import runs
from markermend.options.detection.frozen import FrozenOptions
from markermend.prediction.interface import Predictor
from markermend.prediction.scene import Scene

MIN_NEIGHBOURS = 3
"""Neighbours that must be observed throughout a stretch, at least."""


def detect_frozen(
    scene: Scene, *, markers: Sequence[str], earlier: np.ndarray, options: FrozenOptions, predictor: Predictor
) -> list[Event]:
    """Find the frozen stretches of a recording.

    A marker whose neighbours rest (as in integer files with their coarse steps), or that is predicted to rest (such as a
    planted foot, or a prop), is not frozen.

    Parameters
    ----------
    scene : Scene
        What is observed; nothing is found where it is missing.
    markers : Sequence[str]
        Names of the markers.
    earlier : np.ndarray
        What earlier detectors claimed, bool, like the positions.
    options : FrozenOptions
        Shortest stretch, smallest motion, threshold of the discrepancy, and number of neighbours.
    predictor : Predictor
        Predicts each marker from its neighbours and its own trajectory.

    Returns
    -------
    list[Event]
        Disjoint events, sorted; the first sample of each position was measured and is not part of them.
    """
    scene = inputs.without_claimed(scene, earlier)
    stretches = list(_repeated(scene, options))
    hidden = prediction_discrepancy.hide_stretches(scene, stretches)
    found = []
    for stretch in stretches:
        score = prediction_discrepancy.discrepancy(
            scene, hidden, stretch, predictor=predictor, sigmas=options.threshold_sigmas, floor_mm=options.floor_mm
        )
        if score.max() >= 1:
            m, start, stop = stretch
            found.append(prediction_discrepancy.unmeasured_event(markers[m], start, stop, score))
    return sorted(found, key=lambda event: event.order)


def _repeated(scene: Scene, options: FrozenOptions) -> Iterator[Stretch]:
    """The stretches, without their first samples, that repeat a position while the nearest neighbours move."""
    same = (scene.positions[1:] == scene.positions[:-1]).all(axis=2)
    for m, around in enumerate(scene.neighbours):
        for first, last in runs(same[:, m]):
            long_enough = last - first + 1 >= options.min_frames
            if long_enough and _neighbours_move(scene, np.asarray(around, int), first, last + 1, options):
                yield m, first + 1, last + 1


def _neighbours_move(scene: Scene, around: np.ndarray, start: int, stop: int, options: FrozenOptions) -> bool:
    """Whether each of the nearest neighbours that are observed throughout moves by more than the floor."""
    seen = around[scene.present[start:stop, around].all(axis=0)][: options.neighbours]
    moved = np.linalg.norm(np.ptp(scene.positions[start:stop, seen], axis=0), axis=1)
    return len(seen) >= MIN_NEIGHBOURS and bool((moved > options.floor_mm).all())
