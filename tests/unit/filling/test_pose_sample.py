"""The sample of a subject's poses: shares of the recordings, frames of a recording, and what is left out."""

import numpy as np
import pytest

from markermend.core.recording import MEASURED, MISSING, ORIGINS, Restored
from markermend.filling.pose_sample import join, sample_poses, share_out
from markermend.options.poses import PosesOptions
from support.naive.filling import share_out as naive_share_out

OPTIONS = PosesOptions()


def limited(max_poses: int, min_recording_poses: int = 1) -> PosesOptions:
    return PosesOptions(max_poses=max_poses, min_recording_poses=min_recording_poses)


def restored(positions: np.ndarray, name: str = "walk", markers: str = "ABCD") -> Restored:
    """A recording as repair hands it on: nothing repaired."""
    missing = np.isnan(positions).any(axis=2)
    error = np.where(missing, np.nan, 0.0)
    origin = np.where(missing, MISSING, MEASURED).astype(np.uint8)
    return Restored(tuple(markers), positions, 100.0, 1, {"recording": name}, origin, error, error.copy())


def moving(frames: int, seed: int = 0, markers: int = 4) -> np.ndarray:
    """Positions (frames, markers, 3)."""
    return np.random.default_rng(seed).normal(0, 100, (frames, markers, 3))


@pytest.mark.parametrize("total", [3, 5, 100, 1000])
@pytest.mark.parametrize("frames", [{"a": 7, "b": 300, "c": 50}, {"a": 10, "b": 10}, {"a": 5, "b": 0}])
def test_shares_are_those_of_dealing_out_one_by_one(frames, total):
    shares = share_out(frames, [list(frames)], options=limited(total))
    assert shares == naive_share_out(frames, total)


def test_shares_do_not_depend_on_the_order_and_are_at_most_the_limit():
    frames = {f"r{number}": 40 + number % 7 for number in range(30)}
    shares = share_out(frames, [list(frames)], options=limited(1000))
    assert shares == share_out(dict(reversed(frames.items())), [sorted(frames, reverse=True)], options=limited(1000))
    assert sum(shares.values()) == 1000 and max(shares.values()) - min(shares.values()) <= 1


def test_recordings_that_no_other_shares_a_mesh_with_have_no_share():
    frames = {"a": 100, "b": 100, "c": 100}
    assert share_out(frames, [("a", "b"), ("c", "static")], options=limited(60)) == {"a": 30, "b": 30}
    assert share_out({"a": 100}, [("a",)], options=limited(60)) == {}


def test_of_too_many_recordings_evenly_spaced_ones_have_a_share():
    frames = {f"r{number:02}": 40 for number in range(30)}
    shares = share_out(frames, [list(frames)], options=limited(100, min_recording_poses=10))
    assert list(shares) == [f"r{number:02}" for number in range(0, 30, 3)]
    assert set(shares.values()) == {10}


def test_each_stretch_gives_the_frame_in_which_most_markers_are_seen():
    positions = moving(40)
    positions[:, 0] = np.nan
    positions[[3, 17, 21, 38], 0] = 1.0
    sample = sample_poses(restored(positions), 4, options=OPTIONS)
    assert sample.frames.tolist() == [3, 17, 21, 38]
    assert np.array_equal(sample.positions, positions[sample.frames])


def test_a_short_recording_gives_all_of_its_frames():
    assert sample_poses(restored(moving(10)), 10, options=OPTIONS).frames.tolist() == list(range(10))
    assert not len(sample_poses(restored(moving(0)), 0, options=OPTIONS).frames)


def test_estimates_of_repair_are_left_out_and_exchanged_samples_are_not():
    own = restored(moving(20))
    own.origin[5:15, 1], own.origin[:, 2] = ORIGINS.index("peak"), ORIGINS.index("swap")
    own.error[5:15, 1] = 0.5
    sample = sample_poses(own, 20, options=OPTIONS)
    assert np.isnan(sample.positions[5:15, 1]).all()
    assert np.array_equal(sample.positions[:, [0, 2, 3]], own.positions[:, [0, 2, 3]])


def test_poses_in_which_few_markers_are_seen_do_not_count():
    positions = moving(20)
    positions[:10, 1:] = np.nan
    assert sample_poses(restored(positions), 20, options=OPTIONS).frames.tolist() == list(range(10, 20))


def test_joined_poses_have_the_markers_of_all_recordings_whatever_their_order():
    walk = sample_poses(restored(moving(6)), 3, options=OPTIONS)
    jump = sample_poses(restored(moving(4, seed=1, markers=2), "jump", "DX"), 2, options=OPTIONS)
    poses = join([walk, jump])
    assert poses.markers == tuple("ABCDX") and poses.recordings == ("jump", "walk")
    assert poses.recording.tolist() == [0, 0, 1, 1, 1]
    assert poses.frames.tolist() == [*jump.frames, *walk.frames]
    assert np.array_equal(poses.positions[:2, 3:], jump.positions) and np.isnan(poses.positions[:2, :3]).all()
    assert np.array_equal(poses.positions[2:, :4], walk.positions) and np.isnan(poses.positions[2:, 4]).all()
    other = join([jump, walk])
    assert np.array_equal(other.positions, poses.positions, equal_nan=True)


def test_nothing_is_joined_to_nothing_and_names_must_differ():
    assert join([]).positions.shape == (0, 0, 3)
    walk = sample_poses(restored(moving(6)), 3, options=OPTIONS)
    with pytest.raises(ValueError, match="two recordings have one name"):
        join([walk, walk])
