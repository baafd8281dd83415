"""Real recordings are ingested with every marker, or refused because nothing was seen."""

import pytest

from markermend.core.recording import BadRecording
from markermend.formats import files
from markermend.formats.ingest import ingest
from markermend.options.ingest import IngestOptions

OPTIONS = IngestOptions(static_names=("static", r"(^|[^a-z])cal\d*$"), static_motion_mm=15.0)


def ingested(reading, **more):
    options = {"source": "walk.c3d", "recording": "walk", "subject": "Anna", "kind": "auto"}
    return ingest(reading, **{**options, **more}, options=OPTIONS)


@pytest.mark.data
@pytest.mark.parametrize("name", ["16bitanalog", "parameterOverflow"])
def test_files_whose_points_are_all_zero_have_no_3d_data(data, name):
    reading = files.read(data / f"odd/{name}.c3d", unlabelled=[], rate=None)
    with pytest.raises(BadRecording, match=rf"{name}\.c3d has no 3-D data"):
        ingested(reading, source=f"{name}.c3d")


@pytest.mark.data
def test_a_marker_never_seen_in_a_real_recording(data):
    reading = files.read(data / "raw/nick_freeform_001.c3d", unlabelled=[], rate=None)
    recording = ingested(reading, recording="nick_freeform_001")
    assert recording.facts["warnings"] == ["Never seen: Nick01:CLAV."]
    assert recording.missing.mean() == pytest.approx(0.066, abs=0.001)
    assert recording.facts["kind"] == "dynamic"
