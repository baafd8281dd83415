"""Slow changes against the neighbours, on the synthetic walker."""

from dataclasses import replace

import numpy as np

from signals import detect, neighbours, put

PLACES = [("LTIAP", 182, 243), ("LANK", 386, 457), ("LUPA", 920, 989)]


def triangle(length, height=10.0):
    return height * (1 - np.abs(2 * (np.arange(length) + 0.5) / length - 1))


def test_found_on_the_walker_and_not_blamed_on_neighbours(walker):
    recording = put(walker.recording, PLACES, lambda length: triangle(length)[:, None] * [3, 1, -2])
    found, _ = detect(recording, only=("slow",))
    assert [e.marker for e in found["slow"]] == sorted(marker for marker, _, _ in PLACES)
    for event, (_, start, stop) in zip(found["slow"], sorted(PLACES), strict=True):
        assert abs(event.start - start) <= 10
        assert abs(event.stop - stop) <= 10


def test_what_does_not_come_back_is_no_slow_change(walker):
    recording = put(walker.recording, [("LANK", 386, 1200)], lambda length: np.ones((length, 1)) * [30, 10, -20])
    found, _ = detect(recording, only=("slow",))
    assert found["slow"] == []


def test_nothing_on_the_clean_walker(walker):
    assert detect(walker.recording) == ({"peaks": [], "noise": [], "steps": [], "slow": []}, [])


def test_where_a_neighbour_comes_or_goes_nothing_is_found(walker):
    marker = PLACES[0][0]
    recording = put(walker.recording, PLACES[:1], lambda length: triangle(length)[:, None] * [3, 1, -2])
    near = neighbours(recording.positions)[recording.markers.index(marker)]
    for first, last, expected in ((200, 220, []), (800, 900, [marker])):
        positions = recording.positions.copy()
        positions[first:last, near[3]] = np.nan
        found, _ = detect(replace(recording, positions=positions), only=("slow",))
        assert [event.marker for event in found["slow"]] == expected
