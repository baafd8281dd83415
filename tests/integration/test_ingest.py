"""The script ingest.py writes markers and facts, or sets a recording aside with a reason."""

import importlib.util
import json

import numpy as np
import pytest

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
        "sha256": "none",
        "static-motion-mm": 15,
        "min-placeholder-distance-mm": 1000,
        **more,
    }
    lists = ["--unlabelled", json.dumps([r"\*\d*"]), "--static-names", json.dumps(NAMES)]
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
    }
    assert facts["missing"]["residual"] == 1 and facts["unlabelled"] == ["*1"] and facts["stage"] == "ingest"
    first = target.read_bytes()
    run_script(flags(source, target))
    assert target.read_bytes() == first
    run_script(flags(source, target, rate=250))
    assert stage_files.read_recording(target).rate == 250


@pytest.mark.parametrize(
    ("name", "content", "reason"), [("walk.c3d", b"", "empty"), ("walk.mat", b"x", r"\.mat.*\.c3d, \.trc")]
)
def test_the_script_sets_a_bad_recording_aside(tmp_path, name, content, reason):
    source, target = tmp_path / name, tmp_path / "results" / "01_markers.parquet"
    source.write_bytes(content)
    run_script(flags(source, target))
    with pytest.raises(SetAside, match=reason):
        stage_files.read_recording(target)
