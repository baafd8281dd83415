"""Noisy tails beside gaps: found where the evidence is strong, trimmed to the gap, and nowhere else."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core import events
from markermend.detection.tails import detect_tails
from markermend.options.detection.tails import TailsOptions
from markermend.prediction.scene import Scene
from support.signals import RIDGE, neighbours

GAPS = [("LFHD", 300, 320), ("RKNE", 700, 740), ("STRN", 200, 240)]


def detect(recording, near, earlier=()):
    return detect_tails(
        Scene(recording.positions, recording.rate, near),
        markers=recording.markers,
        earlier=events.coordinates(earlier, recording.frames, recording.markers),
        options=TailsOptions(),
        predictor=RIDGE,
    )


def with_gaps(recording, tails=(), seed=4, size=15.0):
    """The recording with gaps, and noise at the places of `tails` (marker, start, stop, side) that grows towards them."""
    positions, rng = recording.positions.copy(), np.random.default_rng(seed)
    for marker, start, stop in GAPS:
        positions[start:stop, recording.markers.index(marker)] = np.nan
    for marker, start, stop, side in tails:
        trajectory = size * np.arange(1, stop - start + 1)[:, None] / (stop - start)
        wander = trajectory * (1 + rng.uniform(0, 0.5, trajectory.shape)) * rng.choice([-1, 1], (len(trajectory), 3))
        positions[start:stop, recording.markers.index(marker)] += wander[::side]
    return replace(recording, positions=positions)


@pytest.fixture(scope="module")
def near(walker):
    return neighbours(walker.recording.positions)


def test_found_on_either_side_and_on_no_other_marker(walker, near):
    tails = [("LFHD", 296, 300, 1), ("RKNE", 740, 746, -1), ("STRN", 195, 200, 1), ("STRN", 240, 242, -1)]
    found = detect(with_gaps(walker.recording, tails), near)
    assert [(event.marker, event.start < start + 3) for event, (_, start, *_) in zip(found, tails, strict=True)] == [
        (marker, True) for marker, *_ in tails
    ]
    for event, (_, start, stop, side) in zip(found, tails, strict=True):
        assert (event.stop == stop) if side > 0 else (event.start == start)
        assert abs(event.start - start) <= 2 and abs(event.stop - stop) <= 2


def test_clean_gaps_have_none(walker, near):
    assert detect(with_gaps(walker.recording), near) == []


def test_without_a_gap_there_is_none(walker, near):
    recording = with_gaps(walker.recording, [("LFHD", 296, 300, 1)])
    positions = np.where(np.isnan(recording.positions), walker.recording.positions, recording.positions)
    assert detect(replace(recording, positions=positions), near) == []


def test_what_begins_earlier_is_no_tail(walker, near):
    """A step that lasts until the gap has no sudden change near it."""
    recording = with_gaps(walker.recording)
    recording.positions[640:700, recording.markers.index("RKNE")] += 20.0
    assert detect(recording, near) == []


def test_a_neighbours_tail_is_not_attributed_to_a_clean_border(walker, near):
    recording = with_gaps(walker.recording, [("LFHD", 294, 300, 1)], size=30)
    other = recording.markers.index("RFHD")
    recording.positions[300:320, other] = np.nan
    assert [event.marker for event in detect(recording, near)] == ["LFHD"]


@pytest.mark.parametrize(("marker", "frame"), [("LTOE", 580), ("LWRA", 813), ("RANK", 949)])
def test_nor_on_one_that_swings(walker, near, marker, frame):
    """Its speed changes within a few frames, but not from one to the next."""
    positions, m = walker.recording.positions.copy(), walker.recording.markers.index(marker)
    positions[frame : frame + 25, m] = np.nan
    for other in near[m][:3]:
        positions[frame - 4 : frame, other] += [15.0, -10.0, 8.0]
    assert detect(replace(walker.recording, positions=positions), near) == []


def test_a_neighbour_that_goes_missing_makes_no_tail(walker, near):
    recording = with_gaps(walker.recording)
    for other in near[recording.markers.index("STRN")][:4]:
        recording.positions[195:260, other] = np.nan
    assert detect(recording, near) == []


def test_next_to_what_was_found_before(walker, near):
    """A claimed stretch makes no gap; where it touches one, the tail ends at it."""
    recording = with_gaps(walker.recording, [("STRN", 192, 196, 1)])
    recording.positions[196:200, recording.markers.index("STRN")] += 40.0
    found = detect(recording, near, [events.Event("STRN", 196, 200, 1.0)])
    assert [(event.marker, event.stop) for event in found] == [("STRN", 196)]
    alone = with_gaps(walker.recording)
    alone.positions[510:515, recording.markers.index("STRN")] += 40.0
    assert detect(alone, near, [events.Event("STRN", 512, 600, 1.0)]) == []
