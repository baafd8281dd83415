"""The detectors' building blocks, against plain twins and scipy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import signal as scipy_signal

from markermend.detection.neighbour import residual_scale
from markermend.detection.published import increments
from markermend.numerics import filters, interpolation, intervals, morphology, robust
from support import naive


def gappy(seed, frames=80):
    rng = np.random.default_rng(seed)
    values = rng.normal(0, 1, frames).round(1)
    values[rng.random(frames) < 0.15] = np.nan
    return values


@pytest.mark.parametrize(
    ("seconds", "rate", "odd", "expected"),
    [(0.19, 100, True, 19), (0.13, 100, True, 13), (0.05, 50, False, 3), (0.05, 100, False, 5), (0.001, 50, False, 1)],
)
def test_samples(seconds, rate, odd, expected):
    assert intervals.samples(seconds, rate, odd=odd) == expected


def test_deviation_is_that_of_normal_noise_whatever_the_outliers():
    values = np.random.default_rng(1).normal(3, 2, 20_000)
    values[:1000] = 1e6
    values[1000:1100] = np.nan
    assert robust.mad_std(values) == pytest.approx(2, rel=0.12)
    assert robust.mad_std(np.full(4, np.nan)) == 0


@given(st.integers(0, 200), st.sampled_from([1, 3, 7, 13]))
def test_morphology_equals_its_naive_twin(seed, size):
    values = gappy(seed)
    eroded = naive.under_element(values, size, np.min)
    dilated = naive.under_element(values, size, np.max)
    np.testing.assert_array_equal(morphology.erosion(values, size), eroded)
    np.testing.assert_array_equal(morphology.dilation(values, size), dilated)
    opened = naive.under_element(eroded, size, np.max)
    np.testing.assert_array_equal(morphology.opening(values, size), opened)
    np.testing.assert_array_equal(morphology.closing(values, size), naive.under_element(dilated, size, np.min))
    np.testing.assert_array_equal(morphology.top_hat(values, size), values - opened)
    seen = ~np.isnan(values)
    assert (morphology.top_hat(values, size)[seen] >= 0).all()
    assert (morphology.closing(values, size)[seen] >= values[seen]).all()


@given(st.integers(0, 200), st.sampled_from([1, 3, 5, 19]))
def test_moving_median_equals_its_naive_twin(seed, window):
    values = gappy(seed)
    np.testing.assert_array_equal(filters.moving_median(values, window), naive.moving_median(values, window))


@given(st.integers(0, 200), st.sampled_from([(1, 20), (3, 10), (6, 60)]), st.sampled_from([0.3, 0.5, 1.0]))
def test_derivative_pairs_equal_their_naive_twin(seed, lengths, ratio):
    change = gappy(seed)
    at = np.flatnonzero(np.abs(change) > 1)
    pairs, alone = increments.derivative_pairs(change, at, shortest=lengths[0], longest=lengths[1], ratio=ratio)
    expected = naive.derivative_pairs(change, at.tolist(), *lengths, ratio)
    assert (pairs, alone.tolist()) == expected


def test_high_pass_is_the_rest_of_scipys_savitzky_golay_filter():
    values = np.random.default_rng(2).normal(0, 1, 60)
    smooth = scipy_signal.savgol_filter(values, 13, 5, mode="interp")
    np.testing.assert_allclose(filters.high_pass(values, 13, 5), values - smooth, atol=1e-10)


def test_high_pass_lets_no_quintic_through_and_does_not_look_across_a_gap():
    t = np.linspace(-1, 1, 70)
    values = 3 * t**5 - 40 * t**4 + t
    values[30:33] = np.nan
    values[33:] += 100
    values[60:62] = np.nan
    rest = filters.high_pass(values, 13, 5)
    assert np.array_equal(np.isnan(rest), np.isnan(values))
    assert np.nanmax(np.abs(rest)) < 1e-8
    with pytest.raises(ValueError, match="window 12"):
        filters.high_pass(values, 12, 5)


def test_differences_begin_anew_after_a_gap():
    values = np.array([1.0, 3.0, np.nan, 50.0, 49.0])
    np.testing.assert_array_equal(filters.difference(values), [0, 2, np.nan, 0, -1])


def test_threshold_is_the_larger_of_scale_and_floor():
    values = np.random.default_rng(3).normal(0, 1, 5000)
    assert increments.threshold(values, scale="mad", sigmas=5, floor_mm=1.5) == pytest.approx(5, rel=0.05)
    assert increments.threshold(values, scale="std", sigmas=1, floor_mm=1.5) == 1.5
    with pytest.raises(ValueError, match="neither"):
        increments.threshold(values, scale="iqr", sigmas=5, floor_mm=1)


def test_edges_leave_out_side_lobes():
    change = np.zeros(60)
    change[[20, 19, 21]] = 7, -2.5, -2.4
    change[40] = 5
    assert increments.edges(change, 2.0, 6).tolist() == [20, 40]


def test_bridge_follows_a_cubic_and_leaves_the_ends_open():
    t = np.arange(40) / 10
    values = 5 * t**2 - 3 * t
    detected = np.zeros(40, bool)
    detected[[*range(12, 22), 0, 1, 39]] = True
    damaged = np.where(detected, 99.0, values)
    bridged = interpolation.bridge_cubic(damaged, detected, 1)
    assert np.isnan(bridged[[0, 1, 39]]).all()
    np.testing.assert_allclose(bridged[2:39], values[2:39], atol=0.05 * 5)
    assert damaged[12] == 99


def test_usual_size_follows_the_marker_no_further_than_its_neighbours():
    size = np.ones((300, 3))
    size[100:200, 0] = 50
    size[100:200, 2] = 4
    near = [np.array([1, 2]), np.array([2]), np.array([1])]
    usual = residual_scale.usual_size(size, near, window=21, near=2, ratio=3)
    assert usual[50].tolist() == [1, 1, 1]
    assert usual[150].tolist() == [7.5, 1, 3]
