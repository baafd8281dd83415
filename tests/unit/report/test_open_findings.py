"""Changes are listed worst first, and what was left is listed with its reason."""

from dataclasses import replace

from markermend.core.applied_changes import applied_changes
from markermend.core.changes import Change, Outcome
from markermend.core.reasons import UNSTATED
from markermend.report.open_findings import joined, left_open, open_gaps, reasons_for_blanking, worst_first
from support.small_result import FOUND, RECORD


def test_changes_are_listed_worst_first(changes):
    assert [(c.kind, c.marker, c.start, c.stop) for c in changes] == [
        ("gap", "B", 4, 6),
        ("peak", "A", 2, 4),
        ("peak+slow", "B", 0, 1),
    ]
    peak = changes[1]
    assert (peak.score, peak.axes, peak.method, peak.samples, peak.largest_change_mm) == (2.5, "xz", "pchip", 2, 5.0)
    assert reasons_for_blanking(changes, RECORD) == {changes[2]: "peak+slow: too uncertain"}
    assert changes[0].largest_change_mm is None


def test_a_recording_that_nothing_was_done_to_has_no_changes(before, after):
    unchanged = replace(after, positions=before.positions)
    assert worst_first(applied_changes(before, unchanged, [])) == [] and reasons_for_blanking([], []) == {}


def test_left_open_states_what_and_why(after, changes):
    left = left_open(after, FOUND, changes, RECORD)
    found = [(f.kind, f.marker, f.start, f.stop, f.reason.text) for f in left]
    assert found == [
        ("peak", "C", 6, 7, "protected"),
        ("swap", "B", 8, 10, UNSTATED.text),
        ("gap", "B", 0, 1, UNSTATED.text),
        ("gap", "B", 6, 7, "no neighbours"),
        ("gap", "C", 9, 10, UNSTATED.text),
    ]
    assert (left[0].score, left[1].partner) == (4.0, "C")


def test_gaps_are_listed_longest_first(before, after):
    restored = replace(after, positions=before.positions)
    assert [(g.marker, g.samples) for g in open_gaps(restored, RECORD)] == [("B", 3), ("C", 1)]


def test_a_joint_finding_is_listed_once_with_its_worst_marker():
    bare = Change(
        "A", 3, 6, ("peak",), Outcome.REPAIRED, method="spline", samples=3, largest_change_mm=2.0, group="hand"
    )
    other = replace(bare, marker="B", start=4, stop=7, method="local_ridge", largest_change_mm=5.0)
    single = replace(bare, marker="C", group=None)
    assert joined([bare, single, other, replace(bare, start=20, stop=22, samples=2)]) == [
        single,
        replace(other, start=3, method="spline, local_ridge", samples=6),
        replace(bare, start=20, stop=22, samples=2),
    ]


def test_every_second_frame_that_repeats_is_listed_as_one_stretch():
    each = [
        Change(m, k, k + 1, ("repeat",), Outcome.REPAIRED, samples=1, group="all") for m in "AB" for k in (3, 5, 7, 20)
    ]
    assert [(one.start, one.stop, one.samples) for one in joined(each)] == [(3, 8, 6), (20, 21, 2)]
