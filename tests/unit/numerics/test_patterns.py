"""Missing-data patterns: groups of frames in which the same markers are observed."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from markermend.numerics.patterns import group_by_pattern, group_rows


@given(st.integers(0, 100), st.sampled_from([1, 4, 64, 130]))
def test_every_row_is_in_the_group_of_its_pattern(seed, columns):
    rng = np.random.default_rng(seed)
    rows = (rng.random((5, columns)) < 0.7)[rng.integers(0, 5, 12)]
    found = list(group_rows(rows))
    patterns = [tuple(pattern.tolist()) for pattern, _ in found]
    assert patterns == sorted(set(map(tuple, rows.tolist())))
    for pattern, members in found:
        assert members.tolist() == [n for n in range(12) if np.array_equal(rows[n], pattern)]


def test_equal_rows_are_one_group_and_no_rows_are_none():
    (pattern, members), *rest = group_rows(np.ones((5, 3), bool))
    assert pattern.all() and members.tolist() == [0, 1, 2, 3, 4] and not rest
    assert list(group_rows(np.zeros((0, 3), bool))) == []


def test_enough_markers_that_are_always_observed_make_one_group():
    observed = np.array([[True, True, False], [True, True, True]])
    (pattern, frames), *rest = group_by_pattern(observed, 2)
    assert pattern.tolist() == [True, True, False] and frames.tolist() == [0, 1] and not rest
    assert len(list(group_by_pattern(observed, 3))) == 2
