"""What detectors are given: trajectories on which the exchanges of an earlier stage are undone, and no others."""

import shlex
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import mesh as mesh_script
from markermend.command import detector_stage
from markermend.command.detector_inputs import DetectorInputs
from markermend.core.events import Event
from markermend.options.config import read_config
from markermend.options.flags import write_flags
from markermend.options.mesh import MeshOptions
from markermend.storage import stage_files

SPAN = slice(300, 380)
EXCHANGES = [Event("LTHI", 300, 380, 3.0, partner="LKNE"), Event("LKNE", 300, 380, 3.0, partner="LTHI")]
FROZEN = [Event("LTHI", 310, 320, 2.0)]


@pytest.fixture(scope="module")
def files(tmp_path_factory, walker):
    """A recording with two labels exchanged, its mesh, and events of labels and frozen on it."""
    folder = tmp_path_factory.mktemp("stage")
    clean = walker.recording
    pair = [clean.markers.index(name) for name in ("LTHI", "LKNE")]
    positions = clean.positions.copy()
    positions[SPAN, pair] = positions[SPAN, pair[::-1]]
    facts = {"recording": "walk", "subject": "S", "kind": "dynamic"}
    recording = replace(clean, positions=positions, facts=facts)
    made = SimpleNamespace(clean=clean, recording=recording, pair=pair, markers=folder / "01_markers.parquet")
    stage_files.write_recording(made.markers, recording, {})
    made.mesh, made.labels, made.frozen = (folder / name for name in ("mesh.json", "l.parquet", "f.parquet"))
    words = shlex.split(write_flags(MeshOptions()))
    mesh_script.main(["--markers", str(made.markers), "--mesh-files", "--mesh", str(made.mesh), *words])
    stage_files.write_events(made.labels, EXCHANGES, {"stage": "labels"})
    stage_files.write_events(made.frozen, FROZEN, {"stage": "frozen"})
    return made


def arguments(files, earlier, preset="default"):
    options = read_config({"peaks": {"preset": preset}})["peaks"]
    call = SimpleNamespace(
        markers=files.markers, mesh=files.mesh, earlier=earlier, options=options, files=DetectorInputs()
    )
    given, recorded_under = detector_stage.arguments(call)
    return given["scene"].positions, given["earlier"], recorded_under


def test_exchanges_of_the_stage_labels_are_undone(files):
    positions, claimed, recorded_under = arguments(files, [files.labels, files.frozen])
    assert np.array_equal(positions, files.clean.positions) and recorded_under == []
    assert claimed[310:320, files.pair[0]].all() and claimed.sum() == 30


def test_without_that_stage_nothing_is_undone(files):
    positions, _, recorded_under = arguments(files, [files.frozen])
    assert np.array_equal(positions, files.recording.positions) and recorded_under == []


def test_as_recorded_what_was_claimed_follows_its_samples(files):
    positions, claimed, recorded_under = arguments(files, [files.labels, files.frozen], preset="paper")
    assert np.array_equal(positions, files.recording.positions)
    assert recorded_under == sorted(EXCHANGES, key=lambda event: event.order)
    assert claimed[310:320, files.pair[1]].all() and claimed.sum() == 30


def test_what_is_found_as_recorded_is_written_under_the_right_labels(files, tmp_path):
    call = SimpleNamespace(events=tmp_path / "events.parquet", facts={"stage": "peaks"})
    detector_stage.write(call, [Event("LKNE", 310, 320, 2.0)], EXCHANGES, {})
    assert stage_files.read_events(call.events) == FROZEN
