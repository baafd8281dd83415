"""Networks: what they are fed, what they learn, that none depends on its batch, and that torch is asked for in words."""

import json
import shlex
import subprocess
import sys
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from markermend.options.filling import FillOptions
from markermend.options.flags import write_flags
from markermend.planning import config as planning_config
from markermend.planning.recordings import BadDataSet
from markermend.prediction.interface import Trainable
from markermend.prediction.neural_network import predictor
from markermend.prediction.neural_network.predictor import KINDS, Network
from markermend.prediction.registry import members
from markermend.prediction.scene import Scene
from markermend.storage import change_file, mesh_file, stage_files
from support.fillings import fill_options, neighbours, predictor_options, restored
from support.paths import PROJECT
from support.treated import weights

OPTIONS = predictor_options().neural_networks


def network(name="network_linear", **changed):
    return Network(name, replace(OPTIONS, **changed))


@pytest.fixture(scope="module")
def person(walker):
    """Four seconds of the walker's first twelve markers."""
    return walker.recording.positions[:400, :12]


def hidden(positions, *gaps):
    gapped = positions.copy()
    for marker, start, stop in gaps:
        gapped[start:stop, marker] = np.nan
    return Scene(gapped, 100.0, neighbours(positions))


@pytest.mark.parametrize("name", KINDS)
def test_networks_trained_at_once_are_those_trained_one_by_one(name, person):
    """Of markers with unlike inputs and unlike gaps, in two scenes: equal bytes."""
    first = hidden(person, (3, 100, 140), (7, 200, 230), (5, 40, 60))
    second = hidden(person[:300, :4], (1, 100, 120))
    jobs = [(first, 3), (first, 7), (first, 5), (second, 1)]
    gaps = [(first, 3, 100, 140), (first, 7, 200, 230), (first, 5, 40, 60), (second, 1, 100, 120)]
    together, single = network(name), network(name)
    assert isinstance(together, Trainable)
    together.train(jobs)
    for place, marker, start, stop in gaps:
        fresh = Scene(place.positions, 100.0, place.neighbours)
        alone = single.predict(fresh, marker, start, stop).positions
        assert np.isfinite(alone).all()
        assert np.array_equal(together.predict(place, marker, start, stop).positions, alone)


def test_nothing_is_trained_twice(person, monkeypatch):
    from markermend.prediction.neural_network import training

    counts = []
    train = training.train
    monkeypatch.setattr(training, "train", lambda *all_: counts.append(len(all_[1])) or train(*all_))
    seen = hidden(person, (3, 100, 140), (3, 300, 310), (7, 200, 230))
    one = network()
    one.train([(seen, 3), (seen, 7), (seen, 3)])
    one.predict(seen, 3, 100, 140)
    one.predict(seen, 3, 300, 310)
    one.predict(seen, 7, 200, 230)
    one.train([(seen, 3)])
    assert counts == [2]


@pytest.mark.parametrize("name", KINDS)
def test_a_marker_that_its_neighbours_determine_is_learned(name, walker):
    truth = walker.recording.positions[:600]
    seen = hidden(truth, (9, 300, 350))
    found = network(name, epochs=60, recurrent_units=12, learning_rate=0.05).predict(seen, 9, 300, 350).positions
    away = np.linalg.norm(found - truth[299:351, 9], axis=1).mean()
    spread = np.linalg.norm(truth[:, 9] - truth[:, 9].mean(axis=0), axis=1).mean()
    assert away < 0.3 * spread


def test_a_linear_map_is_learned_exactly():
    rng = np.random.default_rng(4)
    trajectories = rng.standard_normal((500, 4, 3)) * 100
    trajectories[:, 3] = trajectories[:, 0] * 0.5 - trajectories[:, 1] * 0.2 + trajectories[:, 2][:, ::-1] * 0.3 + 40
    seen = hidden(trajectories, (3, 200, 210))
    one = network(epochs=600, centred=False, min_joint_share=0.0, learning_rate_factor=1.0)
    found = one.predict(seen, 3, 200, 210).positions[1:-1]
    assert np.abs(found - trajectories[200:210, 3]).max() < 0.5


