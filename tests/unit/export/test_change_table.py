"""changes.tsv: one row for each change, in the capture program's frames, with figures for people."""

import csv
import io
from dataclasses import replace

import numpy as np
import pytest

from markermend.core.applied_changes import applied_changes
from markermend.core.changes import Alternative, Change, Outcome
from markermend.core.events import Event
from markermend.core.reasons import Cause, Reason
from markermend.core.recording import Recording
from markermend.export.change_table import COLUMNS, change_table
from support import report_files
from support.html_pages import HOSTILE

CHANGES = [
    Change(
        "A", 5, 9, ("step",), Outcome.REPAIRED, 3.0004, "xz", None, "offset",
        (Alternative("offset", 0.5), Alternative("local_ridge", 2.345)),
        samples=4, largest_change_mm=20.785, expected_error_mm=0.5,
        expected_error95_mm=1.25, decisions=("accept (hop)", "method offset"),
    ),
    Change("A", 12, 14, ("swap",), Outcome.EXCHANGED, 9.0, "xyz", "B", "swap", samples=2, largest_change_mm=80.0),
    Change("B", 20, 25, ("gap",), Outcome.FILLED, method="linear", samples=5, expected_error_mm=1.5),
    Change('C"\t\n', 30, 32, ("peak", "slow"), Outcome.BLANKED, 2.0, "y", samples=2),
]  # fmt: skip


def rows(changes):
    recording = Recording((), np.empty((0, 0, 3)), 100.0, 701, {"recording": "walk"})
    return list(csv.DictReader(io.StringIO(change_table(changes, recording), newline=""), delimiter="\t"))


def test_frames_are_the_capture_programs_and_both_are_part_of_the_change():
    assert [(r["marker"], r["class"], r["method"], r["first_frame"], r["last_frame"]) for r in rows(CHANGES)] == [
        ("A", "step", "offset", "706", "709"),
        ("A", "swap", "swap", "713", "714"),
        ("B", "filled", "linear", "721", "725"),
        ('C"\t\n', "peak+slow", "blanked", "731", "732"),
    ]


def test_figures_are_blank_where_there_are_none():
    step, swap, fill, blanked = rows(CHANGES)
    assert (step["recording"], step["start_s"], step["stop_s"], step["score"]) == ("walk", "0.05", "0.09", "3.0")
    assert (step["largest_change_mm"], step["expected_error_mm"], step["samples"]) == ("20.785", "0.5", "4")
    assert (step["expected_error95_mm"], swap["expected_error95_mm"]) == ("1.25", "")
    assert step["alternatives"] == "local_ridge 2.3 mm; offset 0.5 mm"
    assert step["decision"] == "accept (hop); method offset"
    assert (fill["score"], fill["largest_change_mm"], fill["alternatives"]) == ("", "", "")
    assert [row["axes"] for row in (step, swap, blanked)] == ["xz", "xyz", ""]
    assert (swap["partner"], blanked["partner"]) == ("B", "")


def test_what_is_only_reported_says_why_it_is_left():
    reason = Reason(Cause.REPORTED, "23.0 mm off where it was before: measure again")
    found = Change("LTIB", 50, 900, ("displaced",), Outcome.LEFT, 4.0, "xz", samples=850, reason=reason)
    [row] = rows([found])
    assert (row["marker"], row["class"], row["method"], row["reason"]) == ("LTIB", "displaced", "reported", reason.text)
    assert (row["start_s"], row["stop_s"], row["largest_change_mm"]) == ("0.5", "9.0", "")


def test_without_changes_there_is_a_header():
    assert change_table([], Recording((), np.empty((0, 0, 3)), 1.0)) == "\t".join(COLUMNS) + "\n"


FOUND = {"peaks": [Event("A", 30, 32, 2.0), Event("B", 40, 42, 3.0)]}


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
