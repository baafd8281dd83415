"""The local Gaussian process: equal to plain kernel regression, curved where the ridge is straight, kriged likewise."""

import numpy as np
import pytest

from markermend.options.prediction.local_ridge import GaussianProcessOptions
from markermend.prediction.local_ridge.gaussian_process import train
from markermend.prediction.local_ridge.ridge import ridge_coefficients
from support.fillings import predictor, scene

OPTIONS = GaussianProcessOptions(
    max_training_frames=100, length_scales=(1.0,), variance_ratios=(10.0,), validation_blocks=4
)


def training(curved, seed=5):
    rng = np.random.default_rng(seed)
    inputs = rng.normal(size=(120, 3)) * 40
    inputs -= inputs.mean(axis=0)
    target = inputs @ rng.normal(size=(3, 3)) + curved * (inputs**2) / 40 + rng.normal(size=(120, 3))
    return inputs, target - target.mean(axis=0), rng.uniform(0.3, 1, 120)


def plain(inputs, target, weights, at, kernel):
    """Gaussian process regression, entry by entry."""

    def covariance(a, b):
        radial = kernel.amplitude * np.exp(-np.sum((a - b) ** 2) / (2 * kernel.length_mm**2))
        return 1e4 + kernel.linear * np.dot(a, b) + radial

    between = np.array([[covariance(a, b) for b in inputs] for a in inputs]) + np.diag(1 / weights)
    across = np.array([[covariance(a, b) for b in inputs] for a in at])
    return across @ np.linalg.solve(between, target)


def test_it_equals_plain_kernel_regression_also_without_a_block():
    inputs, target, weights = training(1.0)
    process = train(inputs, target, weights, ridge=0.1, options=OPTIONS)
    at = inputs[:7] + 3.0
    assert np.allclose(process.predict(at), plain(inputs, target, weights, at, process.kernel), atol=1e-5)
    block = np.arange(120) // 30
    found = process.left_out(inputs, block, block)
    for b in range(4):
        kept = block != b
        expected = plain(inputs[kept], target[kept], weights[kept], inputs[~kept], process.kernel)
        assert np.allclose(found[~kept], expected, atol=1e-4)


def test_without_the_radial_part_it_is_the_ridge():
    inputs, target, weights = training(1.0)
    options = GaussianProcessOptions(
        max_training_frames=100, length_scales=(1.0,), variance_ratios=(0.0,), validation_blocks=4
    )
    process = train(inputs, target, weights, ridge=0.1, options=options)
    beta = ridge_coefficients(inputs, target, weights, 0.1)
    at = inputs[:9] + 5.0
    expected = np.concatenate([np.ones((9, 1)), at], axis=1) @ beta
    assert np.allclose(process.predict(at), expected, atol=1e-3)


def test_it_follows_a_curve_and_chooses_what_errs_least():
    inputs, target, weights = training(1.0)
    options = GaussianProcessOptions(
        max_training_frames=100, length_scales=(0.01, 1.0), variance_ratios=(0.0, 100.0), validation_blocks=4
    )
    kept = np.arange(120) % 3 != 0
    process = train(inputs[kept], target[kept], weights[kept], ridge=0.1, options=options)
    straight = np.concatenate([np.ones((40, 1)), inputs[~kept]], axis=1) @ ridge_coefficients(
        inputs[kept], target[kept], weights[kept], 0.1
    )
    curved = process.predict(inputs[~kept])
    assert process.kernel.amplitude == 100.0
    assert np.abs(curved - target[~kept]).mean() < 0.7 * np.abs(straight - target[~kept]).mean()


def test_nothing_to_try_is_refused():
    inputs, target, weights = training(0.0)
    with pytest.raises(ValueError, match="no length scale"):
        train(inputs, target, weights, ridge=0.1, options=GaussianProcessOptions(100, (), (1.0,), 4))


def test_the_borders_are_met_and_the_error_grows_towards_the_middle(walker):
    positions = walker.recording.positions
    found = predictor("local_gp").predict(scene(positions), 7, 500, 620)
    truth = positions[499:621, 7]
    assert np.linalg.norm(found.positions[[0, -1]] - truth[[0, -1]], axis=1).max() < 2
    assert found.error[60] > found.error[1] > 0
    assert np.linalg.norm(found.positions - truth, axis=1).mean() < 15
