"""Bones are the steadiest distances, with their means and deviations."""

import numpy as np
import pytest

from markermend.prediction.scene import Scene
from markermend.prediction.state_space.bone_lengths import Bones, select_bones


def test_the_steadiest_distances_are_the_bones():
    rng = np.random.default_rng(5)
    shape = np.array([[0, 0, 0], [100.0, 0, 0], [0, 200, 0], [0, 0, 300]])
    positions = shape + rng.normal(size=(400, 4, 3)) * np.array([0.1, 0.1, 5.0, 0.2])[:, None]
    scene = Scene(positions, 100.0, [np.delete(np.arange(4), m) for m in range(4)])
    bones = select_bones(scene, np.arange(4), np.array([0]), count=2, max_frames=400, min_frames=10)
    assert bones.pairs.tolist() == [[0, 1], [0, 3]]
    assert bones.length == pytest.approx([100, 300], abs=0.1)
    assert (bones.deviation < 1).all()


def test_pairs_are_places_in_the_body_and_each_is_there_once():
    positions = np.random.default_rng(6).normal(size=(50, 5, 3)) + np.arange(5)[:, None] * 100.0
    scene = Scene(positions, 100.0, [np.delete(np.arange(5), m) for m in range(5)])
    bones = select_bones(scene, np.array([4, 2]), np.array([2, 4]), count=3, max_frames=50, min_frames=10)
    assert bones.pairs.tolist() == [[0, 1]]


def test_lengths_in_another_unit_keep_a_least_deviation():
    bones = Bones(np.array([[0, 1], [1, 2]]), np.array([100.0, 200.0]), np.array([0.1, 30.0])).rescaled(10.0, 0.5)
    assert bones.length.tolist() == [10, 20] and bones.deviation.tolist() == [0.5, 3]
