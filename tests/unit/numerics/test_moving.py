"""Moving reductions: against scipy's filters and against windows taken one by one."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.lib.stride_tricks import sliding_window_view
from scipy import ndimage

from markermend.numerics import moving

VALUES = np.random.default_rng(3).normal(0, 1, (40, 2, 3))


@given(st.integers(1, 40), st.sampled_from([np.add, np.minimum, np.maximum]))
def test_all_windows_are_reduced(window, operate):
    expected = operate.reduce(sliding_window_view(VALUES, window, axis=0), axis=-1)
    np.testing.assert_allclose(moving.reduce_windows(VALUES, window, operate=operate), expected, atol=1e-13)


@pytest.mark.parametrize("window", [1, 2, 5, 8, 17])
def test_means_and_minima_are_those_of_scipy(window):
    mean = ndimage.uniform_filter1d(VALUES, window, axis=0)
    np.testing.assert_allclose(moving.mean(VALUES, window), mean, atol=1e-13)
    nearest = ndimage.uniform_filter1d(VALUES, window, axis=0, mode="nearest")
    np.testing.assert_allclose(moving.mean(VALUES, window, mode="edge"), nearest, atol=1e-13)
    np.testing.assert_array_equal(moving.minimum(VALUES, window), ndimage.minimum_filter1d(VALUES, window, axis=0))


@pytest.mark.parametrize("window", [1, 3, 7, moving.LONGEST_SORTED, moving.LONGEST_SORTED + 2])
def test_medians_are_those_of_scipy(window):
    expected = ndimage.median_filter(VALUES, (window, 1, 1), mode="reflect")
    np.testing.assert_array_equal(moving.median(VALUES, window), expected)


def test_the_mean_of_squares_is_not_negative_after_a_huge_one():
    squares = np.zeros((100, 1))
    squares[10], squares[60:] = 1e16, 1e-8
    assert moving.mean(squares, 9)[70, 0] == pytest.approx(1e-8)
