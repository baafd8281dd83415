"""Usual distances, and the markers to which they are taken."""

import numpy as np
import pytest

from markermend.detection.labelling.distances import markers_around, usual_distances
from markermend.prediction.scene import Scene


def test_neighbours_are_listed_once_and_without_the_markers():
    near = [np.array(own) for own in ([1, 2, 3], [0, 3, 4], [0, 1, 3], [1, 0, 2], [1, 0, 2])]
    scene = Scene(np.zeros((2, 5, 3)), 100.0, near)
    assert markers_around(scene, (0, 1), 2).tolist() == [2, 3]
    assert markers_around(scene, (0, 1), 3).tolist() == [2, 3, 4]


def test_usual_distances_are_medians_of_what_is_seen():
    distances = np.random.default_rng(3).normal(100, 5, (400, 2, 3))
    distances[:100, 0, 1] = np.nan
    distances[:, 1, 2] = np.nan
    usual, spread = usual_distances(distances)
    assert usual[0, 1] == np.median(distances[100:, 0, 1])
    assert spread[0, 0] == pytest.approx(np.ptp(np.quantile(distances[:, 0, 0], [0.16, 0.84])))
    assert np.isnan(usual[1, 2]) and np.isnan(spread[1, 2])


def test_without_any_marker_around_there_are_no_usual_distances():
    for distances in (np.zeros((10, 2, 0)), np.full((10, 2, 1), np.nan)):
        usual, spread = usual_distances(distances)
        assert usual.shape == spread.shape == distances.shape[1:]
        assert np.isnan(usual).all() and np.isnan(spread).all()
