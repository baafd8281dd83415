"""Pulses in a signal that regressors explain: against least squares with dense matrices, and what the regressors cannot hide."""

import numpy as np
import pytest

from markermend.numerics.kriging import Covariance
from markermend.numerics.matched_filter import raised_cosine
from markermend.numerics.pulse_regression import INTERCEPT_STD, JITTER, PulseRegression
from support.naive import numerics as naive

STEP_S = 0.1
COVARIANCE = Covariance(np.array([0.3, 0.0, 2.0, 1.0, 0.0]), np.array([0.1, 0.5]))


def problem(bins=60, seed=0):
    """A signal of slow regressors and coloured noise, and the local scale of the noise."""
    rng = np.random.default_rng(seed)
    lags = np.abs(np.subtract.outer(np.arange(bins), np.arange(bins))) * STEP_S
    noise = np.linalg.cholesky(COVARIANCE(lags) + COVARIANCE.noise * np.eye(bins)) @ rng.normal(size=(bins, 3))
    regressors = 20 * np.sin(np.arange(bins)[:, None] / [9, 14, 21] + rng.uniform(0, 6, 3))
    scale = 1 + 0.5 * np.sin(np.arange(bins) / 8)
    return regressors @ rng.normal(0, 0.5, (3, 3)) + scale[:, None] * noise + 7, regressors, scale


def fit(signal, regressors, scale):
    return PulseRegression.fit(
        signal, regressors, scale=scale, covariance=COVARIANCE, step_s=STEP_S, coefficient_std=1.0
    )


@pytest.mark.parametrize("missing", [(), (3, 20, 21, 22, 59)])
def test_the_estimate_is_that_of_dense_generalised_least_squares(missing):
    signal, regressors, scale = problem()
    signal[list(missing)] = np.nan
    responses = fit(signal, regressors, scale).responses(12, min_known_share=0.8)
    for place in (0, 15, 30, 48):
        shape = np.zeros(60)
        shape[place : place + 12] = raised_cosine((np.arange(12) + 0.5) / 12)
        expected = naive.pulse_height(
            signal, shape, regressors, scale, COVARIANCE, STEP_S, intercept_std=INTERCEPT_STD, jitter=JITTER
        )
        if expected is None:
            assert np.isinf(responses.deviation[place])
        else:
            np.testing.assert_allclose(responses.height[place], expected[0], rtol=1e-6, atol=1e-9)
            assert responses.deviation[place] == pytest.approx(expected[1], rel=1e-6)


def test_a_pulse_that_the_regressors_could_follow_keeps_its_height():
    signal, regressors, scale = problem(bins=120)
    place, length = 40, 40
    pulse = raised_cosine((np.arange(length) + 0.5) / length)
    changed = signal.copy()
    changed[place : place + length] += pulse[:, None] * [6, 0, 8]
    before, after = (fit(own, regressors, scale).responses(length, min_known_share=0.8) for own in (signal, changed))
    np.testing.assert_allclose((after.height - before.height)[place], [6, 0, 8], atol=0.2)
    assert after.deviation[place] == pytest.approx(before.deviation[place])


def test_nothing_known_is_nothing_estimated():
    signal, regressors, scale = problem()
    responses = fit(np.full_like(signal, np.nan), regressors, scale).responses(12, min_known_share=0.8)
    assert np.isinf(responses.deviation).all()
    assert not responses.statistic.any()
    assert len(fit(signal, regressors, scale).responses(90, min_known_share=0.8).deviation) == 0


def test_a_pulse_masks_itself_as_much_as_its_autocovariance_adds_to_the_variance():
    signal, regressors, scale = problem()
    fitted, places, length = fit(signal, regressors, scale), np.array([3, 30, 48]), 12
    pulse = raised_cosine((np.arange(length) + 0.5) / length)
    masking = fitted.masking(length, places, scale=scale)
    for place, added in zip(places, masking, strict=True):
        shape = np.zeros(60)
        shape[place : place + length] = pulse
        weights = fitted.precision @ shape / (shape @ fitted.precision @ shape)
        own, total = shape / scale[place + length // 2], 0.0
        for i in range(60):
            for j in range(60):
                lag = abs(i - j)
                total += weights[i] * weights[j] * scale[i] * scale[j] * (own[: 60 - lag] @ own[lag:]) / (3 * 60)
        assert added == pytest.approx(total, rel=1e-9)
