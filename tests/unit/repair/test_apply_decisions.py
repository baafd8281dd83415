"""Decisions against findings, with a plain twin that asks sample by sample, and what they come to in a repair."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from markermend.core.artifacts import BY_NAME, DETECTORS
from markermend.core.decisions import EVER, Decision
from markermend.core.events import Event
from markermend.core.recording import MISSING, ORIGINS, Recording, changed
from markermend.repair.apply_decisions import apply_decisions
from support.repairs import MARKER, START, STOP, body, decide, distorted, error, mend

SLOW = {"slow": [Event(MARKER, START, STOP, 4.0)]}
SWAP = [Event("2b", START, STOP, 9.0, "xyz", "3a"), Event("3a", START, STOP, 9.0, "xyz", "2b")]
MARKERS, FRAMES = ("A1", "A2", "B"), 30
KINDS = tuple(kind for kind in BY_NAME if kind != "swap")


def recording(gaps=()):
    positions = np.random.default_rng(1).normal(0, 100, (FRAMES, len(MARKERS), 3))
    for m, start, stop in gaps:
        positions[start:stop, m] = np.nan
    return Recording(MARKERS, positions, 100.0)


stretches = st.tuples(st.integers(-3, FRAMES + 2), st.integers(1, 12)).map(lambda pair: (pair[0], pair[0] + pair[1]))
inside = st.tuples(st.integers(0, FRAMES - 12), st.integers(1, 12)).map(lambda pair: (pair[0], pair[0] + pair[1]))
events = st.builds(lambda marker, span: Event(marker, *span, 2.0), st.sampled_from(MARKERS), inside)
findings = st.dictionaries(st.sampled_from(DETECTORS), st.lists(events, max_size=3))
kinds = st.sampled_from(["", *KINDS])
verbs = st.one_of(
    st.tuples(st.sampled_from(["accept", "reject"]), kinds),
    st.tuples(st.sampled_from(["protect", "missing"]), st.just("")),
    st.tuples(st.just("class"), st.sampled_from([*KINDS, "swap:B"])),
    st.tuples(st.just("method"), st.sampled_from(["leave", "spline"])),
)
decisions = st.lists(
    st.builds(
        lambda marker, span, verb: Decision(marker, *span, *verb),
        st.sampled_from(["A1", "A?", "B", "*", "C"]),
        st.one_of(stretches, st.just((-EVER, EVER))),
        verbs,
    ),
    max_size=4,
)
gaps = st.lists(st.tuples(st.integers(0, 2), inside).map(lambda pair: (pair[0], *pair[1])), max_size=2)


def about(decision, verb, m, frame):
    return decision.verb == verb and decision.matches(MARKERS[m]) and decision.start <= frame < decision.stop


@settings(max_examples=300, deadline=None)
@given(findings, decisions, gaps)
def test_protected_samples_are_in_no_finding_and_stay(found, decided, missing):
    before = recording(missing)
    result = apply_decisions(before, found, decided)
    for m in range(len(MARKERS)):
        for frame in range(FRAMES):
            safe = any(about(decision, "protect", m, frame) for decision in decided)
            declared = any(about(decision, "missing", m, frame) for decision in decided)
            gone = np.isnan(result.recording.positions[frame, m]).all()
            assert gone == (before.missing[frame, m] or (declared and not safe))
            if safe:
                touching = [e for es in result.found.values() for e in es if MARKERS[m] in (e.marker, e.partner)]
                assert not any(event.start <= frame < event.stop for event in touching)


@settings(max_examples=300, deadline=None)
@given(findings, decisions)
def test_every_finding_is_kept_or_accounted_for(found, decided):
    result = apply_decisions(recording(), found, decided)
    for stage, found_events in found.items():
        for event in found_events:
            parts = [other for other in result.found[stage] if other.marker == event.marker]
            places = [(part.start, part.stop) for part in parts]
            places += [(left.start, left.stop) for left in result.left if left.marker == event.marker]
            assert all(any(a <= frame < b for a, b in places) for frame in range(event.start, event.stop))


@settings(max_examples=200, deadline=None)
@given(findings, decisions)
def test_decisions_on_a_marker_leave_the_others_alone(found, decided):
    own = [decision for decision in decided if not decision.matches("B") and decision.partner is None]
    before = recording()
    result = apply_decisions(before, found, own)
    assert not changed(before, result.recording)[:, 2].any()
    assert not any(left.marker == "B" for left in result.left)
    for stage in DETECTORS:
        plain = [event for event in found.get(stage, []) if event.marker == "B"]
        assert [event for event in result.found[stage] if event.marker == "B"] == plain


@settings(max_examples=100, deadline=None)
@given(findings, decisions)
def test_the_order_of_decisions_does_not_matter_to_what_is_left_to_repair(found, decided):
    one, other = apply_decisions(recording(), found, decided), apply_decisions(recording(), found, decided[::-1])
    assert {stage: set(es) for stage, es in one.found.items()} == {stage: set(es) for stage, es in other.found.items()}
    assert not changed(one.recording, other.recording).any()


def test_nothing_decided_leaves_all_as_it_is():
    found = {"peaks": [Event("B", 3, 5, 2.0)], "steps": [Event("A1", 8, 9, 2.0, "xyz", "A2")]}
    before = recording([(0, 2, 4)])
    result = apply_decisions(before, found, [])
    assert {stage: es for stage, es in result.found.items() if es} == found and result.left == []
    assert np.array_equal(result.recording.positions, before.positions, equal_nan=True)


def test_a_protected_partner_ends_a_swap_on_both_markers():
    swap = [Event("A1", 5, 15, 2.0, "xyz", "B"), Event("B", 5, 15, 2.0, "xyz", "A1")]
    result = apply_decisions(recording(), {"labels": swap}, [Decision("B", 8, 10, "protect")])
    places = [(event.marker, event.start, event.stop) for event in result.found["labels"]]
    assert places == [("A1", 5, 8), ("A1", 10, 15), ("B", 5, 8), ("B", 10, 15)]


def test_an_artifact_where_nothing_was_measured_is_none():
    result = apply_decisions(recording([(2, 4, 9)]), {}, [Decision("B", 5, 8, "class", "peak")])
    assert not any(result.found.values())


@pytest.mark.parametrize("partner", ["C", "A1"])
def test_a_swap_needs_its_partner(partner):
    result = apply_decisions(
        recording(), {"peaks": [Event("B", 5, 7, 2.0)]}, [Decision("B", 4, 9, "class", f"swap:{partner}")]
    )
    swaps = [(event.marker, event.partner, event.start, event.stop) for event in result.found["labels"]]
    assert swaps == ([] if partner == "C" else [("A1", "B", 4, 9), ("B", "A1", 4, 9)])
    assert bool(result.found["peaks"]) == (partner == "C")


def test_a_piece_of_a_finding_in_which_nothing_was_measured_is_no_finding():
    before = recording([(0, 10, 14)])
    shut = [Decision("A1", 6, 10, "protect"), Decision("A1", 14, 16, "protect")]
    result = apply_decisions(before, {"peaks": [Event("A1", 4, 20, 2.0)]}, shut)
    assert [(event.start, event.stop) for event in result.found["peaks"]] == [(4, 6), (16, 20)]


@pytest.fixture(scope="module")
def clean():
    return body()


@pytest.fixture(scope="module")
def drifting(clean):
    return distorted(clean, 20.0)


def test_what_a_person_rejects_stays_as_measured(drifting):
    result = mend(drifting, SLOW, decisions=[decide("reject", "slow", "he hops")])
    assert not changed(drifting, result).any() and result.repairs == []
    (left,) = result.repairs_left
    assert (left.reason.text, left.outcome) == ("a person decided: reject slow", "left")
    assert left.decisions == ("reject slow",)
    assert mend(drifting, SLOW, decisions=[decide("reject", "peak")]).repairs


def test_a_rejected_swap_stays_on_both_markers(clean):
    result = mend(clean, {"labels": SWAP}, decisions=[decide("reject", "swap", marker="3a")])
    assert not changed(clean, result).any()
    assert [left.marker for left in result.repairs_left] == ["2b", "3a"]


def test_protected_frames_stay_and_what_is_around_them_is_repaired(clean, drifting):
    protect = decide("protect", start=610, stop=615)
    result = mend(drifting, SLOW, decisions=[protect, decide("accept")])
    m = clean.markers.index(MARKER)
    assert np.array_equal(result.positions[610:615, m], drifting.positions[610:615, m])
    assert [(r.start, r.stop) for r in result.repairs] == [(START, 610), (615, STOP)]
    (left,) = result.repairs_left
    assert (left.start, left.stop, left.reason.text) == (610, 615, "a person decided: protect")


def test_a_class_that_a_person_sets_replaces_what_was_found(clean):
    recording = distorted(clean, np.array([9.0, -4.0, 2.0]))
    found = {"noise": [Event(MARKER, START - 3, START + 9, 2.0)], "slow": [Event(MARKER, STOP - 5, STOP + 2, 3.0)]}
    result = mend(recording, found, decisions=[decide("class", "step")])
    (repair,) = result.repairs
    assert (repair.kind, repair.method, repair.start, repair.stop) == (
        "step",
        "separate_step",
        START,
        STOP,
    )
    assert error(clean, result).max() < 0.3
    assert {left.reason.text for left in result.repairs_left} == {"a person decided: class step"}


def test_an_artifact_that_no_detector_saw(clean, drifting):
    result = mend(drifting, {}, decisions=[decide("class", "slow")])
    assert error(clean, result).max() < 1
    m = clean.markers.index(MARKER)
    assert (result.origin[START:STOP, m] == ORIGINS.index("slow")).all()


def test_a_swap_that_no_detector_saw(clean):
    a, b = clean.markers.index("2b"), clean.markers.index("3a")
    positions = clean.positions.copy()
    positions[START:STOP, [a, b]] = positions[START:STOP, [b, a]]
    recording = distorted(clean, 0.0)
    recording.positions[:] = positions
    result = mend(recording, {}, decisions=[decide("class", "swap:3a")])
    assert np.array_equal(result.positions, clean.positions)
    assert [repair.decisions for repair in result.repairs] == [("class swap:3a",)] * 2


def test_leave_leaves(drifting):
    assert not changed(drifting, mend(drifting, SLOW, decisions=[decide("method", "leave")])).any()


def test_what_a_person_declares_missing_is_taken_away_and_not_believed(clean, drifting):
    result = mend(drifting, {}, decisions=[decide("missing")])
    m = clean.markers.index(MARKER)
    assert (result.origin[START:STOP, m] == MISSING).all()
    assert np.count_nonzero(changed(drifting, result)) == STOP - START
    (left,) = result.repairs_left
    assert (left.kind, left.outcome, left.decisions) == ("missing", "blanked", ("missing",))


def test_static_recordings_and_protected_markers_are_stronger(clean, drifting):
    everything = [
        decide("accept"),
        decide("missing", start=700, stop=710),
        decide("class", "noise", start=800, stop=820),
    ]
    assert not changed(drifting, mend(drifting, SLOW, decisions=everything, protect=["2*"])).any()
    static = type(drifting)(drifting.markers, drifting.positions, drifting.rate, facts={"kind": "static"})
    assert not changed(static, mend(static, SLOW, decisions=everything)).any()


def test_decisions_on_other_markers_change_nothing(drifting):
    plain = mend(drifting, SLOW)
    others = [Decision("0a", -EVER, EVER, verb) for verb in ("accept", "reject", "protect")]
    result = mend(drifting, SLOW, decisions=[*others, Decision("?zzz", 0, 9, "missing")])
    assert np.array_equal(plain.positions, result.positions) and plain.changes == result.changes
