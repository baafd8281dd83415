"""Markers of a jointed body that sit elsewhere from one moment on are found, with moment, amount and what decided."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.events import Event
from markermend.detection.neighbour.lasting.shifts import LastingFinder, not_explained
from markermend.options.detection.displacement import DisplacementOptions
from markermend.options.prediction.local_ridge import LocalRidgeOptions
from markermend.options.shape import ShapeOptions
from support.displaced_bodies import BODY, FRAMES, NAMES, displaced, onset, scene

FINDER = LastingFinder(LocalRidgeOptions(), DisplacementOptions(), ShapeOptions())


def find(positions, *, usual=None):
    return FINDER.find(scene(positions, usual), NAMES)


def test_nothing_where_all_is_well():
    positions = displaced("2b", np.zeros(FRAMES))
    assert find(positions) == []


def test_a_marker_knocked_for_good():
    positions = displaced("2b", onset(1200))
    [event] = find(positions)
    assert (event.marker, event.start, event.stop, event.kind) == ("2b", 1200, FRAMES, "displaced")
    assert event.amount_mm == pytest.approx(17, abs=0.5)
    assert event.reference == "longer part" and event.score > 1


def test_the_moment_may_lie_in_a_gap():
    positions = displaced("1c", onset(1000))
    positions[980:1030, NAMES.index("1c")] = np.nan
    [event] = find(positions)
    assert (event.marker, event.start, event.stop) == ("1c", 1030, FRAMES)


def test_a_marker_that_is_put_back():
    [event] = find(displaced("3a", onset(400, 900)))
    assert (event.marker, event.start, event.stop) == ("3a", 400, 900)


def test_a_marker_that_creeps():
    [event] = find(displaced("2b", onset(900, length=200)))
    assert (event.marker, event.stop, event.kind) == ("2b", FRAMES, "creep")
    assert abs(event.start - 900) <= 30
    assert event.amount_mm == pytest.approx(17, abs=0.5)


def test_a_creep_may_end_and_a_drift_is_none():
    [event] = find(displaced("2b", onset(600, 1200, length=100)))
    assert (event.marker, event.stop, event.kind) == ("2b", 1200, "creep")
    assert abs(event.start - 600) <= 30
    drift = np.zeros(FRAMES)
    drift[600:1000] = np.sin(np.pi * np.arange(400) / 400) ** 2
    assert find(displaced("2b", drift)) == []


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
    assert find(positions) == []


def test_markers_that_shift_together_have_changed_the_segment():
    first, second = (displaced(name, onset(1000), (9.0, 9.0, 0.0)) for name in ("2a", "2b"))
    together = first.copy()
    together[:, NAMES.index("2b")] = second[:, NAMES.index("2b")]
    assert find(together) == []


def test_further_away_than_on_the_segment_is_left_to_other_classes():
    assert find(displaced("2b", onset(1000), (300.0, 0.0, 0.0))) == []


def test_findings_are_explained_by_those_that_cover_half_of_the_longer_or_begin_or_end_in_them():
    lasting, options = Event("2b", 100, 300, 1.0, "x", kind="displaced"), DisplacementOptions()

    def left(start, stop, *, moments, marker="2b"):
        own = Event(marker, start, stop, 1.0, "x")
        return not_explained([own], [lasting], frames=400, moments=moments, options=options) == [own]

    assert not left(120, 280, moments=False) and not left(50, 320, moments=False)
    assert left(150, 200, moments=True) and left(120, 280, moments=True, marker="2a")
    assert left(302, 400, moments=False) and not left(302, 400, moments=True) and left(310, 400, moments=True)
    to_end = replace(lasting, stop=400)
    step = Event("2b", 350, 400, 1.0, "x")
    assert not_explained([step], [to_end], frames=400, moments=True, options=options) == [step]
