"""Neighbourhoods: whose residuals may share an artifact, and which of overlapping events is the strongest."""

import numpy as np

from markermend.core.events import Event
from markermend.detection.neighbour.neighbourhood import Neighbourhood, overlap
from markermend.prediction.scene import Scene


def test_neighbours_are_mutual():
    scene = Scene(np.zeros((1, 4, 3)), 100.0, [np.array(own) for own in ([1, 2, 3], [0, 2, 3], [1, 0, 3], [2, 1, 0])])
    assert Neighbourhood.of(scene, "ABCD", 1).neighbours == [{1}, {0, 2}, {1, 3}, {2}]


def test_of_events_that_overlap_on_neighbours_the_strongest_is_kept_unless_a_stronger_one_displaces_it():
    around = Neighbourhood("ABCD", [{1}, {0, 2}, {1, 3}, {2}])
    chain = [Event(name, 0, 10, score) for name, score in zip("ABCD", (9, 8, 7, 6), strict=True)]
    assert around.strongest(set(chain)) == {chain[0], chain[2]}
    assert around.contested(chain[:1] + chain[2:3], 10) == []
    assert around.contested(chain[:2], 10) == chain[:2]
    assert around.borders({Event("B", 3, 5, 1.0)}) == {0: {3, 5}, 2: {3, 5}}


def test_events_that_touch_do_not_overlap():
    assert not overlap(Event("A", 0, 5, 1.0), Event("B", 5, 9, 1.0))
    assert overlap(Event("A", 0, 6, 1.0), Event("B", 5, 9, 1.0))
