"""Level shifts: which edges make one, and which are cut short by a gap or an end."""

import numpy as np
import pytest

from markermend.core.events import Event
from markermend.detection.neighbour.edges import Edge
from markermend.detection.neighbour.level_shifts import LevelShiftFinder, joint_score, shift_fraction
from support.residuals import STEPS

FINDER = LevelShiftFinder(100.0, STEPS)
FRAMES = 400
NOTHING = np.zeros(FRAMES, bool)


def edge(frame, size, score=3.0, axis=0):
    return Edge(frame, np.eye(3)[axis] * size, score)


def level(*shifts):
    """A residual that is displaced along x over some intervals."""
    residual = np.zeros((FRAMES, 3))
    for start, stop, size in shifts:
        residual[start:stop, 0] += size
    return residual


def between(residual, *found, missing=NOTHING):
    events = FINDER.between_edges(residual, list(found), missing=missing, name="A")
    return [(event.start, event.stop) for event in events]


def truncated(residual, *found, missing=NOTHING, others=()):
    events = FINDER.truncated(residual, list(found), list(others), missing=missing, name="A")
    return [(event.start, event.stop) for event in events]


def test_opposite_edges_are_a_level_shift():
    assert between(level((100, 150, 8)), edge(100, 8), edge(150, -8)) == [(100, 150)]


@pytest.mark.parametrize(
    ("residual", "second"),
    [
        (level((100, 150, 8)), edge(150, 8)),  # in the same direction
        (level((100, 150, 8)), edge(150, -8, axis=1)),  # across
        (level((100, 150, 8)), edge(150, -3)),  # too small
        (level((100, 104, 8)), edge(104, -8)),  # too short
        (level((100, 350, 8)), edge(350, -8)),  # too long
        (level((100, 150, 8)), edge(150, -8, score=0.1)),  # unclear, and no shift in between
    ],
)
def test_what_is_no_level_shift(residual, second):
    first = edge(100, 8, score=3.0 if second.score > 1 else 0.8)
    assert between(residual, first, second) == []


def test_none_goes_on_across_a_gap():
    missing = NOTHING.copy()
    missing[120:125] = True
    assert between(level((100, 150, 8)), edge(100, 8), edge(150, -8), missing=missing) == []


def test_clear_pairs_come_first_then_the_shorter():
    found = edge(100, 8, 0.9), edge(130, -8, 0.9), edge(200, 8), edge(250, -8)
    residual = level((100, 130, 8), (200, 250, 8))
    assert between(residual, *found) == [(200, 250), (100, 130)]
    nested = edge(100, 8), edge(120, 8), edge(140, -8), edge(160, -8)
    assert between(level((100, 160, 8), (120, 140, 8)), *nested) == [(120, 140)]


def test_the_shift_is_a_part_of_the_jump():
    assert shift_fraction(level((100, 150, 4)), 100, 150, np.array([8.0, 0, 0])) == pytest.approx(0.5)
    assert joint_score(edge(1, 1, 3.0), edge(2, 1, 4.0)) == pytest.approx(np.sqrt(12.5))


def test_a_gap_in_the_place_of_an_edge():
    missing = NOTHING.copy()
    missing[150:160] = True
    assert truncated(level((100, 150, 8)), edge(100, 8), missing=missing) == [(100, 150)]
    assert truncated(level((100, 300, 8)), edge(100, 8), missing=missing) == []
    other = Event("B", 100, 180, 3.0)
    assert truncated(level((100, 150, 8)), edge(100, 8), missing=missing, others=[other]) == []
    own = Event("A", 90, 100, 3.0)
    assert truncated(level((100, 150, 8)), edge(100, 8), missing=missing, others=[own]) == []


def test_an_end_of_the_recording_in_the_place_of_an_edge_needs_a_stronger_one_and_a_long_baseline():
    assert truncated(level((350, 400, 8)), edge(350, 8)) == [(350, 400)]
    assert truncated(level((350, 400, 8)), edge(350, 8, score=1.5)) == []
    missing = NOTHING.copy()
    missing[:300] = True
    assert truncated(level((350, 400, 8)), edge(350, 8), missing=missing) == []
