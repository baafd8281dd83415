"""What the detectors share: a scene without what is already explained, and the markers that neighbours can judge."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from markermend.core.events import Event
from markermend.options.shape import ShapeOptions
from markermend.prediction.scene import Scene


def without_claimed(scene: Scene, claimed: np.ndarray) -> Scene:
    """Hide the samples of which any coordinate is claimed: they are no inputs, train nothing, and have no residual.

    Parameters
    ----------
    scene : Scene
        What is observed. Not modified.
    claimed : np.ndarray
        Bool, like the positions.

    Returns
    -------
    Scene
        The scene without them.
    """
    positions = scene.positions.copy()
    positions[claimed.any(axis=2)] = np.nan
    return replace(scene, positions=positions)


def of_steady_markers(
    found: Iterable[Event], scene: Scene, markers: Sequence[str], options: ShapeOptions
) -> list[Event]:
    """Leave out the events of markers that keep their distances to too few others: neighbours cannot judge them.

    Parameters
    ----------
    found : iterable of Event
        The events.
    scene : Scene
        What is observed, with the usual shape.
    markers : sequence of str
        Names of the markers.
    options : ShapeOptions
        Number of distances that must be kept, and how well.

    Returns
    -------
    list of Event
        Those of the other markers; all without a shape.
    """
    if scene.shape is None:
        return list(found)
    unsteady = scene.shape.unsteady(mates=options.steady_mates, max_spread_mm=options.max_mate_spread_mm)
    names = {markers[int(m)] for m in np.flatnonzero(unsteady)}
    return [event for event in found if event.marker not in names]
