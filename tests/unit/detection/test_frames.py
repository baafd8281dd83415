"""Faults of the capture system are found as one finding each, and hide from one another what they explain."""

from dataclasses import replace

import numpy as np
import pytest

from markermend import api
from markermend.core.events import count_findings
from markermend.detection.frames import ALL, detect_frames
from markermend.options.detection.frames import FramesOptions
from markermend.prediction.scene import Scene

SHIFT = np.array([6.0, -8.0, 3.0])


@pytest.fixture(scope="module")
def scene(walker):
    return Scene.of(walker.recording, api.infer_mesh([walker.recording]))


def detect(walker, scene, positions):
    nothing = np.zeros(positions.shape, bool)
    return detect_frames(
        replace(scene, positions=positions), markers=walker.recording.markers, earlier=nothing, options=FramesOptions()
    )


def test_each_fault_is_one_finding(walker, scene):
    positions = scene.positions.copy()
    segment = next(name for name, members in scene.segments.items() if 3 <= len(members) <= 6)
    positions[200:204, scene.segments[segment]] += 2 * SHIFT
    positions[300:304] = positions[299]
    positions[500:530] += SHIFT
    positions[800:] -= SHIFT
    found, warnings = detect(walker, scene, positions)
    assert {(event.kind, event.group, event.start, event.stop) for event in found} == {
        ("slip", segment, 200, 204),
        ("repeat", ALL, 300, 304),
        ("jump", ALL, 500, 530),
        ("shift", ALL, 800, len(positions)),
    }
    assert count_findings(found) == 4 and warnings == []
    amounts = {event.kind: event.amount_mm for event in found}
    assert amounts["repeat"] is None and amounts["jump"] == pytest.approx(np.linalg.norm(SHIFT), abs=0.5)
    assert sum(event.kind == "jump" for event in found) == len(walker.recording.markers)


def test_an_intact_recording_has_none(walker, scene):
    assert detect(walker, scene, scene.positions) == ([], [])


def test_frames_of_a_lower_rate_are_warned_of_once(walker, scene):
    found, (warning,) = detect(walker, scene, np.repeat(scene.positions[::2], 2, axis=0))
    assert found == [] and "100 frames a second, of which about 50 differ" in warning
