"""Median and mean over windows that shrink near gaps: sample by sample, and what they keep."""

import numpy as np
import pytest

from markermend.numerics.symmetric_smoothing import smooth_symmetrically
from support.naive.numerics import symmetric_smoothing


@pytest.mark.parametrize("window", [3, 5, 7, 9])
def test_it_equals_single_windows(window):
    values = np.random.default_rng(1).normal(size=(60, 3))
    values[[0, 13, 14, 20, 22, 40]] = np.nan
    before = values.copy()
    found = smooth_symmetrically(values, window)
    assert np.array_equal(values, before, equal_nan=True)
    assert np.allclose(found, symmetric_smoothing(values, window), equal_nan=True)


def test_a_straight_line_and_its_ends_stay():
    line = np.stack([np.arange(30.0), -2 * np.arange(30.0)], axis=1)
    assert np.allclose(smooth_symmetrically(line, 9), line)
    rough = np.random.default_rng(2).normal(size=(30, 1))
    assert np.array_equal(smooth_symmetrically(rough, 9)[[0, 1, -2, -1]], rough[[0, 1, -2, -1]])


def test_a_single_peak_goes_and_short_signals_stay():
    values = np.zeros((30, 1))
    values[15] = 100
    assert (smooth_symmetrically(values, 5) == 0).all()
    assert np.array_equal(smooth_symmetrically(values, 1), values)
    assert np.array_equal(smooth_symmetrically(values[:3], 9), values[:3])
