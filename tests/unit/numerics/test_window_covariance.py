"""WindowCovariance: the covariance of short windows is fitted whatever their size, and parts of it serve shorter ones."""

import numpy as np
import pytest

from markermend.numerics import window_covariance
from support.naive import numerics as naive

FIT = {"size": 12, "order": 2, "shrinkage": 1e-6, "max_windows": 50000}


def smoothed(frames, seed):
    """Noise of two markers, (frames, 2, 3), smoothed by a kernel whose autocovariance is known: triangular over 3."""
    noise = np.random.default_rng(seed).normal(0, 1, (frames + 2, 2, 3))
    return noise[:-2] + noise[1:-1] + noise[2:]


def truth(size):
    lag = np.abs(np.arange(size)[:, None] - np.arange(size))
    return window_covariance.WindowCovariance(np.maximum(3.0 - lag, 0), 2)


@pytest.mark.parametrize("size", [12, 8])
def test_the_precision_is_that_of_the_noise(size):
    fitted = window_covariance.fit_window_covariance(smoothed(20000, 1), **FIT).precision(size)
    expected = truth(size).precision(size)
    assert np.abs(fitted - expected).max() < 0.1 * np.abs(expected).max()
    np.testing.assert_allclose(fitted @ np.vander(np.linspace(-1, 1, size), 3), 0, atol=1e-6)
    assert fitted[size // 2, size // 2] == 1


def test_neither_the_size_of_the_noise_nor_a_burst_matters():
    residual = smoothed(20000, 2)
    plain = window_covariance.fit_window_covariance(residual, **FIT).precision(12)
    residual[:5000] *= 100
    np.testing.assert_allclose(window_covariance.fit_window_covariance(residual, **FIT).precision(12), plain, atol=0.05)
    residual[8000:8040, 0] += np.random.default_rng(3).normal(0, 1000, (40, 3))
    np.testing.assert_allclose(window_covariance.fit_window_covariance(residual, **FIT).precision(12), plain, atol=0.1)


def test_windows_with_gaps_are_left_out_and_nothing_is_changed():
    residual = smoothed(4000, 4)
    residual[::50, 1] = np.nan
    kept = residual.copy()
    fitted = window_covariance.fit_window_covariance(residual, **FIT).precision(12)
    np.testing.assert_array_equal(residual, kept)
    assert np.abs(fitted - truth(12).precision(12)).max() < 0.2 * np.abs(truth(12).precision(12)).max()


@pytest.mark.parametrize("residual", [np.full((100, 2, 3), np.nan), np.zeros((100, 2, 3)), smoothed(11, 5)])
def test_too_few_windows_mean_independent_samples(residual):
    fitted = window_covariance.fit_window_covariance(residual, **FIT).precision(12)
    np.testing.assert_allclose(fitted, window_covariance.WindowCovariance(np.eye(12), 2).precision(12), atol=1e-9)


def test_the_estimate_is_that_of_tyler_window_by_window():
    residual = smoothed(150, 6)
    residual[40:43, 1] = np.nan
    residual[100:110] *= 50
    found = window_covariance.fit_window_covariance(residual, **FIT)
    expected = naive.tyler(residual, size=12, order=2, shrinkage=1e-6, iterations=window_covariance.ITERATIONS)
    np.testing.assert_allclose(found.covariance, expected, atol=1e-9)
