"""Exchanges of labels that are not carried out: what was found inside follows its samples, and no other marker changes."""

import numpy as np
import pytest

from markermend.core.decisions import EVER, Decision
from markermend.core.events import Event
from markermend.core.recording import changed
from markermend.repair.label_exchanges import concerned, cycle_of, linked_events
from support import bodies
from support.repairs import START, STOP, body, mend

PAIR = [Event("2b", START, STOP, 9.0, partner="3a"), Event("3a", START, STOP, 9.0, partner="2b")]
RING = [
    Event("2b", START, STOP, 9.0, partner="3a"),
    Event("3a", START, STOP, 9.0, partner="1a"),
    Event("1a", START, STOP, 9.0, partner="2b"),
]
PEAK = (610, 613)
REFUSED = {
    "rejected": {"decisions": [Decision("3a", START, STOP, "reject", "swap")]},
    "a marker is protected": {"protect": ["2b"]},
    "a decision protects": {"decisions": [Decision("2b", -EVER, EVER, "protect")]},
    "worse": {},
    "no method": {"methods": {"labels": [], "peaks": ["spline"]}},
}


@pytest.fixture(scope="module")
def clean():
    return body()


def with_peak(clean, marker="3a"):
    """A recording whose labels are right, with a peak on a marker."""
    positions = clean.positions.copy()
    positions[slice(*PEAK), clean.markers.index(marker)] += 20.0
    return bodies.recording(clean.markers, positions)


def other_markers(recording, *names):
    return [m for m, name in enumerate(recording.markers) if name not in names]


@pytest.mark.parametrize("why", ["rejected", "a marker is protected", "a decision protects", "worse"])
def test_what_was_found_inside_is_repaired_under_the_label_of_its_samples(clean, why):
    """The peak was found on 2b, to which an exchange that is none would have given the samples of 3a."""
    recording = with_peak(clean)
    found = {"labels": PAIR, "peaks": [Event("2b", *PEAK, 5.0)]}
    result = mend(recording, found, **REFUSED[why])
    (repair,) = result.repairs
    assert (repair.marker, repair.start, repair.stop, repair.kind) == ("3a", *PEAK, "peak")
    innocent = other_markers(recording, "3a")
    assert np.array_equal(result.positions[:, innocent], recording.positions[:, innocent])
    m = recording.markers.index("3a")
    assert np.abs(result.positions[:, m] - clean.positions[:, m]).max() < 1
    assert [left.kind for left in result.repairs_left] == ["swap", "swap"]


def test_too_much_altered_leaves_all_and_says_so_under_the_label_of_the_samples(clean):
    recording = with_peak(clean)
    result = mend(recording, {"labels": PAIR, "peaks": [Event("2b", *PEAK, 5.0)]}, max_altered_share=0.0)
    assert not changed(recording, result).any()
    places = [(left.kind, left.marker) for left in result.repairs_left]
    assert ("swap+peak", "3a") in places


def test_a_confirmed_finding_in_a_refused_recording_follows_its_samples(clean):
    recording = with_peak(clean)
    accept = [Decision("3a", *PEAK, "accept", "peak")]
    found = {"labels": PAIR, "peaks": [Event("2b", *PEAK, 5.0)]}
    result = mend(
        recording, found, max_altered_share=0.0, decisions=[Decision("3a", START, STOP, "reject", "swap"), *accept]
    )
    assert [repair.marker for repair in result.repairs] == ["3a"]
    innocent = other_markers(recording, "3a")
    assert np.array_equal(result.positions[:, innocent], recording.positions[:, innocent])


def test_static_recordings_stay_as_they_are(clean):
    recording = with_peak(clean)
    static = type(recording)(recording.markers, recording.positions, recording.rate, facts={"kind": "static"})
    found = {"labels": PAIR, "peaks": [Event("2b", *PEAK, 5.0)]}
    assert not changed(static, mend(static, found)).any()


def test_a_finding_across_the_border_of_a_rejected_exchange_is_split(clean):
    recording = with_peak(clean)
    found = {"labels": PAIR, "noise": [Event("2b", START - 10, START + 10, 5.0)]}
    result = mend(recording, found, **REFUSED["rejected"])
    places = [(r.marker, r.start, r.stop) for r in result.repairs + result.repairs_left[2:]]
    assert sorted(places) == [("2b", START - 10, START), ("3a", START, START + 10)]


