"""A rigid displacement is fitted and undone; points that do not fit do not count."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from markermend.numerics.rigid_displacement import fit_displacement

TURN = Rotation.from_rotvec(np.radians([0.5, -1.0, 0.3]))
SHIFT = np.array([12.0, -4.0, 7.0])


@pytest.fixture
def points():
    return np.random.default_rng(4).normal(0, 400, (20, 3)) + np.array([1000, 200, 900])


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
