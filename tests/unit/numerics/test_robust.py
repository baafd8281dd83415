"""Robust scale and location."""

import numpy as np
import pytest

from markermend.numerics import robust


def test_the_deviation_is_that_of_normal_noise_whatever_the_outliers():
    values = np.random.default_rng(1).normal(3, 2, 20_000)
    values[:1000] = 1e6
    values[1000:1100] = np.nan
    assert robust.mad_std(values) == pytest.approx(2, rel=0.12)
    assert robust.mad_std(np.full(4, np.nan)) == 0


def test_the_moving_median_joins_runs_and_keeps_whole_windows_at_the_ends():
    values = np.array([1.0, 2, np.nan, np.nan, 9, 4, 5, np.nan])
    known = np.array([1.0, 2, 9, 4, 5])
    middle = [np.median(known[k : k + 3]) for k in range(3)]
    expected = [middle[0], middle[0], np.nan, np.nan, middle[1], middle[2], middle[2], np.nan]
    np.testing.assert_array_equal(robust.moving_median_across_gaps(values, 3), expected)
    assert np.isnan(robust.moving_median_across_gaps(np.full(4, np.nan), 3)).all()
