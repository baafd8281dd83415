"""What neighbours cannot judge is left out."""

import numpy as np

from markermend.core.events import Event
from markermend.core.shape import Shape
from markermend.detection import inputs
from markermend.options.shape import ShapeOptions
from markermend.prediction.scene import Scene

MARKERS = ("a", "b", "c", "d", "puck")


def test_events_of_markers_that_keep_no_distances_are_left_out():
    spread = np.full((5, 5), 5.0)
    spread[4] = spread[:, 4] = [20.0, 90.0, 125.0, 150.0, 0.0]
    shape = Shape(np.full((5, 5), 300.0), spread, spread)
    assert shape.unsteady(mates=3, max_spread_mm=100).tolist() == [False] * 4 + [True]
    assert not shape.unsteady(mates=2, max_spread_mm=100).any()
    assert not shape.unsteady(mates=5, max_spread_mm=100).any()
    scene = Scene(np.zeros((10, 5, 3)), 100.0, [np.arange(5)] * 5, shape=shape)
    found = [Event(name, 2, 5, 2.0, "xyz") for name in MARKERS]
    assert inputs.of_steady_markers(found, scene, MARKERS, ShapeOptions()) == found[:4]
    assert (
        inputs.of_steady_markers(found, Scene(scene.positions, 100.0, scene.neighbours), MARKERS, ShapeOptions())
        == found
    )
