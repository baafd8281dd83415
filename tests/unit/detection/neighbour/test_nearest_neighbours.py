"""The nearest neighbours of a marker: their motion, the largest of their sizes, and whether they are seen."""

import numpy as np
import pytest

from markermend.detection.neighbour import nearest_neighbours

RATE = 100.0


def test_motion_is_that_of_the_neighbours():
    t = np.arange(200) / RATE
    positions = np.zeros((200, 3, 3))
    positions[:, 0, 0] = 1000 * t**2
    positions[:, 1, 1] = 300 * t
    positions[50:60, 2] = np.nan
    near = [np.array([1, 2]), np.array([0, 2]), np.array([], int)]
    speed, acceleration = nearest_neighbours.motion(positions, near, rate=RATE, count=2, smoothing=5)
    assert speed[100, 0] == pytest.approx(150) and acceleration[100, 0] == pytest.approx(0, abs=1e-6)
    assert acceleration[100, 1] == pytest.approx(2000 / np.sqrt(2))
    assert not speed[:, 2].any() and np.isfinite(speed).all()


def test_the_motion_of_the_nearest_neighbours_that_are_seen_counts():
    size = np.array([[0.0, 5.0, 3.0, 2.0], [0.0, np.nan, 3.0, 4.0], [0.0, np.nan, np.nan, np.nan]])
    largest = nearest_neighbours.maximum(size, [np.array([1, 2, 3]), *[np.array([0])] * 3], 2)
    np.testing.assert_array_equal(largest[:, 0], [5.0, 4.0, 0.0])


def test_the_share_of_the_nearest_neighbours_that_are_seen():
    present = np.array([[True, True, True], [True, False, True]])
    share = nearest_neighbours.seen_share(present, [np.array([1, 2]), np.array([2, 0]), np.array([], int)], 1)
    np.testing.assert_array_equal(share, [[1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
