"""Label exchanges: undone bit for bit, and findings stay with the samples on which they were made."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from markermend.core.events import Event, coordinates
from markermend.core.labels import follow, undo_exchanges

MARKERS = ("A", "B", "C", "D")
FRAMES = 20


def pair(start, stop, one="A", other="B"):
    return [Event(one, start, stop, 2.0, partner=other), Event(other, start, stop, 2.0, partner=one)]


def cycle(start, stop, *names):
    return [Event(name, start, stop, 2.0, partner=names[(k + 1) % len(names)]) for k, name in enumerate(names)]


@st.composite
def exchanges(draw):
    """Some stretches one after the other, each with a permutation of some of the labels."""
    found, start = [], 0
    while start < FRAMES and draw(st.booleans()):
        start = draw(st.integers(start, FRAMES - 1))
        stop = draw(st.integers(start + 1, FRAMES))
        names = draw(st.permutations(MARKERS))[: draw(st.integers(2, 4))]
        found += cycle(start, stop, *names)
        start = stop
    return found


def positions():
    return np.random.default_rng(3).normal(size=(FRAMES, len(MARKERS), 3))


def test_each_marker_gets_the_samples_under_its_partners_label():
    recorded = positions()
    before = recorded.copy()
    corrected = undo_exchanges(recorded, cycle(5, 9, "A", "C", "B"), MARKERS)
    assert np.array_equal(corrected[5:9], recorded[5:9][:, [2, 0, 1, 3]])
    assert np.array_equal(corrected[:5], recorded[:5]) and np.array_equal(corrected[9:], recorded[9:])
    assert np.array_equal(recorded, before)


def test_findings_of_other_classes_exchange_nothing():
    assert np.array_equal(undo_exchanges(positions(), [Event("A", 2, 5, 1.0)], MARKERS), positions())


@given(found=exchanges(), start=st.integers(0, FRAMES - 1), length=st.integers(1, FRAMES))
def test_what_is_found_on_corrected_trajectories_follows_its_samples(found, start, length):
    """The naive twin: give the mask of the findings, as an extra coordinate of the samples, through the exchange."""
    event = Event("A", start, min(start + length, FRAMES), 3.0, "xz")
    recorded = coordinates(follow([event], found_under=found, stated_under=()), FRAMES, MARKERS)
    corrected = undo_exchanges(recorded.astype(float), found, MARKERS).astype(bool)
    assert np.array_equal(corrected, coordinates([event], FRAMES, MARKERS))
    back = follow(follow([event], found_under=found, stated_under=()), found_under=(), stated_under=found)
    assert np.array_equal(coordinates(back, FRAMES, MARKERS), coordinates([event], FRAMES, MARKERS))


@given(found=exchanges(), start=st.integers(0, FRAMES - 1))
def test_a_finding_stays_whole_where_the_labels_are_the_same(found, start):
    event = Event("B", start, FRAMES, 3.0)
    assert follow([event], found_under=found, stated_under=found) == [event]


@pytest.mark.parametrize(
    ("found", "places"),
    [
        ((8, 12), [("B", 8, 12)]),
        ((2, 8), [("A", 2, 5), ("B", 5, 8)]),
        ((2, 19), [("A", 2, 5), ("A", 15, 19), ("B", 5, 15)]),
        ((15, 19), [("A", 15, 19)]),
    ],
)
def test_a_finding_is_split_at_the_borders_of_an_exchange(found, places):
    followed = follow([Event("A", *found, 2.5, "y")], found_under=pair(5, 15), stated_under=())
    assert [(event.marker, event.start, event.stop) for event in followed] == places
    assert {(event.score, event.axes) for event in followed} == {(2.5, "y")}


def test_a_part_of_an_exchange_may_be_carried_out():
    event = Event("A", 6, 14, 2.0)
    followed = follow([event], found_under=pair(5, 15), stated_under=pair(5, 10))
    assert followed == [Event("A", 6, 10, 2.0), Event("B", 10, 14, 2.0)]
