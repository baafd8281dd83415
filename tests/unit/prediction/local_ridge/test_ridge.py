"""Ridge regression: against augmented least squares; robust weights."""

import numpy as np
import pytest

from markermend.prediction.local_ridge.ridge import ridge_coefficients, robust_weights, with_intercept


def test_the_coefficients_are_those_of_least_squares_with_penalty_rows():
    """A penalty is a row of data: the intercept has none."""
    rng = np.random.default_rng(1)
    design, target, weights = rng.normal(size=(40, 3)), rng.normal(size=(40, 2)), rng.uniform(0.2, 1, 40)
    root = np.sqrt(weights)[:, None]
    rows = np.concatenate([root * np.insert(design, 0, 1.0, axis=1), np.eye(4)[1:] * np.sqrt(0.7 * weights.sum())])
    expected = np.linalg.lstsq(rows, np.concatenate([root * target, np.zeros((3, 2))]), rcond=None)[0]
    assert np.allclose(ridge_coefficients(with_intercept(design), target, weights, 0.7), expected)


@pytest.mark.parametrize("ridge", [1, 1.0])
def test_a_whole_number_as_penalty_leaves_the_intercept_free(ridge):
    rng = np.random.default_rng(2)
    design = rng.normal(size=(50, 2))
    found = ridge_coefficients(with_intercept(design), 1e6 + design[:, :1], np.ones(50), ridge)
    shifted = ridge_coefficients(with_intercept(design), design[:, :1], np.ones(50), ridge)
    assert np.allclose(found[0] - 1e6, shifted[0]) and np.allclose(found[1:], shifted[1:])


def test_artifacts_lose_their_weight():
    rng = np.random.default_rng(8)
    inputs = rng.normal(0, 20, (300, 6))
    target = inputs @ rng.normal(size=(6, 3)) + rng.normal(0, 0.5, (300, 3))
    target[100:110] += 60
    weights = robust_weights(np.concatenate([inputs, target], axis=1), ridge=1.0, sigmas=6)
    assert weights[100:110].max() < 0.1
    assert np.delete(weights, np.s_[100:110]).min() == 1
