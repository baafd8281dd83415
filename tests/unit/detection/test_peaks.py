"""Isolated peaks against the neighbours: exactly these intervals on the synthetic walker."""

from dataclasses import replace

import numpy as np

from support.signals import detect, put

# At the start, in the middle, before and after a gap, at the end.
PLACES = [
    ("LWRA", 0, 1),
    ("C7", 400, 403),
    ("LELB", 595, 600),
    ("LELB", 620, 622),
    ("RKNE", 800, 801),
    ("RASI", 1197, 1200),
]


def test_found_on_the_walker_and_not_attributed_to_neighbours(walker):
    recording = put(walker.recording, PLACES, lambda length: np.ones((length, 1)) * [12, 4, -9])
    recording.positions[600:620, recording.markers.index("LELB")] = np.nan
    found, _ = detect(recording, only=("peaks",))
    assert [(e.marker, e.start, e.stop) for e in found["peaks"]] == sorted(PLACES)
    assert all("x" in e.axes and e.score >= 1 for e in found["peaks"])


def test_three_siblings_with_a_peak_at_once(walker):
    recording, places = walker.recording, []
    for marker, size in (("RASI", [8, 3, -6]), ("LASI", [-4, 9, 3]), ("LPSI", [5, -7, 6])):
        own = [(marker, start, start + 3) for start in (300, 700)]
        recording = put(recording, own, lambda length, size=size: np.ones((length, 1)) * size)
        places += own
    found, _ = detect(recording, only=("peaks",))
    assert [(e.marker, e.start, e.stop) for e in found["peaks"]] == sorted(places)


def test_a_glitch_of_all_markers_at_once_hides_none_of_them(walker):
    offsets = np.random.default_rng(4).normal(0, 30, (len(walker.recording.markers), 3))
    recording = replace(walker.recording, positions=walker.recording.positions.copy())
    recording.positions[700] += offsets
    found, _ = detect(recording, only=("peaks",))
    assert len(found["peaks"]) > len(recording.markers) / 2
    assert all((e.start, e.stop) == (700, 701) for e in found["peaks"])
