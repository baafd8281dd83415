"""Jumps of all markers are found with their amount; motion, and jumps of some markers, are none."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from markermend.detection.system.scene_jumps import find_displaced_stretches
from markermend.numerics.displaced_scene import move_back
from markermend.options.detection.frames import SceneJumpOptions

SHIFT = np.array([6.0, -8.0, 3.0])


def find(recording, positions):
    return find_displaced_stretches(positions, recording.rate, SceneJumpOptions())


def jumping(positions, start, stop, turn=0.0):
    """Positions that are displaced over a stretch, and turned about a far point by `turn` degrees."""
    moved = positions.copy()
    turned = Rotation.from_rotvec([0, 0, np.radians(turn)]).apply(positions[start:stop].reshape(-1, 3))
    moved[start:stop] = turned.reshape(moved[start:stop].shape) + SHIFT
    return moved


@pytest.mark.parametrize("turn", [0.0, 0.4])
@pytest.mark.parametrize("length", [1, 2, 3, 40, 300])
def test_jumps_there_and_back_are_found_and_undone(walker, length, turn):
    recording = walker.recording
    moved = jumping(recording.positions, 300, 300 + length, turn)
    (found,) = find(recording, moved)
    assert (found.start, found.stop, found.returns) == (300, 300 + length, True)
    back, _ = move_back(moved, 300, 300 + length, returns=True)
    assert np.abs(back - recording.positions[300 : 300 + length]).max() < 2
    assert turn or found.amount_mm == pytest.approx(np.linalg.norm(SHIFT), rel=0.5 if length < 4 else 0.05)


def test_a_scene_that_rings_jumps_once(walker):
    time = np.arange(len(walker.recording.positions)) - 300
    size = (time >= 0) * (1 + 0.4 * np.exp(-np.maximum(time, 0) / 2) * np.cos(np.pi * time))
    for stop, returns in ((360, True), (len(time), False)):
        moved = walker.recording.positions + (size * (np.arange(len(time)) < stop))[:, None, None] * SHIFT
        (found,) = find(walker.recording, moved)
        assert (found.start, found.stop, found.returns) == (300, stop, returns)


def test_jumps_that_stay_last_to_the_next_or_to_the_end(walker):
    moved = walker.recording.positions.copy()
    moved[200:] += SHIFT
    moved[500:] += 2 * SHIFT
    found = [(one.start, one.stop, one.returns) for one in find(walker.recording, moved)]
    assert found == [(200, 500, False), (500, len(moved), False)]


def test_a_jump_within_a_shift(walker):
    moved = jumping(walker.recording.positions, 200, len(walker.recording.positions))
    moved[400:430] -= 3 * SHIFT
    assert [(one.start, one.stop, one.returns) for one in find(walker.recording, moved)] == [
        (200, len(moved), False),
        (400, 430, True),
    ]


def test_motion_and_jumps_of_a_part_are_none(walker):
    recording = walker.recording
    assert find(recording, recording.positions) == []
    half = recording.positions.copy()
    half[300:330, ::2] += SHIFT
    assert find(recording, half) == []
    assert find(recording, recording.positions[:3]) == []
