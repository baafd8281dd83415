"""Exchanges in about half of the only recording: left as they are, and warned of with markers and frames."""

from dataclasses import replace

import numpy as np
import pytest

from markermend import api
from markermend.core.events import Event
from markermend.detection.labelling.open_exchanges import without_open
from markermend.detection.labels import find_labels, label_warnings
from markermend.mesh.inference import infer_mesh
from markermend.options.detection.labels import LabelsOptions
from markermend.options.mesh import MeshOptions
from markermend.prediction.scene import Scene

OPTIONS = LabelsOptions()


def exchanged(recording, pairs, start):
    positions = recording.positions.copy()
    for pair in pairs:
        own = [recording.markers.index(name) for name in pair]
        positions[start:, own] = positions[start:, own[::-1]]
        positions[start - 10 : start, own] = np.nan
    return replace(recording, positions=positions)


def look(recording, *others):
    named = [replace(one, facts={"recording": f"r{k}"}) for k, one in enumerate((recording, *others))]
    scene = Scene.of(recording, infer_mesh(named, options=MeshOptions()))
    found = find_labels(scene, markers=recording.markers, options=OPTIONS)
    return found.events, label_warnings(scene, found, markers=recording.markers, options=OPTIONS, first_frame=1)


@pytest.mark.parametrize("start", [540, 650])
@pytest.mark.parametrize("names", [("THI",), ("KNE", "TIB", "ANK", "HEE", "TOE")])
def test_about_half_is_left_and_warned_of(walker, names, start):
    recording = exchanged(walker.recording, [(f"L{name}", f"R{name}") for name in names], start)
    found, warnings = look(recording)
    assert found == []
    assert len(warnings) == 1
    assert all(f"{side}{names[0]}" in warnings[0] for side in "LR")
    assert f"(frame {start})" in warnings[0]
    assert ("to the end" in warnings[0]) == (start > 600)
    assert warnings[0].endswith(": nothing says which of the two is right")


@pytest.mark.parametrize("start", [540, 650])
def test_pairs_that_are_no_counterparts_are_warned_of_as_well(walker, start):
    recording = exchanged(walker.recording, [("LTHI", "LKNE")], start)
    found, (warning,) = look(recording)
    assert found == []
    assert warning.startswith("LKNE and LTHI may be exchanged ") and any(
        f"(frame {frame})" in warning for frame in (start, start - 10)
    )


def test_what_is_undone_in_nearly_half_is_warned_of(walker):
    positions = walker.recording.positions.copy()
    pair = [walker.recording.markers.index(name) for name in ("LTHI", "LKNE")]
    positions[660:, pair] = positions[660:, pair[::-1]]
    found, warnings = look(replace(walker.recording, positions=positions))
    assert {(event.marker, event.start, event.stop) for event in found} == {("LTHI", 660, 1200), ("LKNE", 660, 1200)}
    (warning,) = warnings
    assert warning.startswith("LKNE and LTHI are exchanged from 6.6 s (frame 660) to the end, or else in the rest")


def test_other_recordings_tell(walker):
    recording = exchanged(walker.recording, [("LTHI", "RTHI")], 500)
    other = replace(walker.recording, positions=walker.recording.positions[::2])
    found, warnings = look(recording, other, other)
    assert {(event.marker, event.start, event.stop) for event in found} == {("LTHI", 500, 1200), ("RTHI", 500, 1200)}
    assert warnings == []


def test_nothing_open_where_labels_are_right(walker):
    assert look(walker.recording) == ([], [])


def test_what_was_seen_from_frame_to_frame_stays():
    sudden = [Event("A", 40, 100, 2.0, partner="B"), Event("B", 40, 100, 2.0, partner="A")]
    level = [Event("C", 40, 100, 2.0, partner="D"), Event("D", 40, 100, 2.0, partner="C")]
    short = [Event("E", 70, 100, 2.0, partner="F"), Event("F", 70, 100, 2.0, partner="E")]
    assert without_open([*sudden, *level, *short], sudden, np.ones(100, bool), 0.4) == [*sudden, *short]


def test_the_interface_warns_alike(walker):
    recording = exchanged(walker.recording, [("LTHI", "RTHI")], 650)
    _, warnings = look(recording)
    assert warnings
    options = api.Options.read({"detect": ["labels"]})
    cleaned = api.clean(replace(recording, facts={"recording": "r0", **recording.facts}), options=options)
    assert set(warnings) <= set(cleaned.warnings)
