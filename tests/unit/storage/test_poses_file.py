"""The file of poses: read as it was written, equal poses give equal bytes."""

import numpy as np
import pytest

from markermend.core.poses import Poses
from markermend.core.recording import SetAside
from markermend.storage import poses_file, stage_files


def make_poses() -> Poses:
    """Two poses of `a b` and one of `jump`, with a marker that has a name like a column."""
    positions = np.random.default_rng(1).normal(0, 1, (3, 2, 3))
    positions[2, 1] = np.nan
    return Poses(("recording", "X.y"), positions, ("a b", "jump"), np.array([0, 0, 1]), np.array([4, 9, 2]))


def test_poses_are_read_as_they_were_written(tmp_path):
    poses = make_poses()
    poses_file.write(tmp_path / "poses.parquet", poses, {"stage": "poses"})
    read = poses_file.read(tmp_path / "poses.parquet")
    assert (read.markers, read.recordings) == (poses.markers, poses.recordings)
    for name in ("positions", "recording", "frames"):
        assert np.array_equal(getattr(read, name), getattr(poses, name), equal_nan=True)
    assert stage_files.read_facts(tmp_path / "poses.parquet")["stage"] == "poses"


def test_equal_poses_give_equal_bytes_and_none_can_be_stored(tmp_path):
    for name in "ab":
        poses_file.write(tmp_path / name, make_poses(), {})
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()
    nothing = np.empty(0, int)
    poses_file.write(tmp_path / "none", Poses((), np.empty((0, 0, 3)), (), nothing, nothing), {})
    assert poses_file.read(tmp_path / "none").positions.shape == (0, 0, 3)


def test_poses_that_were_set_aside_are_refused(tmp_path):
    stage_files.set_aside(tmp_path / "poses.parquet", "mesh", "no markers")
    with pytest.raises(SetAside, match="no markers"):
        poses_file.read(tmp_path / "poses.parquet")
