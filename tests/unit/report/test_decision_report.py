"""Decisions on the page of a recording and in the table of changes: what was decided, what came of it, nothing hostile."""

import csv
import io
from dataclasses import replace

import numpy as np
import pytest

import qc
from markermend.core.applied_changes import applied_changes
from markermend.core.changes import Change, Outcome
from markermend.core.events import Event
from markermend.core.reasons import Cause, Reason
from markermend.core.recording import Recording
from markermend.export.change_table import change_table
from support import report_files
from unit.report.test_rendering import HOSTILE, Page

FOUND = {"peaks": [Event("A", 30, 32, 2.0), Event("B", 40, 42, 3.0)]}
ACCEPT = {"marker": "A", "decision": "accept", "note": HOSTILE}
REJECT = {"marker": "B", "decision": "reject", "first_frame": 741, "last_frame": 742}
IDLE = {"marker": "C", "decision": "accept"}


@pytest.fixture(scope="module")
def restored():
    """A recording from frame 701 on: a peak of A that a person accepted, one of B that a person rejected."""
    positions = np.random.default_rng(1).normal(0, 100, (60, 3, 3)).cumsum(axis=0)
    before = report_files.named(Recording(("A", "B", "C"), positions, 100.0, 701), "walk", "Bob")
    after = report_files.restore(before, positions + 1, FOUND, error=1.0, keep=("B",))
    repairs = [replace(change, decisions=(f"accept ({HOSTILE})",)) for change in after.repairs]
    reason = Reason(Cause.DECIDED, "a person decided: reject")
    left = [replace(change, reason=reason, decisions=("reject",)) for change in after.repairs_left]
    return before, replace(after, changes=(*repairs, *left))


@pytest.fixture(scope="module")
def made(restored, tmp_path_factory):
    folder = tmp_path_factory.mktemp("results")
    made = report_files.write(folder, *restored, FOUND, decisions=[ACCEPT, REJECT, IDLE])
    qc.main(made.qc())
    return made


def test_the_table_of_changes_says_what_a_person_decided(restored):
    before, after = restored
    text = change_table(applied_changes(before, after, after.changes), after)
    (row,) = csv.DictReader(io.StringIO(text, newline=""), delimiter="\t")
    assert (row["marker"], row["decision"]) == ("A", f"accept ({HOSTILE})")


def test_a_gap_in_place_of_a_finding_carries_the_decisions_on_both(restored):
    before, after = restored
    positions, origin = before.positions.copy(), np.zeros(before.missing.shape, np.uint8)
    positions[30:32, 0], origin[30:32, 0] = 1.0, 6
    decisions = ("method spline", "missing")
    gap = Change("A", 30, 32, ("gap",), Outcome.FILLED, method="spline", decisions=decisions)
    away = Change("A", 30, 32, ("missing",), Outcome.BLANKED, decisions=("missing",))
    filled = replace(after, positions=positions, origin=origin)
    text = change_table(applied_changes(before, filled, [away, gap]), filled)
    (row,) = csv.DictReader(io.StringIO(text, newline=""), delimiter="\t")
    assert (row["class"], row["method"], row["decision"]) == ("missing", "spline", "missing; method spline")


def test_the_page_says_what_was_decided_and_is_not_hurt_by_a_note(made):
    page = Page(made.page)
    assert f"a person decided: accept ({HOSTILE})" in page.text
    assert "a person decided: reject" in page.text
    assert "What a person decided" in page.text and "B, frames 741 to 742" in page.text
    assert {tag for tag, attributes in page.tags if "onerror" in attributes} == set()
    assert "walk\tA\t731\t732\t\t\t\tBob" in made.page


def test_what_a_person_left_wants_no_attention_and_what_did_nothing_does(made):
    summary = made.summary
    assert (summary["decisions"], summary["findings_open"]["events"]) == (3, 0)
    assert summary["warnings"] == ["decision 'accept' on C: there is no finding or gap that it changes"]
    assert summary["attention_parts"]["artifacts left"] == 0


def test_the_methods_text_tells_of_decisions_only_where_there_are_some(made, restored, tmp_path):
    assert "the decisions of that person took precedence" in made.summary["methods"]["text"]
    plain = report_files.write(tmp_path, *restored, FOUND)
    qc.main(plain.qc())
    assert "What a person decided" not in plain.page
