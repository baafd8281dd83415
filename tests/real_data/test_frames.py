"""Real recordings have no faults of the capture system, and those that are put into them are found."""

import numpy as np
import pytest

from markermend import api
from markermend.core.events import count_findings
from markermend.detection.frames import detect_frames
from markermend.options.detection.frames import FramesOptions
from markermend.prediction.scene import Scene

INTACT = [
    "clean/85_12.c3d", "clean/Qualisys.c3d", "clean/KneeltoProne01.c3d", "by_model/alberto.c3d", "by_model/art_human.c3d",
    "by_model/arnold_04_walk2.trc", "by_model/smpl_11_01.trc", "fast/sprint.trc", "fast/run0700cms.trc",
    "fast/golfswing.c3d", "fast/puck_shot.c3d", "field/two_persons.c3d",
]  # fmt: skip


def detect(recording, mesh, positions):
    scene = Scene.of(recording, mesh, positions)
    nothing = np.zeros(positions.shape, bool)
    return detect_frames(scene, markers=recording.markers, earlier=nothing, options=FramesOptions())


@pytest.mark.data
@pytest.mark.parametrize("name", INTACT)
def test_intact_recordings_have_none(data, name):
    recording = api.read(data / name)
    assert detect(recording, api.infer_mesh([recording]), recording.positions) == ([], [])


@pytest.mark.data
@pytest.mark.parametrize("name", ["clean/Qualisys.c3d", "clean/STS1.trc", "sessions/expert1/DJ2.trc"])
def test_faults_are_found(data, name):
    recording = api.read(data / name)
    mesh = api.infer_mesh([recording])
    positions, middle = recording.positions.copy(), recording.frames // 2
    positions[40:45] = positions[39]
    positions[middle : middle + 20] += [9.0, -7.0, 4.0]
    found, warnings = detect(recording, mesh, positions)
    assert {(event.kind, event.start, event.stop) for event in found} == {
        ("repeat", 40, 45),
        ("jump", middle, middle + 20),
    }
    assert count_findings(found) == 2 and warnings == []
