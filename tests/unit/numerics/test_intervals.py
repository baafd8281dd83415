"""Runs of masks, and durations as numbers of samples."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from markermend.numerics.intervals import runs, samples
from support.naive import numerics as naive


@given(st.lists(st.booleans(), max_size=30))
def test_runs_equal_their_naive_twin(mask):
    assert list(runs(np.array(mask, bool))) == naive.runs(np.where(mask, 0.0, np.nan))


@pytest.mark.parametrize(
    ("seconds", "rate", "odd", "expected"),
    [(0.19, 100, True, 19), (0.13, 100, True, 13), (0.05, 50, False, 3), (0.05, 100, False, 5), (0.001, 50, False, 1)],
)
def test_samples(seconds, rate, odd, expected):
    assert samples(seconds, rate, odd=odd) == expected
