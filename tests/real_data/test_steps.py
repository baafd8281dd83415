"""Polarity of steps: of the stretches between edges the one that disagrees with the marker's usual shape is displaced."""

import numpy as np
import pytest

from markermend import api
from markermend.core import events


@pytest.fixture(scope="module")
def gait(data):
    """A recording whose markers flip between two levels, and the samples that steps are found on, or dips, if they are short."""
    recording = api.read(data / "clean/Qualisys.c3d")
    found = api.detect(recording, api.infer_mesh([recording]))
    return recording, events.mask([*found["steps"], *found["peaks"]], recording.frames, recording.markers)


def share(gait, marker, first, last):
    """Share of the samples found from the first to the last frame of the file."""
    recording, found = gait
    rows = slice(first - recording.first_frame, last - recording.first_frame + 1)
    return float(np.mean(found[rows, recording.markers.index(marker)]))


@pytest.mark.data
@pytest.mark.parametrize(
    ("marker", "first", "last"),
    [("L_RSP", 837, 849), ("L_HDB", 893, 904), ("L_HM5", 895, 938), ("R_UHE", 716, 742), ("R_FLE", 966, 1023)],
)
def test_good_stretches_between_glitches_stay(gait, marker, first, last):
    assert share(gait, marker, first, last) == 0


@pytest.mark.data
@pytest.mark.parametrize(
    ("marker", "first", "last"),
    [("L_RSP", 765, 777), ("R_HDF", 731, 742), ("R_HLE", 955, 967), ("R_UHE", 929, 948)],
)
def test_stretches_that_contradict_the_shape_are_found(gait, marker, first, last):
    assert share(gait, marker, first, last) == 1


@pytest.mark.data
@pytest.mark.parametrize("name", ["fast/run0700cms.trc", "fast/sprint.trc", "by_model/smpl_11_01.trc"])
def test_fast_motion_and_models_have_no_steps(data, name):
    recording = api.read(data / name)
    assert api.detect(recording, api.infer_mesh([recording]))["steps"] == []


@pytest.mark.data
def test_what_recurs_with_each_squat_is_no_step(data):
    folder = data / "sessions/expert1"
    session = [
        api.read(folder / f"{name}.trc", subject="expert1") for name in ("squats1", "static1", "walking1", "STSFast1")
    ]
    steps = api.detect(session[0], api.infer_mesh(session))["steps"]
    named = {event.marker for event in steps}
    assert not named & {"L_elbow_med", "L_thigh1"}
    assert {"L_Sternum", "R_Sternum"} <= named
