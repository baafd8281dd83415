"""Exchanges of labels: carried out bit for bit where the markers are better with them, and left where not."""

import numpy as np
import pytest

from markermend.core.decisions import Decision
from markermend.core.events import Event
from markermend.core.recording import MISSING, ORIGINS
from markermend.repair.exchange_plan import NO_METHOD
from support import bodies
from support.repairs import METHODS, START, STOP, body, error, mend


@pytest.fixture(scope="module")
def clean():
    return body()


def test_swap_is_undone_bit_for_bit(clean):
    a, b = clean.markers.index("2b"), clean.markers.index("3a")
    positions = clean.positions.copy()
    positions[START:STOP, [a, b]] = positions[START:STOP, [b, a]]
    recording = bodies.recording(clean.markers, positions)
    events = [Event("2b", START, STOP, 9.0, "xyz", "3a"), Event("3a", START, STOP, 9.0, "xyz", "2b")]
    result = mend(recording, {"labels": events})
    assert np.array_equal(result.positions, clean.positions)
    assert (result.origin[START:STOP, [a, b]] == ORIGINS.index("swap")).all()
    assert [(r.marker, r.partner, r.kind) for r in result.repairs] == [
        ("2b", "3a", "swap"),
        ("3a", "2b", "swap"),
    ]


def test_swap_with_a_missing_partner_moves_the_samples(clean):
    a, b = clean.markers.index("2b"), clean.markers.index("3a")
    positions = clean.positions.copy()
    positions[START:STOP, b] = positions[START:STOP, a]
    positions[START:STOP, a] = np.nan
    recording = bodies.recording(clean.markers, positions)
    result = mend(recording, {"labels": [Event("3a", START, STOP, 9.0, "xyz", "2b")]})
    assert np.array_equal(result.positions[:, a], clean.positions[:, a])
    assert np.isnan(result.positions[START:STOP, b]).all()
    assert (result.origin[START:STOP, b] == MISSING).all()


def test_a_peak_within_a_swap_is_mended_after_the_swap(clean):
    a, b = clean.markers.index("2b"), clean.markers.index("3a")
    positions = clean.positions.copy()
    positions[610:613, a] += 20.0
    positions[START:STOP, [a, b]] = positions[START:STOP, [b, a]]
    swap = [Event("2b", START, STOP, 9.0, "xyz", "3a"), Event("3a", START, STOP, 9.0, "xyz", "2b")]
    result = mend(bodies.recording(clean.markers, positions), {"peaks": [Event("2b", 610, 613, 5.0)], "labels": swap})
    assert error(clean, result).max() < 1
    assert (result.origin[610:613, a] == ORIGINS.index("peak")).all()
    others = np.delete(np.arange(len(positions)), slice(610, 613))
    assert np.array_equal(result.positions[others], clean.positions[others])
    assert np.array_equal(result.positions[:, b], clean.positions[:, b])


@pytest.mark.parametrize("protect", ["2b", "3a"])
def test_a_swap_with_a_protected_marker_is_left(clean, protect):
    swap = [Event("2b", START, STOP, 9.0, "xyz", "3a"), Event("3a", START, STOP, 9.0, "xyz", "2b")]
    result = mend(clean, {"labels": swap}, protect=[protect])
    assert np.array_equal(result.positions, clean.positions)
    assert [left.reason.text for left in result.repairs_left] == ["protected", "protected"]


@pytest.mark.parametrize("one, other", [("2b", "3a"), ("1a", "1b"), ("3a", "3b")])
def test_what_protected_frames_leave_of_a_swap_is_undone(clean, one, other):
    both = [clean.markers.index(name) for name in (one, other)]
    positions = clean.positions.copy()
    positions[START:STOP, both] = positions[START:STOP, both[::-1]]
    swap = [Event(one, START, STOP, 9.0, "xyz", other), Event(other, START, STOP, 9.0, "xyz", one)]
    middle = slice(START + 6, START + 10)
    kept = [Decision(one, middle.start, middle.stop, "protect")]
    result = mend(bodies.recording(clean.markers, positions), {"labels": swap}, decisions=kept)
    expected = clean.positions.copy()
    expected[middle] = positions[middle]
    assert np.array_equal(result.positions, expected)


