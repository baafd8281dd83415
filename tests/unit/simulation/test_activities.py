"""Each activity moves the joints as people do."""

import numpy as np
import pytest

from markermend.simulation.activities import minimum_jerk
from support.walkers import marker, person, speed


def test_sitting_lowers_the_pelvis_and_standing_up_raises_it_again():
    walker = person(9, duration=9.0, activities=["stand", "sit", "stand"])
    height = marker(walker, "LASI")[:, 2]
    bout = walker.bouts[1]
    seated = height[round((bout[1] + 1.2) * 100) : round((bout[2] - 1.2) * 100)]
    assert np.median(height[:50]) - np.median(seated) > 250
    assert abs(height[round((bout[2] + 1.0) * 100)] - height[0]) < 40


def test_a_standing_person_hardly_moves():
    walker = person(11, duration=4.0, activities=["stand"], noise=0.0)
    assert walker.recording.positions.std(axis=0).max() < 12
    assert speed(walker, "LFIN").max() < 0.05


def test_minimum_jerk_starts_and_ends_at_rest():
    time = np.linspace(-1, 2, 3001)
    rise = minimum_jerk(time, 0.0, 1.0)
    assert (rise[time <= 0] == 0).all()
    assert (rise[time >= 1] == 1).all()
    assert np.gradient(rise, time).max() == pytest.approx(1.875, rel=1e-3)
    assert np.abs(np.gradient(rise, time)[[999, 2001]]).max() < 1e-4
