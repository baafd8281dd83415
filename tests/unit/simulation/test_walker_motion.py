"""The walker moves at human speed, in activities one after the other."""

import numpy as np
import pytest

from markermend.simulation.activities import ACTIVITIES
from support.walkers import DAILY, acceleration, person, speed


@pytest.mark.parametrize("seed", range(4))
def test_speeds_and_accelerations_are_human(seed):
    walker = person(seed, duration=16.0)
    stand, walking = walker.bouts[0], next(bout for bout in walker.bouts if bout[0] == "walk")
    rows = slice(round((walking[1] + 1) * 100), round((walking[2] - 1) * 100))
    assert speed(walker, "LASI")[: round((stand[2] - 0.5) * 100)].max() < 0.1
    assert 0.7 < np.median(speed(walker, "LASI")[rows]) < 1.7
    assert 3.0 < speed(walker, "LTOE").max() < 7.5
    assert 1.0 < speed(walker, "LFIN").max() < 6.0
    assert speed(walker, "LFHD").max() < 3.0
    assert acceleration(walker, "LFHD").max() < 30
    assert acceleration(walker, "LTOE").max() < 90


def test_activities_come_in_turn_and_fill_the_time():
    walker = person(10, duration=40.0)
    names = [name for name, _, _ in walker.bouts]
    assert names == (DAILY * 5)[: len(names)]
    assert set(names) <= set(ACTIVITIES)
    assert walker.bouts[-1][2] >= 40 > walker.bouts[-1][1]
    assert walker.recording.frames == 4000
