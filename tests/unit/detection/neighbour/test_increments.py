"""Sudden increments against the neighbours: in both residual and trajectory, beyond what is usual there."""

import numpy as np
import pytest

from markermend.detection.neighbour.increments import clusters, detrended_increments
from markermend.detection.noise import NoiseDetector
from markermend.prediction.scene import Scene
from support.residuals import rough
from support.signals import options_of

NOISE = options_of("noise", "default")


def test_increments_begin_anew_after_a_gap_and_have_no_trend():
    values = np.outer(np.arange(60.0) ** 2, [1, 2, 3])
    values[20:23] = np.nan
    values[40:] += 30
    increments = detrended_increments(values, 5)
    assert not increments[[0, 20, 21, 22, 23]].any()
    # The jump moves the median of five by one rank, and neighbouring increments differ by 2, 4 and 6 mm.
    np.testing.assert_allclose(increments[40], [28, 26, 24], atol=1e-9)
    for start, stop in ((0, 20), (23, 60)):
        change = np.diff(values[start:stop], axis=0)
        for k in range(2, len(change) - 2):
            expected = change[k] - np.median(change[k - 2 : k + 3], axis=0)
            np.testing.assert_allclose(increments[start + 1 + k], expected)


def measured(residual, positions):
    scene = Scene(positions, 100.0, [np.delete(np.arange(residual.shape[1]), m) for m in range(residual.shape[1])])
    detector = NoiseDetector(scene, "ABC"[: residual.shape[1]], NOISE)
    return detector, detector.measure(residual)


def test_an_increment_is_sudden_where_residual_and_trajectory_both_have_it():
    residual = np.stack([rough(300, seed) for seed in range(3)], axis=1)
    positions = residual.copy()
    residual[100:, 0] += 9  # in the residual alone
    positions[150:, 1] += 9  # in the trajectory alone
    residual[200:, 2] += [9, 0, 0]
    positions[200:, 2] += [9, 3, 0]
    _, statistics = measured(residual, positions)
    assert np.argwhere(statistics.score > 1).tolist() == [[200, 2]]
    assert statistics.size[200, 2] == pytest.approx(9, abs=0.5)


def test_where_all_samples_jitter_none_is_sudden():
    jitter = np.random.default_rng(3).normal(0, 3, (600, 3, 3))
    _, statistics = measured(jitter, jitter)
    assert not (statistics.score > 1).any()
    assert statistics.tail > 1


def test_an_update_is_a_measurement_of_some_markers_with_the_same_tail():
    residual = np.stack([rough(300, seed) for seed in range(3)], axis=1)
    detector, before = measured(residual, residual)
    changed = residual.copy()
    changed[100:] += 9
    after = detector.update(before, changed, [1])
    assert after.tail == before.tail
    assert np.array_equal(after.vector[:, [0, 2]], before.vector[:, [0, 2]])
    assert after.vector[100, 1, 0] == pytest.approx(9, abs=0.5)


def test_clusters_are_split_at_long_distances():
    assert [own.tolist() for own in clusters(np.array([1, 3, 9, 10, 30]), 5)] == [[1, 3], [9, 10], [30]]
    assert clusters(np.zeros(0, int), 5) == []
