"""Rises and returns: against the estimate of each shape on its own."""

import numpy as np
import pytest

from markermend.numerics.kriging import Covariance
from markermend.numerics.pulse_regression import PulseRegression
from markermend.numerics.rise_regression import RiseRegression

BINS = 50


def weighed(seed=0, missing=()):
    rng = np.random.default_rng(seed)
    regressors = 20 * np.sin(np.arange(BINS)[:, None] / [9, 14, 21])
    signal = regressors @ rng.normal(0, 0.5, (3, 3)) + rng.normal(size=(BINS, 3))
    signal[list(missing)] = np.nan
    return PulseRegression.fit(
        signal,
        regressors,
        scale=1 + 0.3 * np.sin(np.arange(BINS) / 8),
        covariance=Covariance(np.array([0.3, 0.0, 2.0, 1.0, 0.0]), np.array([0.1, 0.5])),
        step_s=0.1,
        coefficient_std=1.0,
    )


@pytest.mark.parametrize("length", [1, 4, 15])
@pytest.mark.parametrize("missing", [(), (0, 7, 8, 9, 30)])
def test_every_rise_is_estimated_as_its_shape_is(length, missing):
    signal, starts, stops = weighed(missing=missing), np.array([3, 10, 20]), np.array([40, 45, BINS])
    responses = RiseRegression.of(signal).rises(length, starts, stops)
    assert responses.statistic.shape == (3, 3)
    for i, start in enumerate(starts):
        for j, stop in enumerate(stops):
            shape = np.clip((np.arange(BINS) - start + 1) / length, 0, 1) * (np.arange(BINS) < stop)
            expected = signal.estimate(shape[None])
            np.testing.assert_allclose(responses.height[i, j], expected.height[0], rtol=1e-6, atol=1e-9)
            assert responses.deviation[i, j] == pytest.approx(expected.deviation[0], rel=1e-6)


def test_nothing_is_estimated_where_nothing_is_known():
    responses = RiseRegression.of(weighed(missing=range(BINS))).rises(3, np.array([5]), np.array([20]))
    assert np.isinf(responses.deviation).all()
    assert not responses.statistic.any()
