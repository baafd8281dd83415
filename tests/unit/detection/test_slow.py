"""Slow changes against the neighbours, on the left half of the synthetic walker: the right limbs would add nothing."""

from dataclasses import replace

import numpy as np
import pytest

from support.signals import detect, neighbours, put

PLACES = [("LTIAP", 182, 243), ("LANK", 386, 457), ("LUPA", 920, 989)]


@pytest.fixture(scope="module")
def half(walker):
    recording = walker.recording
    left = [
        m
        for m, segment in enumerate(walker.segments)
        if not segment.startswith("right") and not segment.endswith("hand")
    ]
    return replace(recording, positions=recording.positions[:, left], markers=tuple(recording.markers[m] for m in left))


def triangle(length, direction):
    return 10 * (1 - np.abs(2 * (np.arange(length) + 0.5) / length - 1))[:, None] * direction


def slow_changes(recording):
    return detect(recording, only=("slow",))[0]["slow"]


def test_found_and_not_attributed_to_neighbours(half):
    recording = put(half, PLACES, lambda length: triangle(length, [3, 1, -2]))
    found = slow_changes(recording)
    assert [event.marker for event in found] == sorted(marker for marker, _, _ in PLACES)
    for event, (_, start, stop) in zip(found, sorted(PLACES), strict=True):
        assert abs(event.start - start) <= 10
        assert abs(event.stop - stop) <= 10


def test_nothing_where_all_is_well_or_something_does_not_come_back(half):
    assert detect(half) == ({"peaks": [], "noise": [], "steps": [], "slow": []}, [])
    shifted = put(half, [("LANK", 386, 1200)], lambda length: np.ones((length, 1)) * [30, 10, -20])
    assert slow_changes(shifted) == []


def without_neighbours(recording, places, ranks):
    """The recording with a gap in the neighbours of some ranks from the middle of each place to well after it."""
    positions, near = recording.positions.copy(), neighbours(recording.positions)
    for marker, start, stop in places:
        own = near[recording.markers.index(marker)]
        positions[(start + stop) // 2 : stop + 60, own[ranks]] = np.nan
    return replace(recording, positions=positions)


@pytest.mark.parametrize("ranks", [[3], [1, 4, 8]])
def test_found_though_neighbours_come_and_go(half, ranks):
    assert slow_changes(without_neighbours(half, PLACES, ranks)) == []
    changed = put(half, PLACES, lambda length: triangle(length, [3, 1, -2]))
    found = slow_changes(without_neighbours(changed, PLACES, ranks))
    assert [event.marker for event in found] == sorted(marker for marker, _, _ in PLACES)
    for event, (_, start, stop) in zip(found, sorted(PLACES), strict=True):
        assert abs(event.start - start) <= 12
        assert abs(event.stop - stop) <= 12


@pytest.mark.parametrize("place", [("LUPA", 900, 1040), ("LHEE", 600, 750)])
def test_a_gross_drift_is_found_amid_motion(half, place):
    [event] = slow_changes(put(half, [place], lambda length: triangle(length, [9, 3, -6])))
    marker, start, stop = place
    assert event.marker == marker
    assert abs(event.start - start) <= 20
    assert abs(event.stop - stop) <= 20
