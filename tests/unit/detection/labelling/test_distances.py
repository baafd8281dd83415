"""Usual distances, and the markers to which they are taken."""

import numpy as np
import pytest

from markermend.detection.labelling.distances import distances, length, markers_around, usual_distances
from markermend.prediction.scene import Scene


def test_neighbours_are_listed_once_and_without_the_markers():
    near = [np.array(own) for own in ([1, 2, 3], [0, 3, 4], [0, 1, 3], [1, 0, 2], [1, 0, 2])]
    scene = Scene(np.zeros((2, 5, 3)), 100.0, near)
    assert markers_around(scene, (0, 1), 2).tolist() == [2, 3]
    assert markers_around(scene, (0, 1), 3).tolist() == [2, 3, 4]


def test_usual_distances_are_medians_of_what_is_seen():
    measured = np.random.default_rng(3).normal(100, 5, (400, 2, 3))
    measured[:100, 0, 1] = np.nan
    measured[:, 1, 2] = np.nan
    usual, spread = usual_distances(measured)
    assert usual[0, 1] == np.median(measured[100:, 0, 1])
    assert spread[0, 0] == pytest.approx(np.ptp(np.quantile(measured[:, 0, 0], [0.16, 0.84])))
    assert np.isnan(usual[1, 2]) and np.isnan(spread[1, 2])


def test_without_any_marker_around_there_are_no_usual_distances():
    for measured in (np.zeros((10, 2, 0)), np.full((10, 2, 1), np.nan)):
        usual, spread = usual_distances(measured)
        assert usual.shape == spread.shape == measured.shape[1:]
        assert np.isnan(usual).all() and np.isnan(spread).all()


def test_lengths_are_euclidean():
    vectors = np.random.default_rng(1).normal(size=(5, 4, 3))
    np.testing.assert_allclose(length(vectors), np.linalg.norm(vectors, axis=-1))


def test_distances_are_those_of_every_two_points():
    some, others = np.random.default_rng(2).normal(size=(2, 5, 4, 3))
    found = distances(some, others[:, :2])
    assert found.shape == (5, 4, 2) and found[3, 2, 1] == pytest.approx(np.linalg.norm(some[3, 2] - others[3, 1]))
