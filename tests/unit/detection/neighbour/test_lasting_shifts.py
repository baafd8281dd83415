"""Markers of a jointed body that sit elsewhere from one moment on are found, with moment, amount and what decided."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.detection.neighbour.lasting_shifts import LastingFinder
from markermend.options.detection.displacement import DisplacementOptions
from markermend.options.prediction import LocalRidgeOptions
from markermend.options.shape import ShapeOptions
from support.displaced_bodies import BODY, FRAMES, NAMES, displaced, onset, scene

FINDER = LastingFinder(LocalRidgeOptions(), DisplacementOptions(), ShapeOptions())


def find(positions, *, usual=None, sudden=True):
    return FINDER.find(scene(positions, usual), NAMES, sudden=sudden)


def test_nothing_where_all_is_well():
    positions = displaced("2b", np.zeros(FRAMES))
    assert find(positions) == find(positions, sudden=False) == []


def test_a_marker_knocked_for_good():
    positions = displaced("2b", onset(1200))
    [event] = find(positions)
    assert (event.marker, event.start, event.stop, event.kind) == ("2b", 1200, FRAMES, "displaced")
    assert event.amount_mm == pytest.approx(17, abs=0.5)
    assert event.reference == "longer part" and event.score > 1
    assert find(positions, sudden=False) == []


def test_the_moment_may_lie_in_a_gap():
    positions = displaced("1c", onset(1000))
    positions[980:1030, NAMES.index("1c")] = np.nan
    [event] = find(positions)
    assert (event.marker, event.start, event.stop) == ("1c", 1030, FRAMES)


def test_a_marker_that_is_put_back():
    [event] = find(displaced("3a", onset(400, 900)))
    assert (event.marker, event.start, event.stop) == ("3a", 400, 900)


def test_a_marker_that_creeps():
    positions = displaced("2b", onset(900, length=200))
    assert find(positions) == []
    [event] = find(positions, sudden=False)
    assert (event.marker, event.stop, event.kind) == ("2b", FRAMES, "creep")
    assert abs(event.start - 900) <= 30
    assert event.amount_mm == pytest.approx(17, abs=0.5)


@pytest.mark.parametrize(
    ("start", "usual", "place", "reference"),
    [
        (300, False, (0, 300), "longer part"),
        (750, False, (750, FRAMES), "undecided"),
        (500, False, (500, FRAMES), "undecided"),
        (1000, False, (1000, FRAMES), "longer part"),
        (400, True, (400, FRAMES), "usual distances"),
    ],
)
def test_which_place_is_right(start, usual, place, reference):
    clean = displaced("2b", np.zeros(FRAMES))
    [event] = find(displaced("2b", onset(start)), usual=clean if usual else None)
    assert (event.start, event.stop, event.reference) == (*place, reference)


def test_a_change_of_pose_for_good_is_none():
    still = np.tile(BODY[200], (FRAMES // 2, 1, 1)), np.tile(BODY[460], (FRAMES - FRAMES // 2, 1, 1))
    positions = np.concatenate(still) + np.random.default_rng(1).normal(0, 0.4, BODY.shape)
    assert find(positions) == find(positions, sudden=False) == []


def test_markers_that_shift_together_have_changed_the_segment():
    first, second = (displaced(name, onset(1000), (9.0, 9.0, 0.0)) for name in ("2a", "2b"))
    together = first.copy()
    together[:, NAMES.index("2b")] = second[:, NAMES.index("2b")]
    assert find(together) == []


def test_further_away_than_on_the_segment_is_left_to_other_classes():
    assert find(displaced("2b", onset(1000), (300.0, 0.0, 0.0))) == []


def test_a_step_that_explains_it_is_not_found_twice():
    [event] = find(displaced("2b", onset(1000)))
    own = replace(event, kind=None)
    assert FINDER.added_to([own], scene(displaced("2b", onset(1000))), NAMES, sudden=True) == [own]
