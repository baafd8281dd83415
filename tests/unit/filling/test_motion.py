"""The motion of neighbours: against a naive twin, and where it is unknown."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.filling.gap import Gap
from markermend.filling.motion import motion_ratio, neighbour_motion
from support.fillings import rigid_body, scene
from support.naive import filling as naive


@pytest.mark.parametrize("seed", range(4))
def test_the_motion_equals_the_naive_twin(seed):
    rng = np.random.default_rng(seed)
    positions = rigid_body(seed=seed) + rng.normal(0, 1, (300, 6, 3))
    for marker in range(6):
        positions[rng.integers(0, 300, 9), marker] = np.nan
    start = int(rng.integers(2, 250))
    gap = Gap(3, start, start + int(rng.integers(1, 40)))
    positions[gap.samples] = np.nan
    seen, length = scene(positions), int(rng.integers(1, 40))
    starts = np.arange(1, 300 - length)
    found = neighbour_motion(seen, gap, starts, length=length, neighbours=2)
    expected = [naive.neighbour_motion(seen, gap, first, length, 2) for first in starts]
    assert found == pytest.approx(np.array(expected), nan_ok=True)


def test_cubic_motion_is_none_and_an_oscillation_is_seen():
    time = np.linspace(-1, 1, 300)[:, None, None]
    positions = rigid_body() + 200 * time**3
    smooth, gap = scene(np.repeat(positions[:1], 300, axis=0) + 200 * time**3), Gap(0, 100, 120)
    assert neighbour_motion(smooth, gap, np.array([100, 200]), length=20, neighbours=4).max() < 0.1
    positions = smooth.positions.copy()
    positions[100:120] += 10 * np.sin(np.arange(20) / 3)[:, None, None]
    still, moving = neighbour_motion(scene(positions), gap, np.array([200, 100]), length=20, neighbours=4)
    assert still < 0.1 and 5 < moving < 50


def test_neighbours_that_were_filled_do_not_count():
    positions = rigid_body()
    gap, start = Gap(0, 100, 120), np.array([100])
    measured = positions.copy()
    measured[100:120, 0] = measured[100:120, 1] = np.nan
    growing = measured.copy()
    growing[100:120, 1] = positions[100:120, 1] + 50
    before = scene(measured)
    after = replace(before, positions=growing, measured=before)
    expected = neighbour_motion(before, gap, start, length=20, neighbours=4)
    assert neighbour_motion(after, gap, start, length=20, neighbours=4) == expected


@pytest.mark.parametrize("gap", [Gap(0, 0, 20), Gap(0, 1, 20), Gap(0, 280, 300), Gap(0, 150, 170)])
def test_the_motion_is_unknown_at_the_ends_and_without_neighbours(gap):
    positions = rigid_body()
    positions[150:170] = np.nan
    starts = np.array([gap.start, 50])
    assert np.isnan(neighbour_motion(scene(positions), gap, starts, length=20, neighbours=4)).all()


def test_the_ratio_of_motions_is_at_least_one_and_one_where_unknown():
    trials = np.array([3.0, 4.0, np.nan])
    assert motion_ratio(10.0, trials, min_motion_mm=0.01) == pytest.approx(10 / np.sqrt(12.5))
    assert motion_ratio(1.0, trials, min_motion_mm=0.01) == 1
    assert motion_ratio(np.nan, trials, min_motion_mm=0.01) == motion_ratio(2.0, trials[2:], min_motion_mm=0.01) == 1
    assert motion_ratio(2.0, np.zeros(3), min_motion_mm=0.01) == 200
