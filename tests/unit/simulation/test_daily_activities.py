"""The activities of every day move the joints as people do."""

import numpy as np

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


def test_walking_backward_is_slow_and_against_the_direction_of_the_feet():
    walker = person(12, duration=4.5, activities=["walk_backward"])
    rows = slice(80, 320)
    feet = (marker(walker, "LTOE") - marker(walker, "LHEE") + marker(walker, "RTOE") - marker(walker, "RHEE"))[rows, :2]
    moved = np.gradient(marker(walker, "LASI")[:, :2], 0.01, axis=0)[rows] / 1000
    ahead = (moved * feet).sum(axis=1) / np.linalg.norm(feet, axis=1)
    assert -1.2 < np.median(ahead) < -0.6
