"""Steps against the neighbours: exactly these intervals and open steps on the synthetic walker."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.options.detection.steps import StepsOptions
from support.signals import detect, put

PLACES = [("LWRA", 100, 150), ("C7", 400, 425), ("RKNE", 700, 860), ("RASI", 900, 908)]


def test_found_on_the_walker_and_not_attributed_to_neighbours(walker):
    recording = put(walker.recording, PLACES, lambda length: np.ones((length, 1)) * [8, 3, -6])
    found, left = detect(recording, only=("steps",))
    assert [(e.marker, e.start, e.stop) for e in found["steps"]] == sorted(PLACES)
    assert left == []


@pytest.mark.parametrize("siblings", [("C7", "T10", "CLAV"), ("LSHO", "RBAK", "STRN")])
def test_three_siblings_that_step_at_once(walker, siblings):
    recording, places = walker.recording, []
    for marker, jump in zip(siblings, ([8, 3, -6], [-4, 9, 3], [5, -7, 6]), strict=True):
        own = [(marker, start, start + 70) for start in (300, 700)]
        recording = put(recording, own, lambda length, jump=jump: np.ones((length, 1)) * jump)
        places += own
    found, left = detect(recording, only=("steps",))
    assert [(e.marker, e.start, e.stop) for e in found["steps"]] == sorted(places)
    assert left == []


def test_an_open_step_of_the_walker_has_its_size(walker):
    recording = put(walker.recording, [("C7", 1180, 1200)], lambda length: np.ones((length, 1)) * [12, 0, 9])
    options = replace(StepsOptions(), recording_end_factor=100)
    found, left = detect(recording, only=("steps",), options=options)
    assert found["steps"] == []
    [step] = left
    assert (step.marker, step.frame) == ("C7", 1180)
    assert step.size_mm == pytest.approx(15, rel=0.2)


def test_a_jump_without_return_is_a_displaced_marker(walker):
    recording = put(walker.recording, [("C7", 700, 1200)], lambda length: np.ones((length, 1)) * [12, 0, 9])
    found, left = detect(recording, only=("steps",))
    [event] = found["steps"]
    assert (event.marker, event.start, event.stop, event.kind) == ("C7", 700, 1200, "displaced")
    assert event.amount_mm == pytest.approx(15, abs=0.5)
    assert left == []


def test_two_jumps_without_a_level_in_between_are_left_open(walker):
    t = np.arange(100) / 100
    drift = np.outer(1 - 2 * np.sin(np.pi * t) ** 2, [8, 3, -6])  # back beyond the adjacent trajectory, smoothly
    found, left = detect(put(walker.recording, [("C7", 400, 500)], lambda _: drift), only=("steps",))
    assert found["steps"] == []
    assert [(step.marker, step.frame) for step in left] == [("C7", 400), ("C7", 500)]


@pytest.mark.parametrize("ramp", [1, 2])
def test_dips_with_ramps_of_a_few_frames(walker, ramp):
    dip = np.minimum(np.arange(1, 41), np.arange(40, 0, -1)) / (ramp + 1)
    shape = np.outer(np.minimum(dip, 1), [8, 3, -6])
    found, left = detect(put(walker.recording, [("C7", 400, 440)], lambda _: shape), only=("steps",))
    [step] = found["steps"]
    assert step.marker == "C7" and abs(step.start - 400) <= 1 and abs(step.stop - 440) <= 1
    assert left == []


def test_two_jumps_are_a_step_together_where_neither_is_alone(walker):
    places = [("LELB", 560, 600), ("RKNE", 700, 760)]
    recording = put(walker.recording, places, lambda length: np.ones((length, 1)) * [2.9, 1.1, -2.2])
    found, left = detect(recording, only=("steps",))
    assert [(e.marker, e.start, e.stop) for e in found["steps"]] == places
    assert all(1 <= e.score < 1.3 for e in found["steps"])
    assert left == []
    unpaired = put(walker.recording, [("RKNE", 700, 1200)], lambda length: np.ones((length, 1)) * [2.9, 1.1, -2.2])
    assert detect(unpaired, only=("steps",)) == ({"steps": []}, [])


@pytest.mark.parametrize(
    "key",
    [
        "ramp_cost",
        "displaced_cost_per_s",
        "floor_mm",
        "attribution_rounds",
        "attribution_neighbours",
    ],
)
def test_the_lowest_options_still_find_a_clear_step(walker, key):
    lowest = replace(StepsOptions(), **{key: 0})
    positions = walker.recording.positions[:500, :12]
    few = replace(walker.recording, markers=walker.recording.markers[:12], positions=positions)
    place = (few.markers[4], 200, 260)
    found, _ = detect(
        put(few, [place], lambda length: np.ones((length, 1)) * [30, 10, -20]), only=("steps",), options=lowest
    )
    assert place in [(e.marker, e.start, e.stop) for e in found["steps"]]


def test_steps_that_gaps_and_the_end_cut_short(walker):
    cut = [("LELB", 560, 600), ("RKNE", 1150, 1200), ("RASI", 820, 870)]
    recording = put(walker.recording, cut, lambda length: np.ones((length, 1)) * [8, 3, -6])
    for marker, start, stop in (("LELB", 600, 620), ("RASI", 800, 820)):
        recording.positions[start:stop, recording.markers.index(marker)] = np.nan
    found, left = detect(recording, only=("steps",))
    assert [(e.marker, e.start, e.stop) for e in found["steps"]] == sorted(cut)
    assert left == []


def test_a_step_that_noise_covers_to_its_end(walker):
    flicker = np.random.default_rng(4).normal(0, 8, (60, 3))
    recording = put(walker.recording, [("C7", 400, 500)], lambda length: np.ones((length, 1)) * [8, 3, -6])
    found, _ = detect(put(recording, [("C7", 440, 500)], lambda _: flicker), only=("noise", "steps"))
    [noise], [step] = found["noise"], found["steps"]
    assert (step.marker, step.start, step.stop) == ("C7", 400, noise.start)
    assert abs(noise.start - 440) <= 1


def test_no_step_is_cut_short_where_the_marker_is_not_back_beyond_the_gap(walker):
    recording = put(walker.recording, [("LELB", 560, 1200)], lambda length: np.ones((length, 1)) * [8, 3, -6])
    recording.positions[600:620, recording.markers.index("LELB")] = np.nan
    found, left = detect(recording, only=("steps",))
    assert found["steps"] == []
    assert ("LELB", 560) in [(step.marker, step.frame) for step in left]


def test_a_flicker_between_two_levels_is_found_stretch_by_stretch(walker):
    places = [("C7", 400, 420), ("C7", 426, 440), ("C7", 446, 453), ("C7", 460, 480)]
    found, _ = detect(put(walker.recording, places, lambda length: np.ones((length, 1)) * [8, 3, -6]), only=("steps",))
    assert [(e.marker, e.start, e.stop) for e in found["steps"]] == places


def test_the_threshold_rises_with_the_acceleration_of_the_neighbours(walker):
    """All markers change their velocity at once where one of them jumps."""
    recording = put(walker.recording, [("C7", 400, 430)], lambda length: np.ones((length, 1)) * [8, 0, 0])
    assert len(detect(recording, only=("steps",))[0]["steps"]) == 1
    t = np.arange(recording.frames)
    recording.positions[:, :, 1] += 30.0 * np.clip(t - 400, 0, 30)[:, None]
    assert detect(recording, only=("steps",))[0]["steps"] == []
    careless = replace(StepsOptions(), clear_acceleration_ratio=0)
    assert len(detect(recording, only=("steps",), options=careless)[0]["steps"]) == 1
