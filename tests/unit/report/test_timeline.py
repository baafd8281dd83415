"""Every stretch is on the map, at its place."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.changes import Change, Outcome
from markermend.core.recording import ADOPTED
from markermend.numerics.intervals import runs
from markermend.report import timeline


def test_a_map_shows_every_stretch_at_its_place():
    where = np.zeros(5000, bool)
    where[1000:2000] = where[4999] = True
    assert timeline.path(where) == "M200 0h200M997 0h3"


@pytest.mark.parametrize("frames", [1, 7, 999, 1000, 12345])
def test_no_frame_is_lost_on_a_map(frames):
    where = np.random.default_rng(frames).random(frames) < 0.02
    where[-1] = True
    drawn = np.zeros(timeline.WIDTH, bool)
    for stroke in timeline.path(where).split("M")[1:]:
        start, length = stroke.split(" 0h")
        drawn[int(start) : int(start) + int(length)] = True
    for start, stop in runs(where):
        assert drawn[start * timeline.WIDTH // frames]
        assert drawn[min(timeline.WIDTH - 1, (stop * timeline.WIDTH - 1) // frames)]


def test_ticks_are_round_times_with_the_capture_programs_frames(before):
    ticks = timeline.ticks(replace(before, first_frame=705), 5)
    assert [tick["second"] for tick in ticks] == [0.0, 0.2, 0.4, 0.6, 0.8]
    assert [tick["frame"] for tick in ticks] == [705, 707, 709, 711, 713]


def test_what_was_adopted_and_what_was_left_is_on_the_map(before, after):
    missing, origin = before.missing.copy(), after.origin.copy()
    frame, marker = np.argwhere(missing & ~after.missing)[0]
    origin[frame, marker] = ADOPTED
    left = [Change(before.markers[0], 4, 5, ("shift",), Outcome.LEFT)]
    drawn = timeline.lines(before, replace(after, origin=origin), left)
    assert f"M{frame * timeline.WIDTH // before.frames} 0h" in drawn[marker]["filled"]
    assert [line["left"] for line in drawn] == [timeline.path(np.arange(before.frames) == 4)] + [""] * (len(drawn) - 1)