def test_what_was_filled_teaches_nothing(person):
    measured = hidden(person, (3, 100, 140), (8, 100, 200))
    filled = measured.positions.copy()
    filled[100:200, 8] = 1e5
    one = network()
    later = Scene(filled, 100.0, measured.neighbours, measured=measured)
    usual = replace(later, neighbours=[np.array([m for m in near if m != 8]) for near in measured.neighbours])
    apart = Scene(measured.positions, 100.0, usual.neighbours)
    other = one.predict(usual, 3, 100, 140).positions
    assert np.array_equal(other, one.predict(apart, 3, 100, 140).positions)
    assert np.abs(one.predict(hidden(person), 8, 100, 110).positions).max() < 5000


def test_filled_references_are_looked_at(person):
    measured = hidden(person, (3, 100, 140), (int(neighbours(person)[3][0]), 100, 140))
    filled = np.where(np.isnan(measured.positions), person, measured.positions)
    filled[100:140, 3] = np.nan
    one = network(epochs=200)
    with_them = one.predict(Scene(filled, 100.0, measured.neighbours, measured=measured), 3, 100, 140).positions
    without = one.predict(measured, 3, 100, 140).positions
    assert np.isfinite(with_them).all() and not np.array_equal(with_them, without)


def test_a_gap_in_which_the_usual_inputs_are_missing_has_others(person):
    near = neighbours(person)[3]
    seen = hidden(person, (3, 100, 140), (3, 300, 330), *((int(other), 300, 330) for other in near[:4]))
    one = network()
    one.train([(seen, 3)])
    assert np.isfinite(one.predict(seen, 3, 100, 140).positions).all()
    assert np.isfinite(one.predict(seen, 3, 300, 330).positions).all()
    inputs = {inputs for _, inputs in one._cache(seen).networks}
    assert len(inputs) == 2


def test_too_few_training_frames_give_no_prediction(person):
    positions = person.copy()
    positions[OPTIONS.min_training_frames - 1 :, 3] = np.nan
    one = network()
    seen = Scene(positions, 100.0, neighbours(person))
    one.train([(seen, 3)])
    assert np.isnan(one.predict(seen, 3, 100, 120).positions).all()


@pytest.mark.parametrize("name", ["network_linear", "network_gru"])
def test_a_blackout_during_the_gap_stays_open(name, person):
    positions = person.copy()
    positions[100:140, 3] = np.nan
    positions[110:120] = np.nan
    found = network(name).predict(Scene(positions, 100.0, neighbours(person)), 3, 100, 140).positions
    assert np.isnan(found[11:21]).all()
    assert np.isfinite(np.delete(found, np.s_[11:21], axis=0)).all()


def test_recurrent_networks_look_beyond_the_gap(person):
    """What stands before the gap is context for all of them, what stands behind it for those of two directions."""
    seen = hidden(person, (3, 100, 140))
    for name, before, behind in (("network_tanh", 0, 0), ("network_gru", 1, 0), ("network_bilstm", 1, 1)):
        one = network(name)
        usual = one.predict(seen, 3, 100, 140).positions
        for frames, matters in ((slice(85, 95), before), (slice(145, 155), behind)):
            moved = seen.positions.copy()
            moved[frames] += 300.0
            other = Scene(moved, 100.0, seen.neighbours)
            other.cached((one, "trained"), partial(one._cache, seen))
            again = one.predict(other, 3, 100, 140).positions
            assert np.array_equal(usual, again) != bool(matters)


