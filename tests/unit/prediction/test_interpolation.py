"""Interpolation in time against analytic trajectories and scipy on the whole trajectory."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from markermend.prediction.interpolation import KINDS, Interpolation
from markermend.prediction.scene import Scene


def trajectory(function, frames=120):
    time = np.arange(frames) / 100.0
    return np.stack([function(time), function(time + 0.1), function(time + 0.2)], axis=1)[:, None]


def predict(kind, positions, start, stop, knots=30):
    scene = Scene(positions, 100.0, [np.array([], int)])
    return Interpolation(kind, knots=knots).predict(scene, 0, start, stop)


@pytest.mark.parametrize("kind", KINDS)
def test_a_straight_trajectory_is_continued_by_every_kind(kind):
    positions = trajectory(lambda t: 3 + 100 * t)
    found = predict(kind, positions, 50, 60)
    assert np.allclose(found.positions, positions[49:61, 0])
    assert np.isnan(found.error).all()


def test_a_spline_follows_a_cubic_exactly():
    positions = trajectory(lambda t: 5 - 3 * t + 40 * t**2 - 200 * t**3)
    assert np.allclose(predict("spline", positions, 50, 80).positions, positions[49:81, 0])


def test_pchip_does_not_overshoot():
    positions = trajectory(lambda t: np.where(t < 0.55, 0.0, 100.0))
    found = predict("pchip", positions, 50, 60).positions
    assert found.min() >= 0 and found.max() <= 100


def test_thirty_knots_equal_the_spline_through_all_samples():
    positions = trajectory(lambda t: 300 * np.sin(4 * t) + 20 * np.sin(20 * t), frames=800)
    known = np.r_[0:400, 420:800]
    whole = CubicSpline(known, positions[known, 0])(np.arange(399, 421))
    assert np.abs(predict("spline", positions, 400, 420).positions - whole).max() < 1e-6


def test_an_adjacent_gap_is_bridged_too():
    positions = trajectory(lambda t: 10 * t)
    positions[45:48] = np.nan
    positions[61:70] = np.nan
    found = predict("linear", positions, 50, 60).positions
    assert np.allclose(found, trajectory(lambda t: 10 * t)[49:61, 0])


def test_an_unknown_kind_is_refused():
    with pytest.raises(ValueError, match="unknown interpolation"):
        Interpolation("quintic", knots=30)
