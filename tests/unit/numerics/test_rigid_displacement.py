"""A rigid displacement of a scene is fitted, undone, and estimated from the motion at the edges of a stretch."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from markermend.numerics.rigid_displacement import displacement_over, fit_displacement

TURN = Rotation.from_rotvec(np.radians([0.5, -1.0, 0.3]))
SHIFT = np.array([12.0, -4.0, 7.0])


@pytest.fixture
def points():
    return np.random.default_rng(4).normal(0, 400, (20, 3)) + np.array([1000, 200, 900])


def moving(points, frames=60):
    """Points that turn about each other and accelerate."""
    seconds = np.arange(frames)[:, None, None] / 100
    away = 1200 * seconds + 900 * seconds**2
    return points + away * np.array([1.0, 0.2, 0.1]) + 300 * seconds**2 * np.sin(np.arange(len(points)))[:, None]


def test_fit_agrees_with_scipy_and_is_undone(points):
    displaced = TURN.apply(points) + SHIFT
    displaced[3] = np.nan
    fitted = fit_displacement(points, displaced)
    naive, _ = Rotation.align_vectors(
        *(np.delete(each, 3, 0) - np.delete(each, 3, 0).mean(0) for each in (displaced, points))
    )
    np.testing.assert_allclose(fitted.rotation, naive.as_matrix(), atol=1e-9)
    np.testing.assert_allclose(fitted.undo(fitted.displace(points)), points, atol=1e-9)
    assert fitted.residual_mm < 1e-6 and fitted.points == 19


def test_points_that_do_not_fit_do_not_count(points):
    displaced = points + SHIFT
    displaced[:3] += 300.0
    np.testing.assert_allclose(fit_displacement(points, displaced).displace(points[5]), points[5] + SHIFT, atol=1e-6)


def test_two_points_fix_nothing(points):
    assert fit_displacement(points[:2], points[:2] + SHIFT) is None


@pytest.mark.parametrize(
    ("start", "stop", "returns"), [(20, 21, True), (20, 22, True), (20, 45, True), (30, 60, False)]
)
def test_displacement_is_estimated_from_the_edges(points, start, stop, returns):
    true = moving(points)
    positions = true.copy()
    positions[start:stop] += SHIFT
    back = displacement_over(positions, start, stop, returns=returns).undo(positions[start:stop])
    assert np.abs(back - true[start:stop]).max() < 0.1
