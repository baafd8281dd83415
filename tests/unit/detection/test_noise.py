"""Heavy noise against the neighbours: these stretches on the synthetic walker."""

import numpy as np

from support.signals import detect, put

PLACES = [("LWRA", 100, 150), ("C7", 400, 440), ("LELB", 540, 600), ("RKNE", 800, 830), ("RASI", 1150, 1200)]


def test_found_on_the_walker_and_not_attributed_to_neighbours(walker):
    rng = np.random.default_rng(6)
    recording = put(walker.recording, PLACES, lambda length: rng.normal(0, 6, (length, 3)))
    recording.positions[600:620, recording.markers.index("LELB")] = np.nan
    found, _ = detect(recording, only=("noise",))
    assert [e.marker for e in found["noise"]] == sorted(marker for marker, _, _ in PLACES)
    for event, (_, start, stop) in zip(found["noise"], sorted(PLACES), strict=True):
        assert abs(event.start - start) <= 6
        assert abs(event.stop - stop) <= 4
