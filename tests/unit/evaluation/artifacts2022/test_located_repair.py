"""Repair of located samples: a known distortion, its samples located exactly, and nothing else changed."""

from dataclasses import replace

import numpy as np
import pytest

from markermend import api
from markermend.evaluation.artifacts2022 import located_repair
from markermend.options.prediction.lagged_regression import ReplicatedNetworkOptions
from markermend.prediction.lagged_regression.replicated_network import ReplicatedNetwork
from markermend.prediction.scene import Scene

FRAMES = 400


@pytest.fixture
def truth():
    time = np.arange(FRAMES) / 100
    one = np.stack([100 * np.sin(time), 50 * time, np.full(FRAMES, 1000.0)], axis=1)
    return np.stack([one, one + 80], axis=1)


@pytest.fixture
def distorted(truth):
    positions, located = truth.copy(), np.zeros(truth.shape, bool)
    located[100:130, 0, 0] = located[250, 1, 1] = True
    positions[located] += 10
    return positions, located


INTERPOLATIONS = (located_repair.linear, located_repair.spline)


@pytest.mark.parametrize(("interpolate", "error"), [(INTERPOLATIONS[0], 2.0), (INTERPOLATIONS[1], 0.05)])
def test_interpolation_removes_what_was_located(truth, distorted, interpolate, error):
    positions, located = distorted
    repaired = interpolate(positions, located)
    assert np.array_equal(repaired[~located], positions[~located])
    assert np.abs(repaired - truth).max() < error
    assert repaired[250, 1, 1] == pytest.approx(truth[250, 1, 1], abs=0.001)


def test_smoothing_removes_peaks_but_no_step(truth, distorted):
    positions, located = distorted
    repaired = located_repair.savitzky_golay(positions, located, window=101, order=13)
    assert np.array_equal(repaired[~located], positions[~located])
    assert np.abs(repaired - truth)[250, 1, 1] < 2.5
    assert np.abs(repaired - truth)[110:120, 0, 0].min() > 7  # the step is wide enough for the smoother to follow it


def test_the_nearest_sample_stands_in_at_the_ends(truth):
    located = np.zeros(truth.shape, bool)
    located[:5, 0, 1] = located[-5:, 0, 1] = True
    for interpolate in INTERPOLATIONS:
        repaired = interpolate(np.where(located, 1e4, truth), located)
        assert np.allclose(repaired[:5, 0, 1], truth[5, 0, 1]) and np.allclose(repaired[-5:, 0, 1], truth[-6, 0, 1])


def test_missing_samples_stay_missing(truth):
    located = np.zeros(truth.shape, bool)
    located[100:110, 0] = True
    positions = truth.copy()
    positions[105:120, 0] = np.nan
    repaired = located_repair.linear(positions, located)
    assert np.array_equal(np.isnan(repaired), np.isnan(positions))


def test_the_network_does_not_learn_what_was_located(walker):
    recording = replace(
        walker.recording, positions=walker.recording.positions[:, :14], markers=walker.recording.markers[:14]
    )
    located = np.zeros(recording.positions.shape, bool)
    located[200:260, 3, 1] = True
    mesh = api.infer_mesh([recording])
    network = ReplicatedNetwork(ReplicatedNetworkOptions(max_iterations=30))
    repaired = []
    for amount in (0.0, 30.0):
        distorted = recording.positions + np.where(located, amount, 0)
        scene = Scene.of(replace(recording, positions=distorted), mesh)
        repaired.append(located_repair.network(scene, located, network))
        assert np.array_equal(repaired[-1][~located], distorted[~located])
    assert np.array_equal(*repaired)
