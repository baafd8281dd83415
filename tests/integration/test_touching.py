"""Sudden artifacts that touch something: gaps, the ends, missing markers, and artifacts of another class."""

import numpy as np

from markermend.core import events
from support.signals import detect, put

SUDDEN = ("peaks", "noise", "steps")


def shift(length):
    return np.ones((length, 1)) * [9, 4, -8]


def pulse(length):
    return shift(length) * np.sin(np.pi * (np.arange(length) + 0.5) / length)[:, None]


def jitter(length):
    return np.random.default_rng(length).normal(0, 6, (length, 3))


def places(found, kind):
    return [(event.marker, event.start, event.stop) for event in found[kind]]


def without(recording, gaps):
    for marker, start, stop in gaps:
        recording.positions[start:stop, recording.markers.index(marker)] = np.nan
    return recording


def test_peaks_up_to_gaps_and_ends(walker):
    peaks = [("LELB", 596, 600), ("LELB", 620, 623), ("C7", 299, 300), ("C7", 310, 311), ("RKNE", 0, 2)]
    peaks += [("RKNE", 1195, 1200), ("LTOE", 1198, 1200), ("RASI", 0, 5)]
    recording = without(put(walker.recording, peaks, shift), [("LELB", 600, 620), ("C7", 300, 310)])
    found, _ = detect(recording, only=SUDDEN)
    assert places(found, "peaks") == sorted(peaks)
    assert found["noise"] == found["steps"] == []


def test_noise_and_steps_next_to_gaps_and_ends(walker):
    noise = [("LELB", 560, 600), ("C7", 310, 350)]
    steps = [("RKNE", 10, 50), ("RASI", 750, 790), ("LTOE", 1150, 1190)]
    recording = put(put(walker.recording, noise, jitter), steps, shift)
    found, _ = detect(without(recording, [("LELB", 600, 620), ("C7", 300, 310), ("RASI", 800, 820)]), only=SUDDEN)
    assert places(found, "steps") == sorted(steps)
    assert [event.marker for event in found["noise"]] == ["C7", "LELB"]
    for event, (_, start, stop) in zip(found["noise"], sorted(noise), strict=True):
        assert abs(event.start - start) <= 3
        assert abs(event.stop - stop) <= 3


def test_peaks_on_a_slow_change_and_amid_a_step(walker):
    peaks = [("C7", 448, 452), ("RKNE", 850, 853)]
    recording = put(walker.recording, [("C7", 400, 500)], lambda length: 1.5 * pulse(length))
    recording = put(recording, [("RKNE", 800, 960)], shift)
    found, _ = detect(put(recording, peaks, lambda length: -2 * pulse(length)), only=SUDDEN)
    assert places(found, "peaks") == peaks
    assert {marker for marker, _, _ in places(found, "steps")} == {"RKNE"}
    covered = events.mask(found["steps"], recording.frames, recording.markers)
    assert covered[800:960].sum() >= 150
    assert covered.sum() <= 160


def test_noise_on_a_step_is_claimed_whole(walker):
    recording = put(put(walker.recording, [("C7", 400, 500)], shift), [("C7", 430, 480)], jitter)
    found, _ = detect(recording, only=SUDDEN)
    claimed = np.any([events.mask(found[kind], recording.frames, recording.markers) for kind in SUDDEN], axis=0)
    assert claimed[430:480, recording.markers.index("C7")].mean() > 0.95
    assert not claimed[:395].any()
    assert not claimed[505:].any()


def test_with_a_fifth_missing_peaks_are_found_and_nothing_else(walker):
    peaks = [("LWRA", 102, 105), ("RKNE", 305, 308), ("C7", 500, 504), ("RASI", 803, 806), ("LTOE", 1003, 1005)]
    recording = put(walker.recording, peaks, shift)
    kept = {recording.markers.index(marker): (start - 30, stop + 30) for marker, start, stop in peaks}
    rng = np.random.default_rng(8)
    while recording.missing.mean() < 0.2:
        m, start = int(rng.integers(len(recording.markers))), int(rng.integers(0, recording.frames))
        stop = start + int(rng.integers(150, 300))
        low, high = kept.get(m, (0, 0))
        if not (start < high and low < stop):
            recording.positions[start:stop, m] = np.nan
    found, _ = detect(recording, only=SUDDEN)
    assert places(found, "peaks") == sorted(peaks)
    assert found["noise"] == found["steps"] == []
