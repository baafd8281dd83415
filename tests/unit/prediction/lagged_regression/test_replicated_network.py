"""The replicated network: its moving average, its scaling, and its random start."""

import numpy as np

from markermend.prediction.lagged_regression.predictor import TrainingSet
from markermend.prediction.lagged_regression.replicated_network import Scaling, moving_average
from support.lagged import limb, quick, scene


def test_the_network_sees_the_average_of_what_is_seen_of_its_marker():
    trajectory = np.arange(50.0)[:, None] * [1, 2, 3]
    trajectory[20:30] = np.nan
    average = moving_average(trajectory, 6)
    for n in range(50):
        around = trajectory[max(n - 3, 0) : n + 4]
        if np.isfinite(around).any():
            assert np.allclose(average[n], np.nanmean(around, axis=0))
    assert np.isfinite(average[23:27]).all()
    assert np.all(np.diff(average[21:29, 0]) > 0)
    assert np.isnan(moving_average(np.full((5, 3), np.nan), 3)).all()


def test_the_beginning_is_random_by_seed_and_the_same_again():
    positions = limb(frames=300)
    first, again, other = (quick("replicated_network", seed=seed).residuals(scene(positions)) for seed in (1, 1, 2))
    assert np.array_equal(first, again)
    assert not np.allclose(first, other)


def test_features_are_coordinates_powers_and_the_average_from_minus_one_to_one():
    rng = np.random.default_rng(5)
    rows = rng.normal(50, 20, (200, 9))
    rows[:, 2] = 7.0
    training = TrainingSet(rows, rng.normal(10, [3, 6, 1], (200, 3)), np.arange(200), 0)
    scaling = Scaling.of(training, 2)
    features, targets = scaling.data(training, np.ones(200, bool))
    assert features.shape == (200, scaling.width) == (200, 2 * 6 + 3)
    varying = np.delete(features, [2, 8], axis=1)
    assert (
        np.allclose(varying.min(axis=0), -1) and np.allclose(varying.max(axis=0), 1) and not features[:, [2, 8]].any()
    )
    assert np.allclose(targets.min(axis=0), -1) and np.allclose(targets.max(axis=0), 1)
    ranges = np.ptp(training.target, axis=0)
    assert np.allclose(scaling.units, ranges / ranges.max())
