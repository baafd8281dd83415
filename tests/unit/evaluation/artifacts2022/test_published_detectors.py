"""The published detectors with a network that learned the clean recording, or learns the contaminated one."""

from dataclasses import replace

import numpy as np
import pytest

from markermend import api
from markermend.evaluation.artifacts2022 import readings
from markermend.evaluation.artifacts2022.network_file import write_networks
from markermend.evaluation.artifacts2022.options import Artifacts2022Options
from markermend.evaluation.artifacts2022.published_detectors import (
    PublishedDetectors,
    claimed,
    learn,
    network_of,
    read_detectors,
)
from markermend.prediction.lagged_regression.replicated_network import ReplicatedNetwork
from markermend.prediction.scene import Scene

OPTIONS = readings.published_options({}, network_steps=40)


@pytest.fixture(scope="module")
def clean(walker):
    recording = walker.recording
    return replace(recording, positions=recording.positions[:, :10], markers=recording.markers[:10])


@pytest.fixture(scope="module")
def risen(clean):
    positions = clean.positions.copy()
    positions[100:400, 4, 1] += 80 * np.sin(np.linspace(0, np.pi, 300))
    return replace(clean, positions=positions)


def test_a_network_that_learned_the_clean_recording_leaves_most_of_an_artifact(clean, risen):
    mesh = api.infer_mesh([clean])
    known = learn(clean, OPTIONS)
    rise = known.residuals(Scene.of(risen, mesh))[150:350, 4, 1] - known.residuals(Scene.of(clean, mesh))[150:350, 4, 1]
    # What is missing is followed through the average over two seconds, which is an input.
    assert np.allclose(rise, (risen.positions - clean.positions)[150:350, 4, 1], rtol=0.5)


def test_the_network_is_trained_once_for_all_copies(clean, risen, monkeypatch):
    trained = []
    fit = ReplicatedNetwork.fit
    monkeypatch.setattr(ReplicatedNetwork, "fit", lambda self, sets: trained.append(len(sets)) or fit(self, sets))
    detectors = PublishedDetectors(OPTIONS, learn(clean, OPTIONS))
    mesh = api.infer_mesh([clean])
    first, again = (detectors.find(risen, mesh) for _ in range(2))
    assert first == again and list(first) == ["peaks", "noise", "steps", "slow"] and trained == [10]


def test_without_slow_changes_nothing_is_predicted(clean, risen):
    found = PublishedDetectors(OPTIONS, None).find(risen, api.infer_mesh([clean]), ["peaks", "noise"])
    assert list(found) == ["peaks", "noise"]


def test_learning_the_contaminated_recording_is_what_the_preset_does(clean, risen):
    mesh = api.infer_mesh([risen])
    found = PublishedDetectors(OPTIONS, network_of(OPTIONS)).find(risen, mesh)
    assert found == api.detect(risen, mesh, OPTIONS)
    assert claimed(found, risen).shape == risen.positions.shape


def test_networks_predict_the_same_after_they_were_written(clean, risen, tmp_path):
    options = Artifacts2022Options(network_steps=5, training_frames=200)
    trained = learn(clean, readings.published_options({}, network_steps=5, training_frames=200))
    path = tmp_path / "networks.json"
    write_networks(path, trained)
    read = read_detectors(options, path)
    scene = Scene.of(risen, api.infer_mesh([clean]))
    assert np.array_equal(read.network.residuals(scene), trained.residuals(scene))
    assert read.options.slow.paper.replicated_network_changes == {"max_iterations": 5, "max_training_frames": 200}
    other = read_detectors(replace(options, trained_on="contaminated"), path).network
    assert not np.array_equal(other.residuals(scene), trained.residuals(scene))
