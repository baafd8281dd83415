"""Sampling the poses of a subject from its files: static recordings and those set aside are left out."""

from dataclasses import replace

import numpy as np

from markermend.command.subject_poses import sample_subject
from markermend.core.recording import Restored
from markermend.filling.pose_sample import sample_poses
from markermend.options.poses import PosesOptions
from markermend.storage import stage_files

OPTIONS = PosesOptions(max_poses=20)


def write(folder, name, *, frames=50, kind="dynamic", rate=100.0):
    positions = np.random.default_rng(frames).normal(0, 100, (frames, 3, 3))
    error = np.zeros((frames, 3))
    facts = {"recording": name, "kind": kind, "source": {"sha256": f"of {name}"}}
    origin = error.astype(np.uint8)
    restored = Restored(("A", "B", "C"), positions, rate, 1, facts, origin, error, error)
    path = folder / name / "06_repaired.parquet"
    stage_files.write_recording(path, restored, {"stage": "repair"})
    return path, restored


def test_recordings_have_their_shares_and_static_and_bad_ones_none(tmp_path):
    walk, restored = write(tmp_path, "walk")
    jump, _ = write(tmp_path, "jump", frames=5, rate=250.0)
    static, _ = write(tmp_path, "static", kind="static")
    bad = tmp_path / "bad/06_repaired.parquet"
    stage_files.set_aside(bad, "ingest", "no markers")
    paths = [walk, static, bad, jump]
    groups = [("jump", "static", "walk")]
    samples, sources = sample_subject(paths, groups, options=OPTIONS)
    assert {sample.recording: len(sample.frames) for sample in samples} == {"jump": 5, "walk": 15}
    assert sources == {"jump": "of jump", "walk": "of walk"}
    alone = sample_poses(replace(restored), 15, options=OPTIONS)
    assert np.array_equal(samples[1].positions, alone.positions)
    again, _ = sample_subject(paths[::-1], groups, options=OPTIONS)
    assert [sample.recording for sample in again] == [sample.recording for sample in samples]


def test_where_all_were_set_aside_there_are_no_poses(tmp_path):
    stage_files.set_aside(tmp_path / "06.parquet", "ingest", "no markers")
    assert sample_subject([tmp_path / "06.parquet"], [], options=OPTIONS) == ([], {})
