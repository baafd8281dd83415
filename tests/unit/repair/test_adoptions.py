"""Which samples under unlabelled trajectories are given to markers, under which labels, and why others are not."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.decisions import Decision
from markermend.core.events import Event
from markermend.core.reasons import Cause
from markermend.core.recording import Recording
from markermend.repair.adoptions import adopt_samples
from markermend.repair.findings import Rulings

TRACK = np.random.default_rng(1).normal(0, 100, (30, 3))
FOREIGN = Event("B", 8, 14, 2.0, kind="foreign")


def event(kind="adopted", marker="B", start=10, stop=20):
    return Event(marker, start, stop, 2.0, kind=kind, source="*7")


@pytest.fixture
def recording():
    positions = np.random.default_rng(0).normal(0, 100, (30, 3, 3))
    positions[10:20, 1] = np.nan
    return Recording(("A", "B", "C"), positions, 100.0, unlabelled={"*7": TRACK})


def adoption(recording, events, *decisions):
    return adopt_samples(recording, {"labels": events, "peaks": []}, Rulings(decisions, events))


def given(recording, result):
    different = (result.recording.positions != recording.positions).any(axis=2) & ~np.isnan(
        result.recording.positions
    ).any(axis=2)
    assert np.array_equal(different, result.adopted)
    return [(int(f), int(m)) for m, f in zip(*np.nonzero(result.adopted.T), strict=True)]


def test_samples_are_given_and_the_finding_is_settled(recording):
    result = adoption(recording, [event()])
    assert given(recording, result) == [(frame, 1) for frame in range(10, 20)]
    assert np.array_equal(result.recording.positions[10:20, 1], TRACK[10:20])
    assert result.found == {"labels": [], "peaks": []} and result.left == []
    (change,) = result.carried
    assert (change.kind, change.outcome, change.partner, change.method, change.samples) == (
        "adopted", "adopted", "*7", "adopt", 10,
    )  # fmt: skip


def test_what_is_only_reported_is_left_unless_a_person_accepts_it(recording):
    result = adoption(recording, [event("unlabelled")])
    assert given(recording, result) == [] and result.carried == []
    assert result.left[0].reason.cause is Cause.REPORTED and "*7" in result.left[0].reason.text
    accepted = adoption(recording, [event("unlabelled")], Decision("B", 0, 30, "accept", "unlabelled"))
    assert len(given(recording, accepted)) == 10 and accepted.carried[0].decisions == ("accept unlabelled",)


@pytest.mark.parametrize("decision", [Decision("B", 0, 30, "reject", "adopted"), Decision("B", 0, 30, "protect")])
def test_a_decision_against_it_holds(recording, decision):
    result = adoption(recording, [event()], decision)
    assert given(recording, result) == [] and result.left[0].reason == decision.reason


@pytest.mark.parametrize(("found", "named"), [("adopted", "unlabelled"), ("unlabelled", "adopted")])
def test_a_decision_holds_whether_such_samples_are_adopted_or_reported(recording, found, named):
    rejected = adoption(recording, [event(found)], Decision("B", 0, 30, "reject", named))
    assert given(recording, rejected) == [] and rejected.left[0].reason.cause is Cause.DECIDED
    accepted = adoption(recording, [event(found)], Decision("B", 0, 30, "accept", named))
    assert len(given(recording, accepted)) == 10 and accepted.carried[0].decisions == (f"accept {named}",)


def test_a_static_recording_stays(recording):
    result = adoption(replace(recording, facts={"kind": "static"}), [event()])
    assert given(recording, result) == [] and result.left[0].reason.cause is Cause.STATIC


def test_measured_samples_are_replaced_only_where_they_are_on_something_else(recording):
    result = adoption(recording, [event(start=6, stop=20)])
    assert given(recording, result) == [(frame, 1) for frame in range(10, 20)]
    positions = recording.positions.copy()
    positions[10:14, 1] = 5.0
    seen = replace(recording, positions=positions)
    result = adoption(seen, [FOREIGN, event()])
    assert np.array_equal(result.recording.positions[10:20, 1], TRACK[10:20])
    assert [(own.start, own.stop) for own in result.found["labels"]] == [(8, 10)]
    result = adoption(seen, [FOREIGN, event()], Decision("B", 0, 30, "reject", "foreign"))
    assert np.array_equal(result.recording.positions[10:14, 1], positions[10:14, 1])


def test_within_an_exchange_they_go_under_the_label_as_recorded(recording):
    positions = recording.positions.copy()
    positions[5:25, [0, 1]] = positions[5:25, [1, 0]]
    pair = [Event("A", 5, 25, 1.0, partner="B"), Event("B", 5, 25, 1.0, partner="A")]
    result = adoption(replace(recording, positions=positions), [*pair, event()])
    assert np.array_equal(result.recording.positions[10:20, 0], TRACK[10:20])
    assert result.found["labels"] == pair


def test_where_an_exchange_is_not_undone_they_are_recorded_under_the_label_that_gets_them(recording):
    pair = [Event("A", 15, 25, 1.0, partner="B"), Event("B", 15, 25, 1.0, partner="A")]
    result = adoption(recording, [*pair, event()])
    stated = [(own.marker, own.start, own.stop, own.samples) for own in result.carried_under(pair, [])]
    assert stated == [("A", 15, 20, 5), ("B", 10, 15, 5)]
    assert [(own.marker, own.start, own.stop) for own in result.carried_under(pair, pair)] == [("B", 10, 20)]
    protected = adoption(recording, [*pair, event()], Decision("A", 16, 17, "protect"))
    assert given(recording, protected) == [] and protected.left[0].reason.text == "a person decided: protect"
