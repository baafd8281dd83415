"""Poses of a subject: what one recording is shown of the others."""

import numpy as np

from markermend.core.poses import Pool, Poses


def make_poses() -> Poses:
    """Three rows of `walk`, two of `jump`, which lacks marker B, and one of `static`."""
    positions = np.arange(6 * 3 * 3, dtype=float).reshape(6, 3, 3)
    positions[3:5, 1] = np.nan
    recording = np.array([0, 0, 0, 1, 1, 2])
    return Poses(("A", "B", "C"), positions, ("walk", "jump", "static"), recording, np.array([0, 5, 9, 2, 3, 0]))


def test_own_poses_are_left_out_and_recordings_numbered_anew() -> None:
    poses = make_poses()
    pool = poses.others("walk", ["C", "B"])
    assert pool is not None
    assert pool.names == ("jump", "static")
    assert pool.recording.tolist() == [0, 0, 1]
    np.testing.assert_array_equal(pool.positions[:, 0], poses.positions[3:, 2])
    np.testing.assert_array_equal(pool.present, [[True, False], [True, False], [True, True]])


def test_markers_that_no_other_recording_has_are_missing() -> None:
    pool = make_poses().others("jump", ["A", "unknown"])
    assert pool is not None
    assert not pool.present[:, 1].any()
    assert pool.present[:, 0].all()


def test_there_is_no_pool_without_other_recordings_or_joint_markers() -> None:
    poses = make_poses()
    assert poses.others("walk", ["unknown"]) is None
    nothing = np.empty(0, int)
    assert Poses((), np.empty((0, 0, 3)), (), nothing, nothing).others("walk", ["A"]) is None
    alone = Poses(poses.markers, poses.positions[:3], ("walk",), poses.recording[:3], poses.frames[:3])
    assert alone.others("walk", ["A", "B"]) is None


def test_poses_of_recordings_with_another_mesh_are_not_shown() -> None:
    pool = make_poses().others("walk", ["A"], among=["walk", "static"])
    assert pool is not None
    assert pool.names == ("static",)
    assert make_poses().others("walk", ["A"], among=["walk"]) is None


def test_rows_of_recordings_that_show_markers_too_seldom_are_left_out() -> None:
    positions = np.zeros((7, 2, 3))
    positions[[1, 5], 1] = np.nan
    pool = Pool(positions, np.repeat([0, 1], [4, 3]), ("walk", "jump"))
    assert pool.rows_with([0, 1], fewest=1).tolist() == [0, 2, 3, 4, 6]
    assert pool.rows_with([0, 1], fewest=3).tolist() == [0, 2, 3]
    assert pool.rows_with([1], fewest=4).tolist() == []
