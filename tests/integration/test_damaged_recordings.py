"""A recording that is damaged and cannot be made anew is left out of what its subject shares, and the others are not set aside."""

import json
import shlex
from dataclasses import replace

import pytest

import mesh
import poses
from markermend.core.recording import Restored, SetAside
from markermend.options.flags import write_flags
from markermend.options.mesh import MeshOptions
from markermend.options.poses import PosesOptions
from markermend.storage import mesh_file, output_checksums, poses_file, stage_files
from support.walkers import person

NAMES = ("walk", "run", "jump")


@pytest.fixture(scope="module")
def subject(tmp_path_factory):
    """The folder of a subject with three recordings as ingested and repaired, of which one is damaged since."""
    folder = tmp_path_factory.mktemp("S01")
    recording = person(3, duration=3.0).recording
    for name in NAMES:
        facts = {"recording": name, "kind": "dynamic", "source": {"sha256": name}}
        ingested = replace(recording, facts=facts)
        nothing = recording.missing * 0.0
        restored = Restored(
            recording.markers, recording.positions, recording.rate, 1, facts, nothing.astype("u1"), nothing, nothing
        )
        for stage, file, content in (("ingest", "01_markers", ingested), ("repair", "06_repaired", restored)):
            path = folder / name / f"{file}.parquet"
            stage_files.write_recording(path, content, {"stage": stage})
            output_checksums.write(stage, [path])
            if name == "jump":
                path.write_bytes(path.read_bytes() + b" ")
    return folder


def files(folder, name, names=NAMES):
    return [str(folder / recording / name) for recording in names]


def make_mesh(folder, names=NAMES):
    flags = shlex.split(write_flags(MeshOptions()))
    markers = files(folder, "01_markers.parquet", names)
    mesh.main(["--markers", *markers, "--mesh-files", "--mesh", str(folder / "mesh.json"), *flags])
    return (folder / "mesh.json").read_bytes()


def make_poses(folder, names=NAMES):
    flags = shlex.split(write_flags(PosesOptions()))
    repaired = files(folder, "06_repaired.parquet", names)
    poses.main(
        ["--repaired", *repaired, "--mesh", str(folder / "mesh.json"), "--poses", str(folder / "poses.parquet"), *flags]
    )
    return (folder / "poses.parquet").read_bytes()


def test_the_mesh_is_inferred_from_the_others(subject):
    assert make_mesh(subject) == make_mesh(subject, NAMES[:2])
    assert len(mesh_file.read_groups(subject / "mesh.json")) == 1
    assert (
        (subject / "jump/failures.tsv").read_text().startswith("ingest\t01_markers.parquet is not as ingest wrote it")
    )
    assert (subject / "failures.tsv").read_text() == "mesh\t1 of 3 recordings are damaged\n"


def test_poses_are_sampled_from_the_others(subject):
    make_mesh(subject, NAMES[:2])
    assert make_poses(subject) == make_poses(subject, NAMES[:2])
    assert set(poses_file.read(subject / "poses.parquet").recordings) == {"run", "walk"}
    assert "repair\t06_repaired.parquet is not as repair wrote it" in (subject / "jump/failures.tsv").read_text()


def test_where_all_are_damaged_the_subject_is_set_aside(subject):
    make_mesh(subject, NAMES[2:])
    assert (
        "no recording of the subject is as it was written"
        in json.loads((subject / "mesh.json").read_text())["set_aside"]["reason"]
    )
    with pytest.raises(SetAside):
        mesh_file.read_groups(subject / "mesh.json")
