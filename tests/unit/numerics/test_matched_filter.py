"""Matched filters for pulses: against generalised least squares, moment by moment."""

import numpy as np
import pytest

from markermend.numerics import matched_filter
from markermend.numerics.kriging import Covariance
from support.naive import numerics as naive

RATE = 100.0
COVARIANCE = Covariance(np.array([0.3, 0.0, 2.0, 1.0, 0.0]), np.array([0.1, 0.5]))


def pulse_filter(length, flank=0.5, taps=24):
    return matched_filter.design_filter(COVARIANCE, length=length, flank=flank, taps=taps, rate=RATE)


def process(frames, rng):
    lags = np.abs(np.subtract.outer(np.arange(frames), np.arange(frames))) / RATE
    between = COVARIANCE(lags) + COVARIANCE.noise * np.eye(frames)
    return np.linalg.cholesky(between) @ rng.normal(size=(frames, 3))


def window_pulse(length, flank=0.5):
    """The pulse between its flanks, as the filter sees it."""
    side = np.zeros(int(np.ceil(flank * length)))
    return np.concatenate([side, matched_filter.raised_cosine((np.arange(length) + 0.5) / length), side])


@pytest.mark.parametrize("length", [12, 20])
def test_the_response_is_that_of_generalised_least_squares(length):
    signal = process(120, np.random.default_rng(1))
    found = matched_filter.filter_response(signal, pulse_filter(length))
    shape = window_pulse(length)
    window = len(shape)
    for start in (0, 33, 119 - window):
        # The centre of an even window lies between two samples.
        parts = [signal[first : first + window] for first in (start, start + 1)]
        pair = [naive.pulse_statistic(part, shape, COVARIANCE, RATE) for part in parts]
        assert found[start + window // 2] == pytest.approx(np.mean(pair), rel=1e-6)


def test_noise_has_variance_one_and_a_pulse_its_height():
    rng = np.random.default_rng(2)
    signal = np.concatenate([process(400, rng), np.full((1, 3), np.nan), process(400, rng)])
    one = pulse_filter(60)
    noise = matched_filter.filter_response(signal, one)
    assert 0.5 < np.sqrt(np.nanmean(noise**2) / 3) < 1.5
    assert np.isnan(noise[341:460]).all()  # a window does not span a gap
    clear = np.zeros((400, 3))
    clear[170:230, 1] = 10 * matched_filter.raised_cosine((np.arange(60) + 0.5) / 60)
    found = matched_filter.filter_response(clear, one)
    assert abs(int(np.nanargmax(found)) - 200) <= 2
    assert np.nanmax(found) * one.deviation == pytest.approx(10, rel=0.02)
