"""The local Gaussian process: equal to plain kernel regression, curved where the ridge is straight, kriged likewise."""

from dataclasses import replace

import numpy as np

from markermend.options.prediction.local_ridge import GaussianProcessOptions
from markermend.prediction.local_ridge.gaussian_process import InducedFeatures
from markermend.prediction.local_ridge.model import TrainingSet
from markermend.prediction.local_ridge.offsets import about_mean
from markermend.prediction.local_ridge.pooled_rows import PooledRows
from markermend.prediction.local_ridge.ridge_regression import Pooling, RidgeRegression
from support.fillings import predictor, scene
from support.naive.prediction import kernel_regression, pooled_ridge

ONE, RIDGE = np.array([True]), 0.1
EXACT = GaussianProcessOptions(inducing_points=120, min_variance=1e-9, length_scale=1.0, penalty=0.01)


def training_set(curved, rows=120, seed=5, pooled=None):
    """Training data of one input of three coordinates, of which the target uses two; weights vary."""
    rng = np.random.default_rng(seed)
    inputs = rng.normal(size=(rows, 3)) * 40
    used = inputs[:, :2]
    target = used @ np.array([[0.8, 0.1, 0.0], [0.0, 0.5, -0.4]]) + curved * used[:, :1] ** 2 / 40
    local = np.concatenate([inputs, target + rng.normal(size=(rows, 3))], axis=1)
    weights = rng.uniform(0.3, 1, rows)
    frames = np.arange(rows)
    local -= np.median(local, axis=0)
    return TrainingSet(np.arange(3), np.arange(1), np.zeros((3, 3)), np.zeros(6), local, weights, frames, pooled)


def fit(data, options, pooling=None):
    ridge = RidgeRegression.fit(data, ONE, RIDGE, pooling)
    return ridge.extended(InducedFeatures.choose(ridge, options), max_pooled_rows=200)


def test_with_all_poses_it_equals_plain_kernel_regression_also_without_a_block():
    data = training_set(1.0)
    data = replace(data, weights=np.ones(120))
    regression = fit(data, EXACT)
    scales = regression.features.kernel.scales

    def naive(kept, at):
        rows = data.local[kept]
        return kernel_regression(
            rows[:, :3],
            rows[:, 3:],
            at,
            scales=scales,
            linear=1 / (RIDGE * len(rows)),
            amplitude=1 / (0.01 * len(rows)),
        )

    at = data.local[:7, :3] + 3.0
    assert np.allclose(regression.predict(at), naive(np.ones(120, bool), at), atol=1e-3)
    block = np.arange(120) // 30
    left = regression.left_out(block)
    for b in range(4):
        rows = block == b
        assert np.allclose(left[rows], data.target[rows] - naive(~rows, data.local[rows, :3]), atol=1e-3)


def test_it_follows_a_curve_where_the_ridge_is_straight():
    data = training_set(1.0, rows=200)
    kept = np.arange(200) % 3 != 0
    trained = replace(data, local=data.local[kept], weights=data.weights[kept], training=data.training[kept])
    straight = RidgeRegression.fit(trained, ONE, RIDGE)
    curved = fit(trained, GaussianProcessOptions())
    off = [np.abs(each.predict(data.local[~kept, :3]) - data.target[~kept]).mean() for each in (straight, curved)]
    assert off[1] < 0.5 * off[0]
    far = np.array([[4000.0, 0.0, 0.0]])
    assert np.allclose(curved.features.values(far), 0, atol=1e-6)


def test_inputs_count_by_how_much_the_ridge_uses_them():
    scales = fit(training_set(0.0), GaussianProcessOptions()).features.kernel.scales
    assert scales[2] < 0.05 * scales[1] < scales[0]
    assert scales[0] > scales[1]


def test_a_still_body_needs_few_poses():
    data = training_set(0.0)
    still = replace(data, local=np.repeat(data.local[:3], 40, axis=0))
    assert len(fit(still, GaussianProcessOptions()).features.points) == 3


def test_features_of_pooled_rows_have_an_offset_for_each_recording():
    rng = np.random.default_rng(8)
    pooled, weights, recording = rng.normal(size=(80, 6)) * 40, rng.uniform(0.3, 1, 80), np.repeat([0, 1], [30, 50])
    centred = about_mean(pooled, weights, recording)
    rows = PooledRows(np.zeros((3, 3)), centred, weights, recording, pooled - centred, 80)
    data = training_set(1.0, pooled=rows)
    options = GaussianProcessOptions(inducing_points=10, penalty=RIDGE)
    regression = fit(data, options, Pooling((0.1,), 4))

    def extended(local):
        return np.concatenate([local[:, :3], regression.features.values(local[:, :3]), local[:, 3:]], axis=1)

    expected = pooled_ridge(
        extended(data.local),
        data.weights,
        extended(pooled - data.centre),
        weights,
        recording,
        ridge=RIDGE,
        pool_weight=0.1,
    )
    assert np.allclose(regression.function.coefficients, expected)


def test_poses_of_other_recordings_are_inducing_points_too():
    pooled = training_set(1.0, seed=6).local + 400.0
    rows = PooledRows(np.zeros((3, 3)), pooled, np.ones(120), np.zeros(120, int), np.zeros((120, 6)), 120)
    features = fit(training_set(1.0, pooled=rows), GaussianProcessOptions()).features
    assert 0.2 < (features.points[:, 0] > 200).mean() < 0.8


def test_the_borders_are_met_and_the_error_grows_towards_the_middle(walker):
    positions = walker.recording.positions
    found = predictor("local_gp").predict(scene(positions), 7, 500, 620)
    truth = positions[499:621, 7]
    assert np.linalg.norm(found.positions[[0, -1]] - truth[[0, -1]], axis=1).max() < 2
    assert found.error[60] > found.error[1] > 0
    assert np.linalg.norm(found.positions - truth, axis=1).mean() < 15


def test_it_shares_training_data_with_the_ridge_but_no_regression(walker):
    shared = scene(walker.recording.positions)
    ridge, process = predictor("local_ridge"), predictor("local_gp")
    straight = ridge.predict(shared, 7, 500, 620)
    curved = process.predict(shared, 7, 500, 620)
    assert not np.allclose(straight.positions, curved.positions)
    alone = process.predict(scene(walker.recording.positions), 7, 500, 620)
    assert np.array_equal(curved.positions, alone.positions)
