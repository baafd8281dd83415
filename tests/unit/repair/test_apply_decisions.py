"""Decisions against findings, with a plain twin that asks sample by sample."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from markermend.core.artifacts import BY_NAME, CLASSES
from markermend.core.decisions import EVER, Decision
from markermend.core.events import Event
from markermend.core.recording import Recording, changed
from markermend.repair.apply_decisions import judge

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
findings = st.dictionaries(st.sampled_from(CLASSES), st.lists(events, max_size=3))
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
    judged = judge(before, found, decided)
    for m in range(len(MARKERS)):
        for frame in range(FRAMES):
            safe = any(about(decision, "protect", m, frame) for decision in decided)
            declared = any(about(decision, "missing", m, frame) for decision in decided)
            gone = np.isnan(judged.recording.positions[frame, m]).all()
            assert gone == (before.missing[frame, m] or (declared and not safe))
            if safe:
                touching = [e for es in judged.found.values() for e in es if MARKERS[m] in (e.marker, e.partner)]
                assert not any(event.start <= frame < event.stop for event in touching)


@settings(max_examples=300, deadline=None)
@given(findings, decisions)
def test_every_finding_is_kept_or_accounted_for(found, decided):
    judged = judge(recording(), found, decided)
    for stage, found_events in found.items():
        for event in found_events:
            parts = [other for other in judged.found[stage] if other.marker == event.marker]
            places = [(part.start, part.stop) for part in parts]
            places += [(left.start, left.stop) for left in judged.left if left.marker == event.marker]
            assert all(any(a <= frame < b for a, b in places) for frame in range(event.start, event.stop))


@settings(max_examples=200, deadline=None)
@given(findings, decisions)
def test_decisions_on_a_marker_leave_the_others_alone(found, decided):
    own = [decision for decision in decided if not decision.matches("B") and decision.partner is None]
    before = recording()
    judged = judge(before, found, own)
    assert not changed(before, judged.recording)[:, 2].any()
    assert not any(left.marker == "B" for left in judged.left)
    for stage in CLASSES:
        plain = [event for event in found.get(stage, []) if event.marker == "B"]
        assert [event for event in judged.found[stage] if event.marker == "B"] == plain


@settings(max_examples=100, deadline=None)
@given(findings, decisions)
def test_the_order_of_decisions_does_not_matter_to_what_is_left_to_repair(found, decided):
    one, other = judge(recording(), found, decided), judge(recording(), found, decided[::-1])
    assert {stage: set(es) for stage, es in one.found.items()} == {stage: set(es) for stage, es in other.found.items()}
    assert not changed(one.recording, other.recording).any()


def test_nothing_decided_leaves_all_as_it_is():
    found = {"peaks": [Event("B", 3, 5, 2.0)], "steps": [Event("A1", 8, 9, 2.0, "xyz", "A2")]}
    before = recording([(0, 2, 4)])
    judged = judge(before, found, [])
    assert {stage: es for stage, es in judged.found.items() if es} == found and judged.left == []
    assert np.array_equal(judged.recording.positions, before.positions, equal_nan=True)


def test_a_protected_partner_ends_a_swap_on_both_markers():
    swap = [Event("A1", 5, 15, 2.0, "xyz", "B"), Event("B", 5, 15, 2.0, "xyz", "A1")]
    judged = judge(recording(), {"labels": swap}, [Decision("B", 8, 10, "protect")])
    places = [(event.marker, event.start, event.stop) for event in judged.found["labels"]]
    assert places == [("A1", 5, 8), ("A1", 10, 15), ("B", 5, 8), ("B", 10, 15)]


def test_an_artifact_where_nothing_was_measured_is_none():
    judged = judge(recording([(2, 4, 9)]), {}, [Decision("B", 5, 8, "class", "peak")])
    assert not any(judged.found.values())


@pytest.mark.parametrize("partner", ["C", "A1"])
def test_a_swap_needs_its_partner(partner):
    judged = judge(recording(), {"peaks": [Event("B", 5, 7, 2.0)]}, [Decision("B", 4, 9, "class", f"swap:{partner}")])
    swaps = [(event.marker, event.partner, event.start, event.stop) for event in judged.found["labels"]]
    assert swaps == ([] if partner == "C" else [("A1", "B", 4, 9), ("B", "A1", 4, 9)])
    assert bool(judged.found["peaks"]) == (partner == "C")


def test_a_piece_of_a_finding_in_which_nothing_was_measured_is_no_finding():
    before = recording([(0, 10, 14)])
    shut = [Decision("A1", 6, 10, "protect"), Decision("A1", 14, 16, "protect")]
    judged = judge(before, {"peaks": [Event("A1", 4, 20, 2.0)]}, shut)
    assert [(event.start, event.stop) for event in judged.found["peaks"]] == [(4, 6), (16, 20)]
