"""Ridge regression with pooled rows: against least squares with offsets; left-out blocks: against training again."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.prediction.local_ridge.model import TrainingSet
from markermend.prediction.local_ridge.offsets import Offsets, about_mean
from markermend.prediction.local_ridge.pooled_rows import PooledRows
from markermend.prediction.local_ridge.ridge import ridge_coefficients, with_intercept
from markermend.prediction.local_ridge.ridge_regression import Pooling, RidgeRegression
from support.naive.prediction import pooled_ridge

BOTH = np.array([True, True])


def training_set(local, weights, pooled=None):
    """Training data of two inputs at successive frames."""
    frames = np.arange(len(local))
    return TrainingSet(np.arange(3), np.arange(2), np.zeros((3, 3)), np.zeros(9), local, weights, frames, pooled)


def pooled_rows(local, weights, recording):
    centred = about_mean(local, weights, recording)
    return PooledRows(np.zeros((3, 3)), centred, weights, recording, local - centred, len(local))


def one_law(rng, rows, spread, noise=0.3, law=None):
    """Inputs of some spread, and a target that depends on them."""
    law = np.random.default_rng(5).normal(0, 0.5, (6, 3)) if law is None else law
    inputs = rng.normal(0, spread, (rows, 6))
    return np.concatenate([inputs, inputs @ law + rng.normal(0, noise, (rows, 3))], axis=1)


def test_residuals_left_out_equal_training_again_without_the_block():
    rng = np.random.default_rng(7)
    local = rng.normal(size=(90, 9))
    block = np.sort(rng.integers(0, 5, 90))
    weights = rng.uniform(0.2, 1, 90)
    regression = RidgeRegression.fit(training_set(local, weights), BOTH, 0.1)
    found = regression.left_out(block)
    for b in range(5):
        kept, rows = block != b, block == b
        beta = ridge_coefficients(with_intercept(local[kept, :6]), local[kept, 6:], weights[kept], 0.1)
        expected = local[rows, 6:] - np.concatenate([np.ones((rows.sum(), 1)), local[rows, :6]], axis=1) @ beta
        assert np.allclose(found[rows], expected)
        rest = regression.without(np.flatnonzero(rows))
        assert np.allclose(local[rows, 6:] - rest.predict(local[rows, :6]), expected)
    assert np.isnan(regression.left_out(np.zeros(90, int))).all()


@pytest.mark.parametrize("used", [BOTH, np.array([False, True])])
def test_pooled_rows_have_an_offset_for_each_recording(used):
    rng = np.random.default_rng(8)
    own, pooled = rng.normal(size=(60, 9)), rng.normal(size=(80, 9)) + np.repeat([[5.0], [-3.0]], [30, 50], axis=0)
    weights, recording = rng.uniform(0.2, 1, 140), np.repeat([0, 1], [30, 50])
    data = training_set(own, weights[:60], pooled_rows(pooled, weights[60:], recording))
    columns = [*np.flatnonzero(np.repeat(used, 3)), 6, 7, 8]

    def naive(kept):
        return pooled_ridge(
            own[np.ix_(kept, columns)],
            weights[:60][kept],
            pooled[:, columns],
            weights[60:],
            recording,
            ridge=0.2,
            pool_weight=0.7,
        )

    regression = RidgeRegression.fit(data, used, 0.2, Pooling((0.7,), 4))
    assert np.allclose(regression.function.coefficients, naive(np.ones(60, bool)))
    block = np.repeat([0, 1, 2], 20)
    left = regression.left_out(block)
    for b in range(3):
        beta, rows = naive(block != b), own[block == b]
        assert np.allclose(regression.without(np.flatnonzero(block == b)).coefficients, beta)
        assert np.allclose(left[block == b], rows[:, 6:] - beta[0] - rows[:, columns[:-3]] @ beta[1:])


def test_the_weight_of_pooled_rows_has_the_least_error_on_stretches_left_out():
    rng = np.random.default_rng(9)
    data = training_set(
        one_law(rng, 120, 5.0),
        rng.uniform(0.5, 1, 120),
        pooled_rows(one_law(rng, 90, 8.0), np.ones(90), np.zeros(90, int)),
    )
    pooling, block = Pooling((0.0, 0.1, 0.3, 0.7), 6), np.repeat(np.arange(6), 20)
    errors = {}
    for weight in pooling.weights:
        left = RidgeRegression.fit(data, BOTH, 1.0, Pooling((weight,), 6)).left_out(block)
        errors[weight] = (data.weights[:, None] * left**2).sum()
    assert RidgeRegression.fit(data, BOTH, 1.0, pooling).pool_weight == min(errors, key=errors.__getitem__)


def test_pooled_rows_of_the_same_law_help_and_others_are_left_out():
    """Own poses hardly vary: only the pool shows what happens in the others."""
    rng = np.random.default_rng(10)
    own, ones = one_law(rng, 100, 0.3), np.ones(200)
    poses = rng.normal(0, 20, (50, 6))
    truth = one_law(np.random.default_rng(0), 1, 0.0, 0.0)[:, 6:] + poses @ np.random.default_rng(5).normal(
        0, 0.5, (6, 3)
    )
    pooling, errors = Pooling((0.0, 0.3, 2.0), 5), {}
    same, other = one_law(rng, 200, 20.0), one_law(rng, 200, 20.0, law=rng.normal(0, 3.0, (6, 3)))
    for name, pool in (("none", None), ("same", same), ("other", other)):
        rows = None if pool is None else pooled_rows(pool, ones, np.zeros(200, int))
        regression = RidgeRegression.fit(training_set(own, ones[:100], rows), BOTH, 0.1, pooling)
        errors[name] = np.linalg.norm(regression.predict(poses) - truth, axis=1).mean()
    assert errors["same"] < 0.1 * errors["none"]
    assert errors["other"] == pytest.approx(errors["none"])


def test_without_pooling_the_pool_does_not_count():
    rng = np.random.default_rng(11)
    own, pooled = rng.normal(size=(60, 9)), pooled_rows(rng.normal(size=(80, 9)), np.ones(80), np.zeros(80, int))
    alone, ignoring = (
        RidgeRegression.fit(training_set(own, np.ones(60), rows), BOTH, 0.2).function.coefficients
        for rows in (None, pooled)
    )
    assert np.array_equal(alone, ignoring)


def test_a_pooled_row_counts_no_more_than_a_frame_and_not_nothing_where_frames_are_few():
    rng = np.random.default_rng(12)
    own, pooled = rng.normal(size=(100, 9)), pooled_rows(rng.normal(size=(40, 9)), np.ones(40), np.zeros(40, int))
    data = training_set(own, np.ones(100), pooled)
    assert Pooling((0.0, 0.1, 0.3, 1.0), 4).candidates(data) == [0.0, 0.1, 0.3]
    assert Pooling((0.0, 0.1, 0.3, 1.0), 4, min_frames=101).candidates(data) == [0.1, 0.3]
    assert Pooling((0.0, 1.0), 4, min_frames=101).candidates(data) == [0.4]
    assert Pooling((1.0,), 4).candidates(data) == [0.0]


def naive_offsets(rows, weights, group, share):
    """Rows about a share of the weighted mean of their group, group by group."""
    about = rows.copy()
    for number in np.unique(group):
        own = group == number
        about[own] -= share * (weights[own, None] * rows[own]).sum(axis=0) / weights[own].sum()
    return about


def naive_fit(local, weights, group, share, ridge):
    """Intercept and coefficients of a ridge regression on rows with intercept about a share of the means of their groups."""
    rows = naive_offsets(np.insert(local, 0, 1.0, axis=1), weights, group, share)
    columns, target, penalty = rows[:, :-3], rows[:, -3:], np.diag([0.0, *[ridge] * (local.shape[1] - 3)])
    gram = (columns * weights[:, None]).T @ columns + penalty * weights.sum()
    return np.linalg.solve(gram, (columns * weights[:, None]).T @ target)


def test_stretches_with_offsets_equal_the_naive_twin_also_without_some_rows():
    rng = np.random.default_rng(13)
    local, weights = (
        rng.normal(size=(120, 9)) + np.repeat(rng.normal(0, 5, (4, 9)), 30, axis=0),
        rng.uniform(0.2, 1, 120),
    )
    frames = np.sort(rng.choice(400, 120, replace=False))
    data = replace(training_set(local, weights), training=frames)
    offsets = Offsets.of_stretches(frames, length=70, share=0.8)
    group = (frames - frames[0]) // 70
    assert np.array_equal(offsets.group, group) and offsets.groups == group[-1] + 1
    regression = RidgeRegression.fit(data, BOTH, 0.1, offsets=offsets)
    assert np.allclose(regression.function.coefficients, naive_fit(local, weights, group, 0.8, 0.1))
    block = frames * 3 // 400
    left = regression.left_out(block)
    for b in range(3):
        kept, rows = block != b, np.flatnonzero(block == b)
        beta = naive_fit(local[kept], weights[kept], group[kept], 0.8, 0.1)
        assert np.allclose(regression.without(rows).coefficients, beta)
        assert np.allclose(left[rows], local[rows, 6:] - beta[0] - local[rows, :6] @ beta[1:])


def test_offsets_of_stretches_keep_a_slow_shift_out_of_the_coefficients():
    """The marker shifts by 10 mm from stretch to stretch, while the pose drifts by chance in the same direction."""
    rng = np.random.default_rng(14)
    group = np.repeat(np.arange(6), 50)
    local = one_law(rng, 300, 1.0, 0.1)
    local[:, :6] += 3.0 * (group[:, None] - 2.5)
    law = np.random.default_rng(5).normal(0, 0.5, (6, 3))
    local[:, 6:] += 3.0 * (group[:, None] - 2.5) * law.sum(axis=0) + 10.0 * (group[:, None] - 2.5)
    data = training_set(local, np.ones(300))
    errors = []
    for offsets in (None, Offsets(group, 0.95)):
        coefficients = RidgeRegression.fit(data, BOTH, 0.01, offsets=offsets).function.coefficients[1:]
        errors.append(np.abs(coefficients - law).mean())
    assert errors[1] < 0.3 * errors[0]
