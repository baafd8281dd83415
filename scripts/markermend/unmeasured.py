"""What frozen positions and noisy tails have in common: samples in the file that nobody measured, and that tells.

Where a marker was out of sight, a capture program may repeat its last position, or let the samples next to the gap wander
off. Both look like measurements. What gives them away is that the neighbours and the marker's own course around them say
otherwise.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from markermend import detection, storage
from markermend.events import Event
from markermend.predictors import Predictor, Scene
from markermend.predictors.local import LocalRidge, RidgeOptions
from markermend.stage import Stage, mapping

Place = tuple[int, int, int]
"""A stretch of one marker: its index, and the half-open interval."""


def hiding(scene: Scene, places: Sequence[Place]) -> Scene:
    """The scene without any of the places: none of them vouches for another."""
    covered = np.zeros(scene.positions.shape, bool)
    for m, start, stop in places:
        covered[start:stop, m] = True
    return detection.without(scene, covered)


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


def stage(name: str, description: str, *, finds: str) -> Stage:
    """A detector of such samples as a command: its files, and the predictor's settings."""
    command = detection.files(name, description, finds=finds)
    command.option("local_ridge", mapping, "settings of the predictor")
    return command


def search(call: Any, detect: Callable[..., list[Event]], settings: type) -> str:
    """Do the work of such a detector as a command, and return the line of result.

    call: the stage's files and options. detect: the detector. settings: what its own options make. Raises SetAside where
    the recording was set aside.
    """
    recording, scene, earlier = detection.read(call.markers, call.mesh, call.earlier)
    options = dict(call.options)
    predictor = LocalRidge(RidgeOptions(**options.pop("local_ridge")))
    given = {"markers": recording.markers, "earlier": earlier, "predictor": predictor}
    found = detect(scene, settings=settings(**options), **given)
    storage.write_events(call.events, found, call.facts)
    return detection.result(found)


def event(marker: str, start: int, stop: int, score: np.ndarray) -> Event:
    """The finding over [start, stop): all axes, since the sample as a whole was not measured."""
    return Event(marker, start, stop, float(max(1.0, score.max())))
