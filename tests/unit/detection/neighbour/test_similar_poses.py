"""Similar poses: distances against those predicted from the same poses at other times, pose by pose."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.detection.neighbour.similar_poses import SimilarPoses
from markermend.options.detection.level import SimilarPosesOptions
from markermend.prediction.scene import Scene
from support.naive import level_shifts as naive

RATE = 100.0
FRAMES = 400
OPTIONS = SimilarPosesOptions()


def bending(*, seed=0):
    """A marker and four neighbours of a body that bends four times; the distances of the marker rise by 6 mm with it."""
    bend = np.sin(4 * np.pi * np.arange(FRAMES) / FRAMES) ** 2
    corners = np.array([[50.0, 50, 50], [0, 0, 0], [100, 0, 0], [0, 100, 0], [0, 0, 100]])
    positions = np.broadcast_to(corners, (FRAMES, 5, 3)) + np.random.default_rng(seed).normal(0, 0.1, (FRAMES, 5, 3))
    positions[:, 1, 0] -= 40 * bend
    positions[:, 0] += 6 * (bend > 0.5)[:, None] * np.array([0.0, 0.6, 0.8])
    return Scene(positions, RATE, [np.arange(1, 5), *(np.zeros(0, int) for _ in range(4))])


def test_what_recurs_with_the_pose_is_predicted():
    poses, frames = SimilarPoses(bending(), 0, replace(OPTIONS, poses=3)), np.array([50, 150])
    predicted, deviation = poses.predict(frames, (30, 70))
    own = poses.distances(poses.scene.positions[frames, 0], frames)
    assert np.abs(predicted - own).max() < 0.5
    assert deviation.max() < 1


def test_the_prediction_is_that_of_the_naive_twin():
    scene = bending(seed=1)
    scene.positions[100:140, 2] = np.nan
    scene.positions[200:230, 0] = np.nan
    frames, excluded = np.array([45, 110, 260]), (250, 290)
    predicted = SimilarPoses(scene, 0, OPTIONS).predict(frames, excluded)
    expected = naive.distances_at_similar_poses(scene, 0, frames, excluded, OPTIONS)
    for one, other in zip(predicted, expected, strict=True):
        np.testing.assert_allclose(one, other, atol=1e-9)


@pytest.mark.parametrize(
    ("options", "excluded"), [(OPTIONS, (0, FRAMES)), (replace(OPTIONS, min_poses=10, poses=9), (0, 10))]
)
def test_too_few_poses_predict_nothing(options, excluded):
    predicted, deviation = SimilarPoses(bending(), 0, options).predict(np.array([5]), excluded)
    assert np.isnan(predicted).all()
    assert np.isnan(deviation).all()


def test_a_marker_without_neighbours_has_no_distances():
    predicted, _ = SimilarPoses(bending(), 1, OPTIONS).predict(np.array([5, 9]), (0, 10))
    assert predicted.shape == (2, 0)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("distance_slope", [0.0, OPTIONS.distance_slope])
def test_poses_without_a_distance_in_common_do_not_count(distance_slope):
    """Half of the frames lack three of the four neighbours, so that no distance of theirs is known."""
    scene = bending()
    scene.positions[:200, 2:] = np.nan
    frames, options = np.array([250, 350]), replace(OPTIONS, poses=FRAMES, distance_slope=distance_slope)
    predicted, deviation = SimilarPoses(scene, 0, options).predict(frames, (240, 260))
    assert np.isfinite(predicted).all() and np.isfinite(deviation).all()
    unknown = SimilarPoses(scene, 0, OPTIONS).predict(np.array([50]), (0, 10))
    assert np.isnan(unknown[0]).all()
