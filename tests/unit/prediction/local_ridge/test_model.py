"""Ridge regression in a local frame: against augmented least squares; left-out blocks: against training again."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from markermend.prediction.local_ridge.model import RidgeRegression, TrainingSet, ridge_coefficients, robust_weights
from support.fillings import rigid_body


def test_the_coefficients_are_those_of_least_squares_with_penalty_rows():
    """A penalty is a row of data: the intercept has none."""
    rng = np.random.default_rng(1)
    design, target, weights = rng.normal(size=(40, 3)), rng.normal(size=(40, 2)), rng.uniform(0.2, 1, 40)
    root = np.sqrt(weights)[:, None]
    rows = np.concatenate([root * np.insert(design, 0, 1.0, axis=1), np.eye(4)[1:] * np.sqrt(0.7 * weights.sum())])
    expected = np.linalg.lstsq(rows, np.concatenate([root * target, np.zeros((3, 2))]), rcond=None)[0]
    assert np.allclose(ridge_coefficients(design, target, weights, 0.7), expected)


@pytest.mark.parametrize("ridge", [1, 1.0])
def test_a_whole_number_as_penalty_leaves_the_intercept_free(ridge):
    rng = np.random.default_rng(2)
    design = rng.normal(size=(50, 2))
    found = ridge_coefficients(design, 1e6 + design[:, :1], np.ones(50), ridge)
    shifted = ridge_coefficients(design, design[:, :1], np.ones(50), ridge)
    assert np.allclose(found[0] - 1e6, shifted[0]) and np.allclose(found[1:], shifted[1:])


def test_residuals_left_out_equal_training_again_without_the_block():
    rng = np.random.default_rng(7)
    local = rng.normal(size=(90, 9))
    block = np.sort(rng.integers(0, 5, 90))
    weights = rng.uniform(0.2, 1, 90)
    data = TrainingSet(np.arange(3), np.arange(2), np.zeros((3, 3)), np.zeros(9), local, weights, np.arange(90))
    regression = RidgeRegression.fit(data, np.array([True, True]), 0.1)
    found = regression.left_out(block)
    for b in range(5):
        kept, rows = block != b, block == b
        beta = ridge_coefficients(local[kept, :6], local[kept, 6:], weights[kept], 0.1)
        expected = local[rows, 6:] - np.concatenate([np.ones((rows.sum(), 1)), local[rows, :6]], axis=1) @ beta
        assert np.allclose(found[rows], expected)
    assert np.isnan(regression.left_out(np.zeros(90, int))).all()


def test_artifacts_lose_their_weight():
    rng = np.random.default_rng(8)
    inputs = rng.normal(0, 20, (300, 6))
    target = inputs @ rng.normal(size=(6, 3)) + rng.normal(0, 0.5, (300, 3))
    target[100:110] += 60
    weights = robust_weights(np.concatenate([inputs, target], axis=1), ridge=1.0, sigmas=6)
    assert weights[100:110].max() < 0.1
    assert np.delete(weights, np.s_[100:110]).min() == 1


def test_inputs_are_local_coordinates_about_their_typical_place():
    body = rigid_body(frames=30, markers=5)
    template = body[0, :3] - body[0, :3].mean(axis=0)
    centre = np.arange(9.0)
    data = TrainingSet(np.arange(3), np.array([3, 4]), template, centre, np.zeros((1, 9)), np.ones(1), np.zeros(1, int))
    rows = np.array([0, 7, 20])
    found = data.inputs_at(body, np.array([False, True]), rows)
    local = body[0, 4] - body[0, :3].mean(axis=0)
    assert np.allclose(found.values, local - centre[3:6])
    for row, axes in zip(rows, found.frames.axes, strict=True):
        own = body[row, :3] - body[row, :3].mean(axis=0)
        assert np.allclose(Rotation.from_matrix(axes).apply(template), own)
