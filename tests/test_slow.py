"""Slow changes against the neighbours, on the synthetic walker."""

from dataclasses import replace

import numpy as np

from markermend import slow
from signals import detect, neighbours, put

PLACES = [("STRN", 200, 280), ("C7", 500, 600), ("RKNE", 800, 870)]


def triangle(length, height=10.0):
    return height * (1 - np.abs(2 * (np.arange(length) + 0.5) / length - 1))


def test_found_on_the_walker_and_not_blamed_on_neighbours(walker):
    recording = put(walker.recording, PLACES, lambda length: triangle(length)[:, None] * [3, 1, -2])
    found, _ = detect(recording, only=("slow",))
    assert [e.marker for e in found["slow"]] == sorted(marker for marker, _, _ in PLACES)
    for event, (_, start, stop) in zip(found["slow"], sorted(PLACES), strict=True):
        assert start - 5 <= event.start <= start + 25
        assert stop - 25 <= event.stop <= stop + 5


def test_a_body_that_fits_badly_as_a_whole_sets_the_scale():
    size = np.ones((100, 4))
    size[50] = 6
    near = [np.delete(np.arange(4), m) for m in range(4)]
    assert slow.company(size, near, near=3)[[20, 50], 0].tolist() == [1, 6]


def test_nothing_on_the_clean_walker(walker):
    assert detect(walker.recording) == ({"peaks": [], "noise": [], "steps": [], "slow": []}, [])


def test_where_a_neighbour_comes_or_goes_nothing_is_found(walker):
    recording = put(walker.recording, [("STRN", 200, 280)], lambda length: triangle(length)[:, None] * [3, 1, -2])
    near = neighbours(recording.positions)[recording.markers.index("STRN")]
    for first, last, expected in ((230, 250, []), (0, 1200, ["STRN"]), (800, 900, ["STRN"])):
        positions = recording.positions.copy()
        positions[first:last, near[3]] = np.nan
        found, _ = detect(replace(recording, positions=positions), only=("slow",))
        assert [event.marker for event in found["slow"]] == expected
