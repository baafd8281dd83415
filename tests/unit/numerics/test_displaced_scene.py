"""A displaced scene is moved back, also where it rings before it settles."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from markermend.numerics.displaced_scene import jumps, move_back

TURN = Rotation.from_rotvec(np.radians([0.2, -0.4, 0.3]))
SHIFT = np.array([12.0, -4.0, 7.0])


@pytest.fixture
def points():
    return np.random.default_rng(4).normal(0, 400, (20, 3)) + np.array([1000, 200, 900])


def moving(points, frames=60):
    """Points that turn about each other and accelerate."""
    seconds = np.arange(frames)[:, None, None] / 100
    away = 1200 * seconds + 900 * seconds**2
    return points + away * np.array([1.0, 0.2, 0.1]) + 300 * seconds**2 * np.sin(np.arange(len(points)))[:, None]


@pytest.mark.parametrize(
    ("start", "stop", "returns"), [(20, 21, True), (20, 22, True), (20, 45, True), (30, 60, False)]
)
@pytest.mark.parametrize("rings", [False, True])
def test_a_scene_is_moved_back(points, start, stop, returns, rings):
    true = moving(points)
    displaced = TURN.apply(true.reshape(-1, 3)).reshape(true.shape) + SHIFT - true
    time = np.arange(60) - start
    size = np.where((time >= 0) & (time < stop - start), 1.0, 0.0)
    size *= 1 + rings * 0.4 * np.exp(-np.maximum(time, 0) / 2) * np.cos(np.pi * time)
    moved, error = move_back(true + size[:, None, None] * displaced, start, stop, returns=returns)
    off = np.abs(moved - true[start:stop]).max()
    assert off < ((1.5 if returns else 6) if rings else 0.3)
    assert error.shape == moved.shape[:2] and (error >= 0).all()


def test_too_few_points_are_not_moved(points):
    assert move_back(moving(points)[:, :2], 20, 40, returns=True) is None


def test_jumps_agree_with_a_loop(points):
    positions = moving(points)
    positions[20:] += SHIFT
    found = jumps(positions)
    for frame in (2, 19, 20, 21, 40, 58):
        before = 1.5 * positions[frame - 1] - 0.5 * positions[frame - 2]
        after = 1.5 * positions[frame] - 0.5 * positions[frame + 1]
        np.testing.assert_allclose(found[frame], np.linalg.norm(after - before, axis=1), atol=1e-9)
    assert np.isnan(found[[0, 1, 59]]).all()
