"""Ingesting keeps every marker, decides what is static, and says why a recording cannot be used."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from markermend.core.recording import BadRecording, Recording
from markermend.formats.ingest import ingest, motion_mm, recording_kind
from markermend.formats.notes import Note
from markermend.formats.reading import Reading
from markermend.options.ingest import IngestOptions

OPTIONS = IngestOptions(static_names=("static", r"(^|[^a-z])cal\d*$"), static_motion_mm=15.0)


def moving(frames=300, markers=10, amplitude=400.0):
    """A recording whose markers go to and fro along x by `amplitude` mm."""
    phase = np.linspace(0, 6 * np.pi, frames)
    positions = np.full((frames, markers, 3), 1000.0) + np.arange(markers)[:, None] * 50
    positions[..., 0] += amplitude / 2 * np.sin(phase)[:, None]
    return Recording(tuple(f"M{m}" for m in range(markers)), positions, 100.0)


def reading_of(recording, **more):
    return Reading(recording, "c3d", "mm", tuple(range(len(recording.markers))), **more)


def ingested(reading, **more):
    options = {"source": "walk.c3d", "recording": "walk", "subject": "Anna", "kind": "auto"}
    return ingest(reading, **{**options, **more}, options=OPTIONS)


def kind(recording, name="walk", stated="auto"):
    return recording_kind(recording, name=name, kind=stated, options=OPTIONS)


def test_facts_state_what_was_read():
    reading = reading_of(moving(), unlabelled=("*1",), model_outputs=("LHipAngles",), missing={"residual": 3})
    recording = ingested(replace(reading, warnings=("Odd.", Note("Plain."))))
    assert recording.facts == {
        "source": {"name": "walk.c3d", "format": "c3d", "unit": "mm", "columns": list(range(10))},
        "recording": "walk",
        "subject": "Anna",
        "kind": "dynamic",
        "kind_reason": "Nine markers in ten move up to 395 mm; under 15 mm is static.",
        "missing": {"residual": 3},
        "warnings": ["Odd."],
        "notes": ["Plain."],
        "unlabelled": ["*1"],
        "model_outputs": ["LHipAngles"],
    }
    json.dumps(recording.facts)
    assert ingested(replace(reading, screen=("+X", "+Z"))).facts["source"]["screen"] == ["+X", "+Z"]


def test_a_marker_that_was_never_seen_stays_with_a_warning():
    recording = moving()
    recording.positions[:, 4] = np.nan
    result = ingested(reading_of(recording))
    assert result.markers == recording.markers and result.missing[:, 4].all()
    assert result.facts["warnings"] == ["Never seen: M4."]


def test_numbers_that_stand_for_missing_samples_are_missing():
    recording = moving()
    recording.positions[20:35, 2] = 9999.0
    result = ingested(replace(reading_of(recording, missing={"residual": 3}), unit="cm"))
    assert np.flatnonzero(result.missing[:, 2]).tolist() == list(range(20, 35)) and result.missing.sum() == 15
    assert result.facts["missing"] == {"residual": 3, "placeholder": 15}
    assert result.facts["warnings"] == ["15 samples are 999.9 in all three coordinates and count as missing: M2."]


def test_computed_points_are_left_alone():
    recording = replace(moving(), markers=("LASI", "LHJC", "LFEO", "LFEA", "LFEL", "LFEP", "C7", "RFEO", "RFEA", "COM"))
    result = ingest(
        reading_of(recording, model_outputs=("LHipAngles",)),
        source="walk.c3d",
        recording="walk",
        subject="Anna",
        kind="auto",
        options=IngestOptions(),
    )
    assert result.markers == ("LASI", "C7", "RFEO", "RFEA")
    assert result.facts["source"]["columns"] == [0, 6, 7, 8]
    assert result.facts["model_outputs"] == ["LHipAngles", "LHJC", "LFEO", "LFEA", "LFEL", "LFEP", "COM"]
    np.testing.assert_array_equal(result.positions, recording.positions[:, [0, 6, 7, 8]])


def test_no_marker_ever_seen():
    recording = moving()
    recording.positions[:] = np.nan
    with pytest.raises(BadRecording, match=r"walk\.c3d has no 3-D data.*every sample"):
        ingested(reading_of(recording))
    nothing = Recording((), np.empty((300, 0, 3)), 100.0)
    with pytest.raises(
        BadRecording, match=r"no labelled markers, only 1 unlabelled trajectories and 2 model outputs or computed"
    ):
        ingested(reading_of(nothing, unlabelled=("*0",), model_outputs=("A", "B")))
    with pytest.raises(BadRecording, match="no labelled markers; leave"):
        ingested(reading_of(nothing))


@pytest.mark.parametrize("rate", [0.0, -50.0, math.nan, math.inf, 1e-30, 0.9, 1e30])
def test_an_impossible_rate(rate):
    with pytest.raises(BadRecording, match=r"walk\.c3d has no usable rate.*recordings table"):
        ingested(reading_of(replace(moving(), rate=rate)))


def test_the_table_takes_precedence_in_what_is_static():
    assert kind(moving(amplitude=1), stated="dynamic") == ("dynamic", "The recordings table says so.")
    assert kind(moving(), "static01", "dynamic")[0] == "dynamic"
    assert kind(moving(), stated="static")[0] == "static"


@pytest.mark.parametrize("name", ["Static 01", "subject_STATIC", "cal", "Anna_Cal02"])
def test_names_of_static_recordings(name):
    decided, reason = kind(moving(), name)
    assert decided == "static" and name in reason


@pytest.mark.parametrize("name", ["vertical", "calf raise", "walk", "recal3"])
def test_names_of_dynamic_recordings(name):
    assert kind(moving(), name)[0] == "dynamic"


def test_a_recording_without_motion_is_static():
    decided, reason = kind(moving(amplitude=10))
    assert decided == "static" and "in 3 s; under 15 mm" in reason and "write dynamic" in reason


@pytest.mark.parametrize(("frames", "decided"), [(1, "dynamic"), (27, "dynamic"), (99, "dynamic"), (100, "static")])
def test_little_motion_in_a_short_recording_does_not_make_it_static(frames, decided):
    short = moving(frames, amplitude=10)
    assert kind(short)[0] == decided
    assert ("too short" in kind(short)[1]) == (decided == "dynamic")
    assert kind(short, "static01")[0] == kind(short, stated="static")[0] == "static"


def test_motion_is_that_of_the_ninth_marker_in_ten_without_outliers():
    recording = moving(300, 11, 10.0)
    recording.positions[:, 10, 0] *= 5
    recording.positions[7, :, :] += 1000
    recording.positions[100:150, 3] = np.nan
    recording.positions[:, 5] = np.nan
    expected = 10 * np.sin(np.pi / 2 * 0.9)
    assert motion_mm(recording) == pytest.approx(expected, rel=0.03)
