"""Matched filters for bumps, against the textbook's generalised least squares."""

import numpy as np
import pytest

from markermend.detection.neighbour import residual_scale
from markermend.numerics import interpolation, matched_filter
from markermend.numerics.kriging import Covariance

RATE = 100.0
COVARIANCE = Covariance(np.array([0.3, 0.0, 2.0, 1.0, 0.0]), np.array([0.1, 0.5]))


def bump(length, flank=0.5, taps=24):
    return matched_filter.design_filter(COVARIANCE, length=length, flank=flank, taps=taps, rate=RATE)


def process(frames, rng):
    lags = np.abs(np.subtract.outer(np.arange(frames), np.arange(frames))) / RATE
    between = COVARIANCE(lags) + COVARIANCE.noise * np.eye(frames)
    return np.linalg.cholesky(between) @ rng.normal(size=(frames, 3))


def naive_strength(window, length, flank):
    """Height of the bump by generalised least squares with a constant, in standard deviations, over all axes."""
    side = int(np.ceil(flank * length))
    course = np.concatenate(
        [np.zeros(side), matched_filter.raised_cosine((np.arange(length) + 0.5) / length), np.zeros(side)]
    )
    lags = np.abs(np.subtract.outer(np.arange(len(course)), np.arange(len(course)))) / RATE
    smooth = COVARIANCE(lags)
    between = smooth + (COVARIANCE.noise + 1e-5 * (smooth[0, 0] + COVARIANCE.noise)) * np.eye(len(course))
    design = np.stack([course, np.ones(len(course))], axis=1)
    information = design.T @ np.linalg.solve(between, design)
    coefficients = np.linalg.solve(information, design.T @ np.linalg.solve(between, window))
    return np.linalg.norm(coefficients[0]) / np.sqrt(np.linalg.inv(information)[0, 0])


@pytest.mark.parametrize("length", [12, 20])
def test_strength_is_that_of_generalised_least_squares(length):
    signal = process(120, np.random.default_rng(1))
    found = matched_filter.filter_response(signal, bump(length))
    window = length + 2 * int(np.ceil(0.5 * length))
    for start in (0, 33, 119 - window):
        # The centre of an even window lies between two samples.
        pair = [naive_strength(signal[first : first + window], length, 0.5) for first in (start, start + 1)]
        assert found[start + window // 2] == pytest.approx(np.mean(pair), rel=1e-6)


def test_noise_has_variance_one_and_a_bump_its_height():
    rng = np.random.default_rng(2)
    signal = np.concatenate([process(400, rng), np.full((1, 3), np.nan), process(400, rng)])
    one = bump(60)
    noise = matched_filter.filter_response(signal, one)
    assert 0.5 < np.sqrt(np.nanmean(noise**2) / 3) < 1.5
    assert np.isnan(noise[341:460]).all()  # a window does not span a gap
    clear = np.zeros((400, 3))
    clear[170:230, 1] = 10 * matched_filter.raised_cosine((np.arange(60) + 0.5) / 60)
    found = matched_filter.filter_response(clear, one)
    assert abs(int(np.nanargmax(found)) - 200) <= 2
    assert np.nanmax(found) * one.deviation == pytest.approx(10, rel=0.02)


def test_brief_gaps_are_bridged_and_longer_ones_are_not():
    signal = np.arange(30.0)[:, None] * [1, 2, 3]
    holed = signal.copy()
    holed[5:8], holed[12:16], holed[28:] = np.nan, np.nan, np.nan
    out = interpolation.bridge_linear(holed, 3)
    np.testing.assert_allclose(out[:12], signal[:12])
    assert np.isnan(out[12:16]).all() and np.isnan(out[28:]).all()


def test_more_is_expected_where_the_neighbours_fit_badly_or_move_fast():
    rng = np.random.default_rng(3)
    near = [np.delete(np.arange(6), m) for m in range(6)]
    lively = np.where((np.arange(2000) // 250) % 2, 4.0, 1.0)
    size = np.abs(rng.normal(size=(2000, 6))) * lively[:, None]
    still = np.zeros((2, 2000, 6))
    moving = np.broadcast_to(100 * lively[:, None], (2, 2000, 6))
    for kinds in (still, moving):
        found = residual_scale.expected(size, near, kinds, near=5, window=50, least=0.1)
        ratio = np.median(found[lively > 1]) / np.median(found[lively == 1])
        assert 3 < ratio < 5
    broken = size.copy()
    broken[600:650, 0] += 50
    again = residual_scale.expected(broken, near, moving, near=5, window=50, least=0.1)
    assert again[625, 0] < 1.5 * residual_scale.expected(size, near, moving, near=5, window=50, least=0.1)[625, 0]


def test_motion_is_that_of_the_neighbours():
    t = np.arange(200) / RATE
    positions = np.zeros((200, 3, 3))
    positions[:, 0, 0] = 1000 * t**2
    positions[:, 1, 1] = 300 * t
    positions[50:60, 2] = np.nan
    near = [np.array([1, 2]), np.array([0, 2]), np.array([], int)]
    speed, acceleration = residual_scale.motion(positions, near, rate=RATE, near=2, smooth=5)
    assert speed[100, 0] == pytest.approx(150) and acceleration[100, 0] == pytest.approx(0, abs=1e-6)
    assert acceleration[100, 1] == pytest.approx(2000 / np.sqrt(2))
    assert not speed[:, 2].any() and np.isfinite(speed).all()
