"""Heavy noise against the neighbours: these stretches on the synthetic walker."""

from dataclasses import replace

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


def test_jitter_is_found_although_no_single_change_is_sudden(walker):
    rng = np.random.default_rng(8)
    places = [("C7", 300, 380), ("LKNE", 620, 690), ("RSHO", 900, 990)]
    recording = put(walker.recording, places, lambda length: rng.normal(0, 2.0, (length, 3)))
    found, _ = detect(recording, only=("noise",))
    assert [e.marker for e in found["noise"]] == sorted(marker for marker, _, _ in places)
    for event, (_, start, stop) in zip(found["noise"], sorted(places), strict=True):
        assert start - 12 <= event.start <= start + 3
        assert stop - 3 <= event.stop <= stop + 12


def test_heavy_noise_ends_with_its_sudden_changes_though_it_is_jitter_too(walker):
    rng = np.random.default_rng(10)
    places = [("C7", 300, 380), ("RSHO", 900, 990)]
    recording = put(
        walker.recording, places, lambda length: rng.choice([-1, 1], (length, 3)) * rng.uniform(9, 15, (length, 3))
    )
    found, _ = detect(recording, only=("noise",))
    assert [(e.marker, e.start, e.stop) for e in found["noise"]] == places


def test_wobble_is_found(walker):
    places = [("C7", 300, 430), ("RSHO", 800, 920)]

    def wobble(length):
        return 5 * np.sin(2 * np.pi * 8.0 * np.arange(length) / 100)[:, None] * np.array([0.6, 0.0, 0.8])

    found, _ = detect(put(walker.recording, places, wobble), only=("noise",))
    assert [e.marker for e in found["noise"]] == sorted(marker for marker, _, _ in places)
    for event, (_, start, stop) in zip(found["noise"], sorted(places), strict=True):
        assert abs(event.start - start) <= 20 and abs(event.stop - stop) <= 20


def test_what_shakes_all_markers_is_no_noise(walker):
    """The body is shaken: the neighbours move alike."""
    shake = 6 * np.sin(2 * np.pi * 9.0 * np.arange(120) / 100)[:, None]
    rng = np.random.default_rng(9)
    positions = walker.recording.positions.copy()
    for m in range(positions.shape[1]):
        positions[500:620, m] += shake * np.array([0.6, 0.0, 0.8]) * rng.uniform(0.8, 1.2)
    found, _ = detect(replace(walker.recording, positions=positions), only=("noise",))
    assert found["noise"] == []
    assert detect(walker.recording, only=("noise",))[0]["noise"] == []
