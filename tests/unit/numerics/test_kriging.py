"""Kriging: against the dense conditional Gaussian; autocovariance: against loops; the fit: on a known process."""

import numpy as np
import pytest

from markermend.numerics.kriging import Covariance, autocovariance, fit_covariance, kernels, krige, white_noise_variance
from markermend.options.prediction.local_ridge import LocalRidgeOptions
from markermend.prediction.marker_selection import pseudo_random_subset
from support.naive import numerics as naive

SCALES = np.array(LocalRidgeOptions().correlation_times_s)


@pytest.fixture
def covariance():
    rng = np.random.default_rng(11)
    return Covariance(np.concatenate([[0.3], rng.uniform(0, 2, 2 * len(SCALES))]), SCALES)


@pytest.mark.parametrize("step", [1, 5])
def test_autocovariance_equals_loops_with_few_or_many_missing_samples(step):
    residual = np.random.default_rng(1).normal(size=(80, 3)).cumsum(axis=0)
    residual[[3, 4, 30, 77]] = np.nan
    residual[np.arange(80) % step > 0] = np.nan
    lags = np.array([0, 5, 10, 15, 60] if step > 1 else [0, 1, 2, 5, 19, 60])
    assert np.allclose(autocovariance(residual, lags), naive.autocovariance(residual, lags))


def test_a_lag_without_pairs_gets_nothing():
    residual = np.full((40, 3), np.nan)
    residual[::10] = 1.0
    found = autocovariance(residual, np.arange(12))
    assert found[0] == pytest.approx(1) and found[10] == pytest.approx(1)
    assert np.isnan(found[1:10]).all()


def test_the_fit_needs_no_adjacent_samples():
    rng = np.random.default_rng(4)
    smooth = np.convolve(rng.normal(size=40_000), np.hanning(41), mode="same")[:, None] + np.zeros(3)
    sparse = np.full_like(smooth, np.nan)
    rows = pseudo_random_subset(np.arange(len(smooth)), 2000)
    sparse[rows] = smooth[rows]
    whole = fit_covariance(smooth, rate=100.0, scales_s=SCALES, max_lag_s=2.0)
    fitted = fit_covariance(sparse, rate=100.0, scales_s=SCALES, max_lag_s=2.0)
    lags = np.array([0.01, 0.05, 0.1, 0.2])
    assert np.allclose(fitted(lags), whole(lags), atol=0.2 * whole(np.zeros(1))[0])
    assert fitted.noise < 0.1 * whole(np.zeros(1))[0]


def test_nothing_known_is_no_covariance():
    fitted = fit_covariance(np.full((50, 3), np.nan), rate=100.0, scales_s=SCALES, max_lag_s=2.0)
    assert fitted(np.zeros(1))[0] == 0 and fitted.noise < 1e-6


def test_kriging_equals_the_conditional_gaussian(covariance):
    known = np.array([0.0, 0.01, 0.04, 0.5, 0.53])
    values = np.random.default_rng(2).normal(size=(5, 3))
    wanted = np.linspace(0.05, 0.45, 9)
    mean, variance = krige(covariance, observed_s=known, values=values, target_s=wanted)
    expected, spread = naive.conditional_gaussian(covariance, known, values, wanted)
    # The jitter that keeps the system regular is a hundred-thousandth of the variance.
    assert np.allclose(mean, expected, atol=1e-3)
    assert np.allclose(variance, spread, atol=1e-3)


def test_without_noise_the_known_are_met(covariance):
    exact = Covariance(np.concatenate([[0.0], covariance.weights[1:]]), SCALES)
    known, values = np.array([0.0, 0.3]), np.array([[1.0, -2, 3], [0.5, 0, -1]])
    mean, variance = krige(exact, observed_s=known, values=values, target_s=known)
    assert np.allclose(mean, values, atol=1e-3)
    assert (variance < 1e-3).all()