@pytest.mark.parametrize("name", KINDS)
def test_as_published_a_network_learns_from_all_frames_but_the_gap(name, person):
    """One sequence without the gap; the former positions of the inputs are those of the recording."""
    one = network(
        name, centred=False, inputs=None, max_training_frames=10**6, max_sequence_s=None, joined_sequences=True
    )
    seen = replace(hidden(person, (3, 100, 140)), segment_mates=[np.array([1, 5, 8]) for _ in range(12)])
    data, inputs, outputs = one._training_set(seen, 3, np.array([1, 5, 8]))
    assert [len(part) for part in data.inputs] == [len(person) - 40]
    trained = np.delete(np.arange(len(person)), np.s_[100:140])
    assert np.allclose(outputs.columns(data.targets[0]), person[trained, 3])
    now_and_before = np.stack(
        [person[:, [1, 5, 8]], person[np.maximum(np.arange(len(person)) - 1, 0)][:, [1, 5, 8]]], axis=2
    )
    assert np.allclose(inputs.columns(data.inputs[0]), now_and_before[trained].reshape(len(trained), -1))
    assert np.isfinite(one.predict(seen, 3, 100, 140).positions).all()


def test_trials_train_for_fewer_epochs():
    full = members(["network_gru"], predictor_options())[0]
    brief = full.abridged()
    assert (full.options.epochs, brief.options.epochs) == (OPTIONS.epochs, OPTIONS.pseudo_gap_epochs)
    assert replace(brief.options, epochs=full.options.epochs) == full.options


def test_without_torch_networks_are_refused_before_a_run(monkeypatch):
    monkeypatch.setattr(predictor, "find_spec", lambda name: None)
    config = {"fill": {"members": ["spline", "network_gru"]}}
    with pytest.raises(
        BadDataSet, match=r"fill.members: network_gru cannot be trained without torch: install it with pip"
    ):
        planning_config.check(config, deployed=False)
    planning_config.check(config, deployed=True)
    planning_config.check({}, deployed=False)
    with pytest.raises(ValueError, match="without torch"):
        members(["network_gru"], predictor_options())


FILL = """
import sys
import fill
fill.main(sys.argv[1:])
print("torch" in sys.modules)
"""


def stage(folder, names):
    """Run the fill stage; the changes that it wrote, and whether torch was imported."""
    options = shlex.split(write_flags(fill_options(members=names)))
    files = ["--repaired", folder / "06.parquet", "--repairs", folder / "06_changes.parquet"]
    files += ["--mesh", folder / "mesh.json", "--poses", "--code", "", "--filled", folder / "07.parquet"]
    files += ["--changes", folder / "07_changes.parquet"]
    command = [sys.executable, "-c", FILL, *map(str, files), *options, "--decisions=[]"]
    done = subprocess.run(
        command, cwd=PROJECT / "scripts", capture_output=True, text=True, check=True, encoding="utf-8"
    )
    return change_file.read(folder / "07_changes.parquet"), done.stdout.split()[-1] == "True"


def test_the_stage_fills_with_networks_and_imports_torch_only_then(person, tmp_path):
    gapped = hidden(person, (3, 100, 140), (7, 200, 215)).positions
    names = tuple(f"M{m}" for m in range(person.shape[1]))
    recording = restored(gapped, markers=names, recording="walk", kind="dynamic")
    stage_files.write_recording(tmp_path / "06.parquet", recording, {"stage": "repair"})
    change_file.write(tmp_path / "06_changes.parquet", [], {"stage": "repair"})
    ranked = {name: [names[other] for other in near] for name, near in zip(names, neighbours(person), strict=True)}
    body = {"recordings": ["walk"], "markers": names, "segments": [], "predictors": ranked, "neighbours": ranked}
    (tmp_path / "mesh.json").write_text(json.dumps({"meshes": [{**body, "warnings": []}]}), encoding="utf-8")
    assert mesh_file.read(tmp_path / "mesh.json", "walk").markers == names
    usual, torch = stage(tmp_path, FillOptions().members)
    assert [change.outcome for change in usual] == ["filled"] * 2 and not torch
    learned, torch = stage(tmp_path, ["network_linear"])
    assert len(learned) == 2 and torch
    assert {name for change in learned for name in weights(change)} == {"network_linear"}
