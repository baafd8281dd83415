"""Detectors of one process read each file once."""

import pytest

from markermend.command import inputs
from markermend.command.detector_inputs import DetectorInputs
from markermend.core.events import Event
from markermend.core.recording import BadRecording
from markermend.storage import atomic, stage_files

EVENTS = [Event("LKNE", 10, 20, 2.0)]


@pytest.fixture
def events(tmp_path):
    path = tmp_path / "02_labels.parquet"
    stage_files.write_events(path, EVENTS, {})
    return path


def test_checksums_are_computed_once(events, monkeypatch):
    files, expected = DetectorInputs(), atomic.sha256(events)
    assert files.checksums(events, own=events.parent) == expected
    monkeypatch.setattr(inputs, "checksums", None)
    assert files.checksums([events, events], own=events.parent) == [expected, expected]
    assert files.checksums([], own=events.parent) == []


def test_a_file_that_is_not_there_is_looked_for_again(events):
    files, missing = DetectorInputs(), events.with_name("02_frozen.parquet")
    with pytest.raises(BadRecording, match=r"02_frozen.parquet is not there"):
        files.checksums([events, missing], own=events.parent)
    events.rename(missing)
    assert files.checksums(missing, own=events.parent) == atomic.sha256(missing)


def test_events_are_read_once_and_given_in_the_order_of_the_files(events):
    files, other = DetectorInputs(), events.with_name("02_frozen.parquet")
    stage_files.write_events(other, [Event("LTHI", 1, 2, 1.0)], {})
    assert files.events([other, events]) == [Event("LTHI", 1, 2, 1.0), *EVENTS]
    other.unlink()
    assert files.events([events, other]) == [*EVENTS, Event("LTHI", 1, 2, 1.0)]


def test_recording_and_mesh_are_read_once(walker_files):
    files = DetectorInputs()
    recording = files.recording(walker_files.markers)
    assert recording.markers == walker_files.recording.markers
    mesh = files.mesh(walker_files.mesh, recording)
    assert files.recording(walker_files.markers) is recording and files.mesh(walker_files.mesh, recording) is mesh
