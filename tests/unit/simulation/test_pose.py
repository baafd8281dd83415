"""Joint angles over time: rises from rest to rest, and soles that are level."""

import numpy as np
import pytest

from markermend.simulation.pose import Pose, minimum_jerk
from markermend.simulation.walker_body import make_body


def test_minimum_jerk_starts_and_ends_at_rest():
    time = np.linspace(-1, 2, 3001)
    rise = minimum_jerk(time, 0.0, 1.0)
    assert (rise[time <= 0] == 0).all()
    assert (rise[time >= 1] == 1).all()
    assert np.gradient(rise, time).max() == pytest.approx(1.875, rel=1e-3)
    assert np.abs(np.gradient(rise, time)[[999, 2001]]).max() < 1e-4


@pytest.mark.parametrize("share", [1.0, 0.5, 0.0])
def test_soles_are_turned_level_by_a_share(share):
    pose = Pose(make_body(rng=np.random.default_rng(1)), np.zeros(2))
    pose.add("pelvis", 10.0)
    pose.add("thigh", 30.0)
    pose.add("shank", 50.0)
    pose.plant(share)
    foot = pose.angles[:, pose.body.segments.index("left_foot"), 0]
    np.testing.assert_allclose(foot, share * (50.0 - 30.0 + 10.0))
