"""Frozen markers: one position repeated, bit for bit, while the neighbours tell that the marker moved on."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from markermend.core.events import Event
from markermend.detection import inputs, prediction_discrepancy
from markermend.detection.prediction_discrepancy import Place
from markermend.numerics.intervals import runs
from markermend.options.detection import FrozenOptions
from markermend.prediction.scene import Predictor, Scene


def detect_frozen(
    scene: Scene, *, markers: Sequence[str], earlier: np.ndarray, options: FrozenOptions, predictor: Predictor
) -> list[Event]:
    """Find frozen stretches; the first sample of each was measured and is not part of it.

    scene: positions (frames, markers, 3), mm, NaN = missing. earlier: bool, like positions, what is not to be looked
    at. A marker whose neighbours rest, as in integer files with their coarse steps, or that is at rest by what they tell,
    such as a planted foot, a seated person's or a prop's, is not frozen.
    """
    scene = inputs.without(scene, earlier)
    places = list(_repeated(scene, options))
    hidden = prediction_discrepancy.hiding(scene, places)
    found = []
    for place in places:
        score, _ = prediction_discrepancy.disagreement(
            scene, hidden, place, predictor=predictor, sigmas=options.threshold_sigmas, floor_mm=options.floor_mm
        )
        if score.max() >= 1:
            found.append(prediction_discrepancy.event(markers[place[0]], *place[1:], score))
    return sorted(found, key=lambda event: event.order)


def _repeated(scene: Scene, options: FrozenOptions) -> Iterator[Place]:
    """Where a position is repeated while the nearest neighbours that are seen move, without its first sample."""
    same = (scene.positions[1:] == scene.positions[:-1]).all(axis=2)
    for m, around in enumerate(scene.neighbours):
        for first, last in runs(same[:, m]):
            long_enough = last - first + 1 >= options.min_frames
            if long_enough and _moves(scene, np.asarray(around, int), first, last + 1, options):
                yield m, first + 1, last + 1


def _moves(scene: Scene, around: np.ndarray, start: int, stop: int, options: FrozenOptions) -> bool:
    """Whether each of the nearest neighbours that are seen throughout moves by more than the floor; there must be three."""
    seen = around[scene.present[start:stop, around].all(axis=0)][: options.neighbours]
    course = scene.positions[start:stop, seen]
    return len(seen) >= 3 and bool((np.linalg.norm(np.ptp(course, axis=0), axis=1) > options.floor_mm).all())
