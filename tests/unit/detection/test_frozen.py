"""Frozen markers: found where the neighbours show that the marker moved on, and nowhere else."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core import events
from markermend.detection.frozen import detect_frozen
from markermend.options.detection.frozen import FrozenOptions
from markermend.prediction.scene import Scene
from support.signals import RIDGE, neighbours

PLACES = [("LFIN", 500, 506), ("RKNE", 300, 370), ("STRN", 200, 230)]


def detect(recording, near=None, earlier=None):
    scene = Scene(recording.positions, recording.rate, neighbours(recording.positions) if near is None else near)
    return detect_frozen(
        scene,
        markers=recording.markers,
        earlier=np.zeros(recording.positions.shape, bool) if earlier is None else earlier,
        options=FrozenOptions(),
        predictor=RIDGE,
    )


def frozen(recording, places):
    """The recording with the sample before each place (marker, start, stop) repeated over it."""
    positions = recording.positions.copy()
    for marker, start, stop in places:
        m = recording.markers.index(marker)
        positions[start:stop, m] = positions[start - 1, m]
    return replace(recording, positions=positions)


def places(found):
    return [(event.marker, event.start, event.stop) for event in found]


@pytest.fixture(scope="module")
def near(walker):
    return neighbours(walker.recording.positions)


def test_found_to_the_sample_and_on_no_other_marker(walker, near):
    found = detect(frozen(walker.recording, PLACES), near)
    assert places(found) == PLACES
    assert all(event.score >= 1 and event.axes == "xyz" for event in found)


def test_next_to_a_gap_and_up_to_the_end(walker, near):
    recording = frozen(walker.recording, [("STRN", 200, 230)])
    recording.positions[230:260, recording.markers.index("STRN")] = np.nan
    assert places(detect(recording, near)) == [("STRN", 200, 230)]
    cut = replace(walker.recording, positions=walker.recording.positions[:400])
    assert places(detect(frozen(cut, [("LFIN", 390, 400)]), near)) == [("LFIN", 390, 400)]


def test_a_few_equal_frames_are_none(walker, near):
    assert detect(frozen(walker.recording, [("STRN", 200, 202)]), near) == []


def test_what_was_found_before_is_not_looked_at(walker, near):
    recording = frozen(walker.recording, [("STRN", 200, 230)])
    earlier = events.coordinates([events.Event("STRN", 190, 240, 1.0)], recording.frames, recording.markers)
    assert detect(recording, near, earlier) == []


@pytest.mark.parametrize("step", [0.0, 0.3, 1.0])
def test_coarse_numbers_at_rest_are_none(walker, near, step):
    """While the person stands or sits, whole numbers of steps repeat for many frames."""
    positions = walker.recording.positions
    coarse = np.round(positions / step) * step if step else positions
    recording = replace(walker.recording, positions=coarse)
    repeats = (np.diff(coarse, axis=0) == 0).all(axis=2).sum()
    assert repeats > 1000 or step < 1
    assert detect(recording, near) == []


def test_a_prop_at_rest_and_a_recording_that_stalls_are_none(walker, near):
    positions = walker.recording.positions.copy()
    positions[300:310] = positions[299]  # the capture program repeats whole frames
    assert detect(replace(walker.recording, positions=positions), near) == []
    still = np.repeat(positions[:1], len(positions), axis=0)
    assert detect(replace(walker.recording, positions=still), near) == []
    mixed = np.concatenate([positions, still[:, :4] + 3000.0], axis=1)
    markers = (*walker.recording.markers, "prop1", "prop2", "prop3", "prop4")
    count = len(walker.recording.markers)
    props = [np.array([k for k in range(count, count + 4) if k != m]) for m in range(count, count + 4)]
    assert detect(replace(walker.recording, positions=mixed, markers=markers), [*near, *props]) == []


def test_a_planted_marker_about_which_its_neighbours_turn_is_none(walker, near):
    """The prediction by the neighbours decides, not whether they move."""
    m = walker.recording.markers.index("LFHD")
    hinge = np.array([0.0, 0.0, 1500.0])
    turned = walker.recording.positions - walker.recording.positions[:, m : m + 1] + hinge
    assert detect(replace(walker.recording, positions=turned), near) == []
