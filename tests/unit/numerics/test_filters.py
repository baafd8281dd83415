"""Filters that never look across a gap: against naive twins and scipy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import signal as scipy_signal

from markermend.numerics import filters
from support.naive import numerics as naive
from support.signals import gappy


@given(st.integers(0, 200), st.sampled_from([1, 3, 5, 19]))
def test_moving_median_equals_its_naive_twin(seed, window):
    values = gappy(seed)
    np.testing.assert_array_equal(filters.moving_median(values, window), naive.moving_median(values, window))


def test_moving_sum_counts_nothing_beyond_a_run():
    values = np.array([1.0, 2, 3, np.nan, 4, 5])
    np.testing.assert_array_equal(filters.moving_sum(values, 3), [3, 6, 5, np.nan, 9, 9])


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


def test_second_differences_leave_white_noise_its_size_and_nothing_of_a_line():
    noise = np.random.default_rng(4).normal(0, 3, 20000)
    assert np.nanstd(filters.second_difference(noise)) == pytest.approx(3, rel=0.05)
    line = 5.0 * np.arange(10)
    line[4] = np.nan
    np.testing.assert_allclose(
        filters.second_difference(line), [np.nan, 0, 0] + [np.nan] * 3 + [0, 0, 0, np.nan], atol=1e-12
    )


def test_the_band_pass_equals_its_naive_twin_and_does_not_look_across_a_gap():
    values = np.random.default_rng(5).normal(0, 1, 260).cumsum()
    values[120:123] = np.nan
    values[240] = np.nan  # what follows is shorter than the filter
    band = filters.band_pass(values, band_hz=(6.0, 9.0), rate=100.0, half_length=20)
    np.testing.assert_allclose(band, naive.band_pass(values, (6.0, 9.0), 100.0, 20), atol=1e-9)
    assert np.isnan(band[:10]).all() and np.isnan(band[110:133]).all() and np.isnan(band[230:]).all()


def test_the_band_pass_lets_its_band_through_without_a_shift():
    t = np.arange(600) / 100
    inside, outside = np.sin(2 * np.pi * 8 * t), 100 * np.sin(2 * np.pi * 0.5 * t)
    band = filters.band_pass(inside + outside, band_hz=(6.0, 10.0), rate=100.0, half_length=40)
    assert np.nanmax(np.abs(band - inside)) < 0.3


def test_low_pass_keeps_what_is_slow_and_removes_what_is_fast():
    t = np.arange(1000) / 100
    slow, fast = np.sin(2 * np.pi * 0.5 * t), np.sin(2 * np.pi * 25 * t)
    signal = slow + fast
    signal[300:310] = np.nan
    left = filters.low_pass(signal, cutoff_hz=6, rate=100)
    assert np.array_equal(np.isnan(left), np.isnan(signal))
    assert np.abs(left - slow)[50:250].max() < 0.02
    short = np.array([1.0, 5.0, np.nan, 2.0])
    assert np.array_equal(filters.low_pass(short, cutoff_hz=6, rate=100), short, equal_nan=True)
