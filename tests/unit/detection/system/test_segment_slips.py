"""Slips of a segment are found to the frame and named; impacts, fast motion and single markers are none."""

from dataclasses import replace

import numpy as np
import pytest

from markermend import api
from markermend.detection.system.segment_slips import _best_pulse, find_segment_slips
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
    np.testing.assert_allclose(found.displacement, SHIFT, atol=2)


def test_motion_single_markers_and_impacts_are_none(scene, segment):
    members = scene.segments[segment]
    assert find_segment_slips(scene, OPTIONS) == []
    assert find_segment_slips(slipped(scene, members[:1], 300, [1, 1, 1]), OPTIONS) == []
    impact = slipped(scene, members, 300, np.maximum(0, 8 - np.abs(np.arange(16) - 8)))
    assert find_segment_slips(impact, OPTIONS) == []
    assert find_segment_slips(replace(scene, segments=None), OPTIONS) == []


def test_best_pulse_agrees_with_least_squares():
    rng = np.random.default_rng(6)
    time = np.linspace(-1, 1, 19)
    course = rng.normal(0, 0.1, (19, 3)) + 20 * np.vander(time, 4) @ rng.normal(size=(4, 3))
    course[7:11] += SHIFT
    pulse = _best_pulse(course, 6, 3)
    assert (pulse.start, pulse.stop) == (7, 11)
    box = (np.arange(19) >= 7) & (np.arange(19) < 11)
    naive, residual, _, _ = np.linalg.lstsq(np.column_stack([np.vander(time, 6), box]), course, rcond=None)
    np.testing.assert_allclose(pulse.weights @ course, naive[-1])
    assert pulse.residual == pytest.approx(residual.sum())