def test_a_protected_part_of_a_stretch_is_not_exchanged_and_keeps_its_findings(clean):
    a, b = clean.markers.index("2b"), clean.markers.index("3a")
    positions = with_peak(clean, "2b").positions
    positions[START:STOP, [a, b]] = positions[START:STOP, [b, a]]
    recording = bodies.recording(clean.markers, positions)
    protect = [Decision("2b", START, 620, "protect")]
    result = mend(recording, {"labels": PAIR, "peaks": [Event("2b", *PEAK, 5.0)]}, decisions=protect)
    assert np.array_equal(result.positions[START:620, a], recording.positions[START:620, a])
    assert np.array_equal(result.positions[620:STOP, [a, b]], clean.positions[620:STOP, [a, b]])
    changes = [*result.repairs, *result.repairs_left]
    assert [(one.marker, one.start) for one in changes if one.kind == "peak"] == [("3a", PEAK[0])]


@pytest.mark.parametrize("protect", ["2b", "3a", "1a"])
def test_a_ring_with_a_protected_marker_is_left_whole(clean, protect):
    recording = with_peak(clean)
    result = mend(recording, {"labels": RING, "peaks": [Event("2b", *PEAK, 5.0)]}, protect=[protect])
    innocent = other_markers(recording, "3a")
    assert np.array_equal(result.positions[:, innocent], recording.positions[:, innocent])
    assert len([left for left in result.repairs_left if left.kind == "swap"]) == 3


@pytest.mark.parametrize("rejected", ["2b", "3a", "1a"])
def test_a_ring_of_which_a_person_rejects_one_is_left_whole(clean, rejected):
    result = mend(clean, {"labels": RING}, decisions=[Decision(rejected, START, STOP, "reject")])
    assert not changed(clean, result).any()
    assert [left.reason.text for left in result.repairs_left] == ["a person decided: reject"] * 3


def test_a_swap_that_a_person_names_stands_in_place_of_what_was_found_on_both_markers(clean):
    a, b = clean.markers.index("2b"), clean.markers.index("3a")
    positions = clean.positions.copy()
    positions[START:STOP, [a, b]] = positions[START:STOP, [b, a]]
    recording = bodies.recording(clean.markers, positions)
    found = {"steps": [Event("2b", START, STOP, 9.0), Event("3a", START, STOP, 9.0)]}
    result = mend(recording, found, decisions=[Decision("2b", START, STOP, "class", "swap:3a")])
    assert np.array_equal(result.positions, clean.positions)


def test_the_cycle_of_an_exchange():
    assert cycle_of(PAIR[0], PAIR) == PAIR
    assert cycle_of(RING[1], RING) == [RING[1], RING[2], RING[0]]
    assert cycle_of(PAIR[1], PAIR[1:]) == PAIR[::-1]
    other = [Event("2b", 10, 20, 9.0, partner="1a"), Event("1a", 10, 20, 9.0, partner="2b")]
    assert cycle_of(other[0], [*PAIR, *other]) == other


def test_who_is_concerned_by_a_finding():
    assert concerned(Event("2b", START, STOP, 3.0), RING) == ("2b",)
    assert concerned(RING[0], RING) == ("2b", "3a", "1a")


def test_a_decision_on_one_marker_of_a_joint_finding_is_about_all_but_a_protection_is_about_that_marker(clean):
    found = {"peaks": [Event(marker, *PEAK, 5.0, group="hand") for marker in ("2b", "3a")]}
    assert concerned(found["peaks"][1], linked_events(found)) == ("3a", "2b")
    recording = with_peak(with_peak(clean), "2b")
    rejected = mend(recording, found, decisions=[Decision("3a", *PEAK, "reject", "peak")])
    assert not rejected.repairs and [left.group for left in rejected.repairs_left] == ["hand", "hand"]
    protected = mend(recording, found, protect=["3a"])
    assert [repair.marker for repair in protected.repairs] == ["2b"]