def test_a_swap_that_is_none_is_left(clean):
    swap = [Event("2b", START, STOP, 1.0, "xyz", "3a"), Event("3a", START, STOP, 1.0, "xyz", "2b")]
    result = mend(clean, {"labels": swap})
    assert np.array_equal(result.positions, clean.positions)
    assert [left.marker for left in result.repairs_left] == ["2b", "3a"]
    assert all("no better with labels exchanged" in left.reason.text for left in result.repairs_left)
    wanted = mend(clean, {"labels": swap}, decisions=[Decision("2b", START, STOP, "accept", "swap")])
    assert len(wanted.repairs) == 2


def test_a_swap_that_a_gap_interrupts_is_undone(clean):
    a, b = clean.markers.index("2b"), clean.markers.index("3a")
    positions = clean.positions.copy()
    positions[START:STOP, [a, b]] = positions[START:STOP, [b, a]]
    positions[START + 5 : STOP - 5, a] = np.nan
    swap = [Event("2b", START, STOP, 9.0, "xyz", "3a"), Event("3a", START, STOP, 9.0, "xyz", "2b")]
    result = mend(bodies.recording(clean.markers, positions), {"labels": swap})
    assert len(result.repairs) == 2
    assert np.array_equal(result.positions[:, a], clean.positions[:, a])


def test_without_a_method_a_swap_is_left_and_a_peak_within_it_belongs_to_its_recorded_label(clean):
    a, b = clean.markers.index("2b"), clean.markers.index("3a")
    positions = clean.positions.copy()
    positions[610:613, a] += 20.0
    positions[START:STOP, [a, b]] = positions[START:STOP, [b, a]]
    recording = bodies.recording(clean.markers, positions)
    swap = [Event("2b", START, STOP, 9.0, "xyz", "3a"), Event("3a", START, STOP, 9.0, "xyz", "2b")]
    methods = {**METHODS, "labels": []}
    result = mend(recording, {"peaks": [Event("2b", 610, 613, 5.0)], "labels": swap}, methods=methods)
    left = [(own.marker, own.start, own.stop) for own in result.repairs_left if own.reason == NO_METHOD]
    assert left == [("2b", START, STOP), ("3a", START, STOP)]
    peaks = [own for own in [*result.repairs, *result.repairs_left] if (own.start, own.stop) == (610, 613)]
    assert [own.marker for own in peaks] == ["3a"]
    untouched = np.ones(positions.shape[:2], bool)
    untouched[610:613, b] = False
    assert np.array_equal(result.positions[untouched], positions[untouched])
    wanted = mend(
        recording, {"labels": swap}, methods=methods, decisions=[Decision("2b", START, STOP, "accept", "swap")]
    )
    assert np.array_equal(
        np.delete(wanted.positions, slice(610, 613), 0), np.delete(clean.positions, slice(610, 613), 0)
    )


def pair(a, b):
    return [Event(a, START, STOP, 9.0, "xyz", b), Event(b, START, STOP, 9.0, "xyz", a)]


def test_exchanged_labels_do_not_count_as_altered(clean):
    a, b = clean.markers.index("2b"), clean.markers.index("3a")
    positions = clean.positions.copy()
    positions[START:STOP, [a, b]] = positions[START:STOP, [b, a]]
    result = mend(bodies.recording(clean.markers, positions), {"labels": pair("2b", "3a")}, max_altered_share=0.0)
    assert np.array_equal(result.positions, clean.positions)


@pytest.mark.parametrize("exchanged", [True, False])
def test_all_exchanges_over_the_same_frames_are_carried_out_or_none(clean, exchanged):
    positions = clean.positions.copy()
    for names in (("2b", "3a"), ("1a", "2a")) if exchanged else ():
        own = [clean.markers.index(name) for name in names]
        positions[START:STOP, own] = positions[START:STOP, own[::-1]]
    recording = bodies.recording(clean.markers, positions)
    result = mend(recording, {"labels": [*pair("2b", "3a"), *pair("1a", "2a")]})
    assert np.array_equal(result.positions, clean.positions)
