"""Bridges across detected samples and gaps."""

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline, CubicSpline

from markermend.numerics import interpolation


def test_a_cubic_bridge_is_the_hermite_curve_of_scipy():
    values = np.random.default_rng(1).normal(size=30).cumsum()
    detected = np.zeros(30, bool)
    detected[10:16] = True
    slopes = [(values[9] - values[6]) / 3, (values[19] - values[16]) / 3]
    expected = CubicHermiteSpline([9, 16], values[[9, 16]], slopes)(np.arange(10, 16))
    np.testing.assert_allclose(interpolation.bridge_cubic(values, detected, 3)[10:16], expected)


def test_a_cubic_bridge_follows_a_cubic_and_leaves_the_ends_open():
    t = np.arange(40) / 10
    values = 5 * t**2 - 3 * t
    detected = np.zeros(40, bool)
    detected[[*range(12, 22), 0, 1, 39]] = True
    damaged = np.where(detected, 99.0, values)
    bridged = interpolation.bridge_cubic(damaged, detected, 1)
    assert np.isnan(bridged[[0, 1, 39]]).all()
    np.testing.assert_allclose(bridged[2:39], values[2:39], atol=0.05 * 5)
    assert damaged[12] == 99


def test_brief_gaps_are_bridged_and_longer_ones_are_not():
    signal = np.arange(30.0)[:, None] * [1, 2, 3]
    gapped = signal.copy()
    gapped[5:8], gapped[12:16], gapped[28:] = np.nan, np.nan, np.nan
    out = interpolation.bridge_linear(gapped, 3)
    np.testing.assert_allclose(out[:12], signal[:12])
    assert np.isnan(out[12:16]).all() and np.isnan(out[28:]).all()


def test_missing_entries_lie_on_straight_lines_and_the_nearest_stands_in_beyond_the_ends():
    values = np.array([np.nan, 1, np.nan, np.nan, 7, np.nan])
    np.testing.assert_allclose(interpolation.interpolate_missing(values), [1, 1, 3, 5, 7, 7])
    assert np.isnan(values[0])


@pytest.mark.parametrize("knots", [2, 3, 4, 5, 60])
def test_the_spline_is_that_of_scipy(knots):
    rng = np.random.default_rng(knots)
    times, values = rng.uniform(0.5, 2, knots).cumsum(), rng.normal(size=(knots, 3))
    at = np.linspace(times[0] - 0.1, times[-1] + 0.1, 50)
    np.testing.assert_allclose(
        interpolation.cubic_spline(times, values, at), CubicSpline(times, values)(at), atol=1e-10
    )
