"""Rigid alignment: equal to Kabsch frame by frame, exact under rigid motion, never mirrored, and what lines and planes give."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from markermend.numerics.rigid_alignment import align, mean_shape, nearest_rotations, width
from support.naive import numerics as naive

SHAPE = np.array([[0.0, 0, 0], [100, 0, 0], [0, 60, 0], [10, 20, 40]])


def moving(shape, frames=50, seed=3):
    rng = np.random.default_rng(seed)
    turns = Rotation.random(frames, random_state=4)
    places = rng.uniform(-1000, 1000, (frames, 3))
    return np.stack([turns.apply(point) for point in shape], axis=1) + places[:, None], turns, places


@pytest.mark.parametrize("markers", [3, 4])
def test_rigid_motion_is_found_exactly(markers):
    template = SHAPE[:markers] - SHAPE[:markers].mean(axis=0)
    points, turns, places = moving(template)
    frames = align(points, template)
    assert np.allclose(frames.axes, turns.as_matrix(), atol=1e-9)
    assert np.allclose(frames.origin, places)
    assert np.allclose(frames.local(points), template)
    assert np.allclose(frames.local(points[:, 1]), template[1])
    assert np.allclose(frames.laboratory(frames.local(points[:, 1])), points[:, 1])


def test_a_mirrored_shape_is_never_met_by_a_reflection():
    template = SHAPE - SHAPE.mean(axis=0)
    frames = align(moving(template * [1, 1, -1])[0], template)
    assert np.allclose(np.linalg.det(frames.axes), 1)


def test_agrees_with_scipy_on_noisy_points():
    template = SHAPE - SHAPE.mean(axis=0)
    points = moving(template)[0] + np.random.default_rng(5).normal(0, 2, (50, 4, 3))
    found = align(points, template)
    for frame in (0, 20, 49):
        expected, _ = Rotation.align_vectors(points[frame] - found.origin[frame], template)
        assert np.allclose(found.axes[frame], expected.as_matrix(), atol=1e-6)


def test_points_on_a_line_still_give_rotations():
    line = np.array([[-50.0, 0, 0], [0, 0, 0], [50, 0, 0]])
    points, _, _ = moving(line)
    frames = align(points, line)
    assert np.allclose(frames.axes @ frames.axes.transpose(0, 2, 1), np.eye(3), atol=1e-9)
    assert np.allclose(np.linalg.det(frames.axes), 1)
    assert np.allclose(frames.local(points), line, atol=1e-9)


def test_the_mean_shape_is_the_shape_and_bears_outliers():
    points, _, _ = moving(SHAPE)
    points[7, 2] += 500
    shape = mean_shape(points)
    between = np.linalg.norm(shape[:, None] - shape, axis=2)
    assert np.allclose(between, np.linalg.norm(SHAPE[:, None] - SHAPE, axis=2), atol=1e-6)
    assert np.allclose(shape.mean(axis=0), 0, atol=1e-9)


def test_width_is_nothing_on_a_line():
    assert width(np.array([[0.0, 0, 0], [1, 1, 1], [5, 5, 5]])) == pytest.approx(0, abs=1e-9)
    assert width(np.array([[0.0, 0, 0], [2, 0, 0], [0, 2, 0], [2, 2, 0]])) == pytest.approx(1)


@pytest.mark.parametrize("rank", [1, 2, 3])
def test_nearest_rotations_equal_singular_values(rank):
    rng = np.random.default_rng(rank)
    matrices = rng.normal(size=(500, 3, rank)) @ rng.normal(size=(500, rank, 3))
    found = nearest_rotations(100 * matrices)
    assert np.allclose(found @ found.transpose(0, 2, 1), np.eye(3), atol=1e-12)
    assert np.allclose(np.linalg.det(found), 1)
    left, _, right = np.linalg.svd(matrices)
    left[:, :, 2] *= np.sign(np.linalg.det(left @ right))[:, None]
    if rank > 1:
        assert np.abs(found - left @ right).max() < 1e-7
    # Where many are equally near, as with rank 1, any of them will do.
    reached = [np.einsum("nij,nij->n", each, matrices) for each in (found, left @ right)]
    assert np.allclose(*reached)


def test_points_without_extent_still_get_a_rotation():
    found = nearest_rotations(np.zeros((2, 3, 3)))
    assert np.allclose(np.linalg.det(found), 1)


def test_alignment_equals_kabsch_frame_by_frame():
    template = SHAPE - SHAPE.mean(axis=0)
    points = moving(template)[0] + np.random.default_rng(6).normal(0, 5, (50, 4, 3))
    found, (rotations, origins) = align(points, template), naive.kabsch(points, template)
    assert np.allclose(found.axes, rotations, atol=1e-9)
    assert np.allclose(found.origin, origins)
