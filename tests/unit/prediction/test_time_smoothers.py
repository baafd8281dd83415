"""Smoothers as predictors: their residuals are those of the filters, marker by marker."""

import numpy as np
import pytest

from markermend.numerics import filters
from markermend.prediction.time_smoothers import MovingMedian, SavitzkyGolay
from support.fillings import scene


@pytest.fixture
def positions():
    rng = np.random.default_rng(3)
    out = rng.normal(size=(120, 3, 3)).cumsum(axis=0)
    out[40:45, 1] = np.nan
    return out


def test_the_residual_of_the_median_is_what_is_faster_than_the_window(positions):
    found = MovingMedian(window_s=0.09).residuals(scene(positions), np.array([1]))
    assert np.isnan(found[:, [0, 2]]).all()
    for axis in range(3):
        expected = positions[:, 1, axis] - filters.moving_median(positions[:, 1, axis], 9)
        np.testing.assert_array_equal(found[:, 1, axis], expected)


@pytest.mark.parametrize(("order", "window"), [(3, 9), (6, 13)])
def test_the_window_is_widened_to_what_the_order_needs(positions, order, window):
    found = SavitzkyGolay(window_s=0.09, order=order).residuals(scene(positions))
    np.testing.assert_array_equal(found[:, 0, 0], filters.high_pass(positions[:, 0, 0], window, order))
