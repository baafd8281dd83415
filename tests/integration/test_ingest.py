"""The script ingest.py writes markers and facts, or sets a recording aside with a reason."""

import importlib.util
import json
import os
import sys

import numpy as np
import pytest

from markermend.command import inputs
from markermend.core.recording import SetAside
from markermend.storage import atomic, stage_files
from support.c3d_files import trajectories, write
from support.paths import PROJECT

NAMES = ["static", r"(^|[^a-z])cal\d*$"]


def run_script(arguments):
    """Run scripts/ingest.py in this process."""
    path = PROJECT / "scripts/ingest.py"
    spec = importlib.util.spec_from_file_location("ingest_script", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.main([str(argument) for argument in arguments])


def flags(source, target, **more):
    options = {
        "recording": "walk",
        "subject": "Anna",
        "kind": "auto",
        "rate": "none",
        "unit": "none",
        "sha256": "none",
        "within": "none",
        "static-motion-mm": 15,
        "min-placeholder-distance-mm": 1000,
        "min-static-s": 1,
        "min-rate-hz": 1,
        "max-rate-hz": 1e5,
        **more,
    }
    lists = [
        "--unlabelled",
        json.dumps([r"\*\d*"]),
        "--computed",
        json.dumps(["M9"]),
        "--static-names",
        json.dumps(NAMES),
    ]
    named = [f"--{name}={value}" for name, value in options.items()]
    return ["--source", source, "--markers", target, *named, *lists]


def test_the_script_writes_markers_and_facts(tmp_path):
    positions = trajectories(50, 4)
    positions[3, 2] = np.nan
    source = write(tmp_path / "walk.c3d", positions, labels=["A", "*1", "B", "C"], first_frame=705)
    target = tmp_path / "results" / "01_markers.parquet"
    run_script(flags(source, target))
    recording = stage_files.read_recording(target)
    assert recording.markers == ("A", "B", "C")
    np.testing.assert_array_equal(recording.positions, positions[:, [0, 2, 3]])
    assert (recording.rate, recording.first_frame) == (100.0, 705)
    facts = recording.facts
    assert facts["source"] == {
        "name": "walk.c3d",
        "sha256": atomic.sha256(source),
        "format": "c3d",
        "unit": "mm",
        "columns": [0, 2, 3],
        "screen": ["+X", "+Z"],
    }
    assert facts["missing"]["residual"] == 1 and facts["unlabelled"] == ["*1"] and facts["stage"] == "ingest"
    first = target.read_bytes()
    run_script(flags(source, target))
    assert target.read_bytes() == first
    run_script(flags(source, target, rate=250, unit="cm"))
    again = stage_files.read_recording(target)
    assert again.rate == 250 and again.facts["source"]["given_unit"] == "cm"
    np.testing.assert_array_equal(again.positions, 10 * recording.positions)


@pytest.mark.parametrize(
    ("name", "content", "reason"), [("walk.c3d", b"", "empty"), ("walk.mat", b"x", r"is a MATLAB file: export")]
)
def test_the_script_sets_a_bad_recording_aside(tmp_path, name, content, reason):
    source, target = tmp_path / name, tmp_path / "results" / "01_markers.parquet"
    source.write_bytes(content)
    run_script(flags(source, target))
    with pytest.raises(SetAside, match=reason):
        stage_files.read_recording(target)


@pytest.mark.parametrize(
    ("kind", "reason"),
    [
        ("pipe", "is not a file but a pipe"),
        ("device", "leads out of the folder"),
        ("secret", "leads out of the folder"),
    ],
)
def test_the_script_opens_no_pipe_and_no_link_out_of_the_folder(tmp_path, kind, reason):
    folder, source, target = (
        tmp_path / "study",
        tmp_path / "study/walk.c3d",
        tmp_path / "results" / "01_markers.parquet",
    )
    folder.mkdir()
    if kind == "pipe":
        os.mkfifo(source)
    else:
        source.symlink_to({"device": "/dev/zero", "secret": write(tmp_path / "secret.c3d")}[kind])
    run_script(flags(source, target, within=folder))
    with pytest.raises(SetAside, match=reason):
        stage_files.read_recording(target)


def test_the_script_tries_again_where_the_file_is_gone_since_the_run_was_planned(tmp_path):
    target = tmp_path / "results" / "01_markers.parquet"
    run_script(flags(tmp_path / "walk.c3d", target, sha256="0" * 64))
    with pytest.raises(SetAside, match=r"walk.c3d is gone since the run began"):
        stage_files.read_recording(target)
    assert (target.parent / "failures.tsv").exists()
    (target.parent / "failures.tsv").unlink()
    run_script(flags(tmp_path / "walk.c3d", target, sha256="not there"))
    assert not (target.parent / "failures.tsv").exists()


def test_a_locked_file_is_named_and_tried_again(tmp_path, monkeypatch):
    source, target = write(tmp_path / "walk.c3d"), tmp_path / "results" / "01_markers.parquet"

    def locked(path):
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(inputs, "sha256", locked)
    run_script(flags(source, target))
    with pytest.raises(SetAside, match=r"ingest failed: walk.c3d cannot be read: permission denied"):
        stage_files.read_recording(target)
    assert (target.parent / "failures.tsv").exists()


def test_the_script_needs_nothing_that_windows_has_not(tmp_path, monkeypatch):
    for name in ("resource", "fcntl", "pwd", "termios"):
        monkeypatch.setitem(sys.modules, name, None)
    monkeypatch.delattr(os, "fork")
    target = tmp_path / "results" / "01_markers.parquet"
    run_script(flags(write(tmp_path / "walk.c3d"), target))
    assert stage_files.read_recording(target).markers == ("M0", "M1", "M2", "M3")
