"""Slips of a segment are found to the frame and named; impacts, fast motion and single markers are none."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from markermend import api
from markermend.detection.system.segment_slips import find_segment_slips
from markermend.options.detection.frames import SegmentSlipOptions
from markermend.prediction.scene import Scene

OPTIONS = SegmentSlipOptions()
SHIFT = np.array([9.0, -6.0, 5.0])


@pytest.fixture(scope="module")
def scene(walker):
    return Scene.of(walker.recording, api.infer_mesh([walker.recording]))


@pytest.fixture(scope="module")
def segment(scene):
    return next(name for name, members in scene.segments.items() if 3 <= len(members) <= 6)


def slipped(scene, members, start, shape):
    positions = scene.positions.copy()
    positions[start : start + len(shape), members] += np.asarray(shape, float)[:, None, None] * SHIFT
    return replace(scene, positions=positions)


@pytest.mark.parametrize("shape", [[1, 1], [1] * 4, [1] * 6, [0.5, 1, 1, 0.5]])
def test_found_to_the_frame_with_its_size(scene, segment, shape):
    members = scene.segments[segment]
    (found,) = find_segment_slips(slipped(scene, members, 300, shape), OPTIONS)
    assert (found.segment, found.start, found.stop) == (segment, 300, 300 + len(shape))
    assert found.markers.tolist() == sorted(members.tolist()) and found.score >= 1
    np.testing.assert_allclose(found.displacements, np.broadcast_to(SHIFT, (len(members), 3)), atol=2)


@pytest.mark.parametrize("degrees", [0, 5])
def test_rounded_and_turning_ones_are_found(scene, segment, degrees):
    members, shape = scene.segments[segment], np.sin(np.pi * np.arange(1, 7) / 7)
    true = scene.positions[300:306, members]
    around = true - true.mean(axis=1, keepdims=True)
    turn = Rotation.from_rotvec(np.radians([0, 0, degrees])).as_matrix()
    positions = scene.positions.copy()
    positions[300:306, members] += shape[:, None, None] * (2 * SHIFT + around @ turn.T - around)
    (found,) = find_segment_slips(replace(scene, positions=positions), OPTIONS)
    assert (found.start, found.stop, found.markers.tolist()) == (300, 306, sorted(members.tolist()))


@pytest.mark.parametrize("shape", [[0.2, 0.6, 1, 0.7, 0.2], [0.1, 0.5, 1, 0.5, 0.1]])
def test_uneven_ones_are_found(scene, segment, shape):
    members = scene.segments[segment]
    (found,) = find_segment_slips(slipped(scene, members, 300, 2 * np.array(shape)), OPTIONS)
    assert abs(found.start - 300) <= 1 and abs(found.stop - 300 - len(shape)) <= 1
    assert found.markers.tolist() == sorted(members.tolist())


def test_motion_single_markers_and_impacts_are_none(scene, segment):
    members = scene.segments[segment]
    assert find_segment_slips(scene, OPTIONS) == []
    assert find_segment_slips(slipped(scene, members[:1], 300, [1, 1, 1]), OPTIONS) == []
    impact = slipped(scene, members, 300, np.maximum(0, 8 - np.abs(np.arange(16) - 8)))
    assert find_segment_slips(impact, OPTIONS) == []
    assert find_segment_slips(replace(scene, segments=None), OPTIONS) == []
