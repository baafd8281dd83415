"""Lagged regressions: the inputs of a marker, their rows, and what each can and cannot learn."""

import numpy as np
import pytest

from markermend.prediction.interface import Trainable
from markermend.prediction.lagged_regression.replicated_network import ReplicatedNetwork
from markermend.prediction.scene import Scene
from markermend.repair.methods import METHODS, predicted
from support.lagged import limb, quick, scene

BOTH = ["polynomial", "replicated_network"]


@pytest.mark.parametrize(("name", "within"), [("polynomial", 0.01), ("replicated_network", 6.0)])
def test_a_polynomial_relation_is_learned(name, within):
    positions = limb()
    residual = quick(name).residuals(scene(positions), np.array([0]))
    assert np.sqrt(np.mean(residual[:, 0] ** 2)) < within
    assert np.isnan(residual[:, 1:]).all()
    assert np.ptp(positions[:, 0], axis=0).min() > 100


@pytest.mark.parametrize("name", BOTH)
def test_siblings_and_parent_are_the_inputs_and_nearest_stand_in_for_them(name):
    positions = limb()
    named = scene(positions, segment_mates=[np.array([4, 2])] * 6)
    assert quick(name)._usual_inputs(named, 0).tolist() == [2, 4]
    assert quick(name, neighbours=3)._usual_inputs(scene(positions), 0).tolist() == [1, 2, 3]
    positions[200:, 4] = np.nan
    assert quick(name)._usual_inputs(scene(positions, segment_mates=[np.array([4, 2])] * 6), 0).tolist() == [1, 2]


def test_rows_hold_now_and_before_and_what_was_not_seen_before_is_as_now():
    positions = np.arange(60.0).reshape(10, 2, 3)
    positions[3] = np.nan
    seen = scene(positions, rate=200.0)
    rows = quick("polynomial", lags=2, lag_interval_s=0.01).rows(seen, 0, np.array([1]), np.array([0, 5, 6, 7]))
    now, before, earlier = rows[:, :3], rows[:, 3:6], rows[:, 6:]
    assert np.array_equal(now, positions[[0, 5, 6, 7], 1])
    assert np.array_equal(before, positions[[0, 5, 4, 5], 1])  # two frames are 0.01 s; frame 3 is missing
    assert np.array_equal(earlier, positions[[0, 1, 2, 5], 1])


@pytest.mark.parametrize("name", BOTH)
def test_many_markers_at_once_are_as_each_alone(name):
    positions = limb(frames=400)
    positions[100:150, 3] = np.nan
    together = quick(name).residuals(scene(positions))
    for marker in (0, 3, 5):
        alone = quick(name).residuals(scene(positions), np.array([marker]))
        assert np.allclose(alone[:, marker], together[:, marker], atol=1e-6, equal_nan=True)
    missing = np.isnan(positions[:, 3, 0])
    assert np.isnan(together[missing]).all()


def test_a_network_that_was_trained_is_not_trained_again(monkeypatch):
    network, seen, trained = quick("replicated_network"), scene(limb(frames=400)), []
    assert isinstance(network, Trainable)
    fit = ReplicatedNetwork.fit

    def counted(self, tasks):
        trained.append(len(tasks))
        return fit(self, tasks)

    monkeypatch.setattr(ReplicatedNetwork, "fit", counted)
    network.train([(seen, marker) for marker in range(4)])
    network.train([(seen, marker) for marker in range(5)])
    network.residuals(seen)
    assert trained == [4, 1, 1]


@pytest.mark.parametrize("name", BOTH)
def test_measured_samples_are_learned_from_where_there_are_enough(name):
    positions = limb(frames=600)
    gapped, filled = positions.copy(), positions.copy()
    gapped[100:300, 1] = np.nan
    filled[100:300, 1] += 500.0
    others = [np.arange(2, 6)] * 6
    measured = Scene(gapped, 100.0, others, segment_mates=others)
    both = Scene(filled, 100.0, others, measured=measured, segment_mates=others)
    method = quick(name)
    assert np.allclose(method._training_set(both, 1, np.array([2, 3])).target, positions[np.r_[0:100, 300:600], 1])
    assert np.isfinite(method.predict(both, 1, 150, 160).positions).all()


@pytest.mark.parametrize("name", BOTH)
def test_a_repair_may_name_it_and_learns_its_error_from_trials(name):
    positions = limb(frames=800)
    damaged = positions.copy()
    damaged[400:440, 2] = np.nan
    proposal = predicted(quick(name), scene(damaged), 2, 400, 440, trials=1)
    off = np.sqrt(np.mean((proposal.positions - positions[400:440, 2]) ** 2))
    assert proposal.method == name and name in METHODS
    assert off < 30  # of a swing of 400
    assert off / 5 < proposal.error[0] < 5 * off
