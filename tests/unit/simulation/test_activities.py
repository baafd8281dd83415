"""The synthetic person can do what the options name, and starts and ends each activity standing."""

from typing import get_args

import numpy as np
import pytest

from markermend.evaluation.synthetic_options import Activity
from markermend.simulation.activities import ACTIVITIES
from support.walkers import acceleration, marker, person


def test_the_options_name_all_activities():
    assert set(get_args(Activity)) == set(ACTIVITIES)


@pytest.mark.parametrize("name", ACTIVITIES)
@pytest.mark.parametrize("seed", [1, 2])
def test_an_activity_joins_standing_smoothly(name, seed):
    walker = person(seed, duration=12.0, activities=["stand", name], noise=0.0)
    height = marker(walker, "LFHD")[:, 2]
    for bout, start, stop in walker.bouts:
        middle = round((start + stop) / 2 * 100)
        if bout == "stand" and middle < len(height):
            assert abs(height[middle] - height[0]) < 60
    assert acceleration(walker, "LASI").max() < 60
    assert np.linalg.norm(np.diff(walker.rigid, axis=0), axis=2).max() < 100


@pytest.mark.parametrize("name", ACTIVITIES)
def test_no_activity_sinks_into_the_ground(name):
    walker = person(3, duration=10.0, activities=["stand", name], noise=0.0)
    assert walker.rigid[:, :, 2].min() > -60
