"""What a detector finds, and what its stage warns of, without files."""

import pytest

from markermend import api
from markermend.command import detector
from markermend.core.events import Event
from markermend.options.detection.frames import FramesOptions
from markermend.options.detection.labels import LabelsOptions
from markermend.options.detection.slow import SlowOptions
from support.repairs import body

FOUND = [Event("LKNE", 10, 20, 2.0)]


def detect(**given):
    """A detector that states something beside its findings."""
    assert "scene" in given and given["markers"]
    return FOUND, ["odd"]


@pytest.mark.parametrize(
    ("options", "warnings"), [(LabelsOptions(), ["odd"]), (FramesOptions(), ["odd"]), (SlowOptions(), [])]
)
def test_only_labels_and_frames_state_warnings(options, warnings):
    recording = body()
    mesh = api.mesh_of(recording, api.infer_mesh([recording]))
    assert detector.find_and_warn(detect, recording, mesh, [], options=options) == (FOUND, warnings)
    assert detector.find(detect, recording, mesh, [], options=options) == FOUND