def test_far_from_everything_known_the_mean_is_zero_and_the_variance_whole(covariance):
    mean, variance = krige(covariance, observed_s=np.zeros(1), values=np.ones((1, 3)), target_s=np.array([1e3]))
    assert np.allclose(mean, 0)
    assert variance[0] == pytest.approx(covariance.weights.sum())
    mean, variance = krige(covariance, observed_s=np.zeros(0), values=np.zeros((0, 3)), target_s=np.zeros(2))
    assert np.allclose(mean, 0) and np.allclose(variance, covariance.weights.sum())


def test_the_fit_finds_the_covariance_of_a_known_process():
    times = np.arange(1500) / 100.0
    truth = 4.0 * np.exp(-0.5 * ((times[:, None] - times) / 0.2) ** 2)
    noise = 0.25
    rng = np.random.default_rng(3)
    samples = np.linalg.cholesky(truth + 1e-6 * np.eye(1500)) @ rng.normal(size=(1500, 6))
    fitted = fit_covariance(
        samples + rng.normal(0, np.sqrt(noise), samples.shape), rate=100.0, scales_s=SCALES, max_lag_s=2.0
    )
    assert fitted.noise == pytest.approx(noise, abs=0.15)
    lags = np.array([0.02, 0.1, 0.2, 0.4])
    assert np.allclose(fitted(lags), 4.0 * np.exp(-0.5 * (lags / 0.2) ** 2), atol=0.8)
    assert (fitted.weights >= 0).all()


def test_kernels_are_one_at_lag_zero():
    assert np.allclose(kernels(np.zeros(3), SCALES), 1)


def test_an_exact_model_leaves_a_covariance_that_can_be_inverted():
    fitted = fit_covariance(np.zeros((200, 3)), rate=100.0, scales_s=SCALES, max_lag_s=2.0)
    mean, variance = krige(fitted, observed_s=np.array([0.0, 0.1]), values=np.zeros((2, 3)), target_s=np.array([0.05]))
    assert np.isfinite(mean).all() and np.isfinite(variance).all()


def drift(seconds=40, rate=100.0):
    """A smooth trajectory (frames, 3) of 10 mm that turns within about a second."""
    t = np.arange(0, seconds, 1 / rate)[:, None]
    return 10 * np.sin(2 * np.pi * np.array([0.3, 0.7, 1.1]) * t + np.arange(3))


def test_the_white_noise_on_a_smooth_trajectory_is_estimated():
    residual = drift() + np.random.default_rng(5).normal(0, 0.2, (4000, 3))
    residual[np.random.default_rng(6).choice(4000, 30)] += 100
    assert white_noise_variance(drift()) < 1e-3
    assert white_noise_variance(residual) == pytest.approx(0.2**2, rel=0.3)


def test_a_subset_of_frames_gives_the_noise_while_enough_lie_side_by_side():
    residual = drift() + np.random.default_rng(5).normal(0, 0.2, (4000, 3))
    sparse, sparser = np.full_like(residual, np.nan), np.full_like(residual, np.nan)
    for kept, count in ((sparse, 1000), (sparser, 100)):
        chosen = pseudo_random_subset(np.arange(4000), count)
        kept[chosen] = residual[chosen]
    assert white_noise_variance(sparse) == pytest.approx(0.2**2, rel=0.5)
    assert white_noise_variance(sparser) == 0


def test_noise_does_not_send_a_smooth_residual_astray():
    residual = drift() + np.random.default_rng(5).normal(0, 0.2, (4000, 3))
    covariance = fit_covariance(residual, rate=100.0, scales_s=SCALES, max_lag_s=2.0)
    noiseless = Covariance(np.append(0.0, covariance.weights[1:]), SCALES)
    errors = []
    for start in range(100, 3900, 100):
        wanted, known = np.arange(start, start + 40), np.r_[start - 12 : start, start + 40 : start + 52]
        for each in (covariance, noiseless):
            mean, _ = krige(each, observed_s=known / 100, values=residual[known], target_s=wanted / 100)
            errors.append(np.linalg.norm(mean - drift()[wanted], axis=1).mean())
    assert np.mean(errors[::2]) < 0.5 * np.mean(errors[1::2])
