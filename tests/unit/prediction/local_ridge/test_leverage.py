"""Leverage: against its definition block by block; the growth of errors: against drawn ones."""

import numpy as np
import pytest

from markermend.prediction.local_ridge.leverage import GROWTHS, fit_leverage_scale, likeliest_growth


def naive_leverage(inputs, weights, at, ridge, mean, max_leverage):
    """Bounded relative leverage of each row in the penalised regression on the others, one row at a time."""
    gram = np.zeros((inputs.shape[1] + 1,) * 2)
    for row, weight in zip(inputs, weights, strict=True):
        full = np.concatenate([[1.0], row])
        gram += weight * np.outer(full, full) / weights.sum()
    gram += np.diag([0.0, *[ridge] * inputs.shape[1]])
    leverage = np.array([full @ np.linalg.inv(gram) @ full for full in np.insert(at, 0, 1.0, axis=1)]) / mean
    return leverage / (1 + leverage / max_leverage)


@pytest.fixture
def training():
    rng = np.random.default_rng(6)
    return rng.normal(0, 20, (90, 4)), rng.uniform(0.2, 1, 90), np.repeat([0, 1, 2], 30)


def test_factors_are_those_of_the_other_blocks(training):
    inputs, weights, block = training
    rng = np.random.default_rng(7)
    residual = rng.normal(0, 1, (90, 3)) * (1 + np.abs(inputs[:, :1]) / 10)
    scale, factor = fit_leverage_scale(inputs, weights, residual, block, ridge=5.0, max_leverage=20.0)
    assert scale.growth > 0
    full = np.insert(inputs, 0, 1.0, axis=1)
    gram = (full * weights[:, None]).T @ full / weights.sum()
    mean = np.trace(gram @ np.linalg.inv(gram + np.diag([0, 5, 5, 5, 5])))
    for number in range(3):
        rest = block != number
        expected = naive_leverage(inputs[rest], weights[rest], inputs[~rest], 5.0, mean, 20.0)
        assert np.allclose(factor[~rest], np.sqrt(1 + scale.growth * expected))
    at = rng.normal(0, 60, (7, 4))
    expected = naive_leverage(inputs, weights, at, 5.0, mean, 20.0)
    assert np.allclose(scale.factor(at), np.sqrt(1 + scale.growth * expected))


def test_growth_is_found_where_errors_grow_and_only_there():
    rng = np.random.default_rng(8)
    leverage = rng.uniform(0, 10, 20000)
    for growth in (0.1, 2.0):
        square = (1 + growth * leverage) * rng.chisquare(3, 20000)
        assert likeliest_growth(leverage, square) == pytest.approx(growth, rel=0.5)
    assert likeliest_growth(leverage, rng.chisquare(3, 20000)) <= GROWTHS[2]


def test_new_poses_widen_the_error_up_to_a_bound(training):
    inputs, weights, block = training
    residual = np.random.default_rng(9).normal(0, 1, (90, 3)) * (1 + np.linalg.norm(inputs, axis=1)[:, None])
    scale, _ = fit_leverage_scale(inputs, weights, residual, block, ridge=5.0, max_leverage=20.0)
    usual, far, farther = scale.factor(np.array([[0.0] * 4, [200.0] * 4, [20000.0] * 4]))
    assert usual < far < farther <= np.sqrt(1 + 20 * scale.growth)


def test_nothing_known_means_no_growth(training):
    inputs, weights, block = training
    scale, factor = fit_leverage_scale(inputs, weights, np.full((90, 3), np.nan), block, ridge=5.0, max_leverage=20.0)
    assert scale.growth == 0
    assert np.array_equal(factor, np.ones(90))
    alone, factor = fit_leverage_scale(
        inputs, weights, np.ones((90, 3)), np.zeros(90, int), ridge=5.0, max_leverage=20.0
    )
    assert alone.growth == 0
    assert np.isnan(factor).all()
