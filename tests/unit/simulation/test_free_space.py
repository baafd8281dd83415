"""Free stretches are found as by trying every one, and a choice falls on one of them."""

import numpy as np
import pytest

from markermend.simulation.free_space import PLACES, FreeSpace, choose


def naive_starts(taken, length, margin, *, at, ends, one_at_a_time):
    """Try every start: the stretch lies in the recording, and nothing is taken in it or within the margin."""
    frames, markers = taken.shape
    free = np.zeros((frames - length + 1, markers), bool)
    for start in range(len(free)):
        for m in range(markers):
            own = range(start - margin, start + length + margin)
            inside = [frame for frame in own if 0 <= frame < frames]
            others = taken.any(axis=1) if one_at_a_time else taken[:, m]
            allowed = ends or len(inside) == len(own)
            placed = {"anywhere": True, "start": start == 0, "stop": start == len(free) - 1}[at]
            free[start, m] = allowed and placed and not others[inside].any()
    return free


@pytest.mark.parametrize("one_at_a_time", [False, True])
@pytest.mark.parametrize("at", PLACES)
def test_starts_are_those_of_trying_every_one(at, one_at_a_time):
    rng = np.random.default_rng(3)
    for margin in (0, 2, 5):
        taken = rng.random((40, 3)) < 0.06
        for length in (1, 3, 8):
            for ends in (False, True):
                space = FreeSpace(taken.copy(), margin=margin, one_at_a_time=one_at_a_time)
                expected = naive_starts(taken, length, margin, at=at, ends=ends, one_at_a_time=one_at_a_time)
                np.testing.assert_array_equal(space.starts(length, at=at, ends=ends), expected)


def test_what_is_taken_is_free_no_more():
    space = FreeSpace(np.zeros((20, 2), bool), margin=1, one_at_a_time=False)
    space.take([1], 5, 8)
    free = space.starts(3, ends=True)
    assert free[:, 0].all() and not free[2:9, 1].any() and free[[0, 1, 9], 1].all()
    with pytest.raises(ValueError, match="do not fit"):
        space.starts(21)


def test_a_choice_falls_on_what_is_free_and_on_all_of_it():
    free = np.random.default_rng(1).random((12, 3)) < 0.3
    rng = np.random.default_rng(2)
    chosen = {choose(free, rng) for _ in range(2000)}
    assert chosen == set(map(tuple, np.argwhere(free).tolist()))
    with pytest.raises(ValueError, match="no room"):
        choose(np.zeros((3, 2), bool), rng)
