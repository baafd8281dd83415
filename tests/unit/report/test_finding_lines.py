"""The line of a finding: where its values are stated, and what a person may decide about it."""

from markermend.core.changes import Alternative, Change, Outcome
from markermend.planning.decision_cells import parse
from markermend.report.finding_lines import decidable, finding_lines
from support.small_result import RECORD

STAGES = {
    "repair": {"methods": {"peaks": ["spline", "local_ridge"], "labels": ["exchange"]}},
    "fill": {"members": ["local_gp", "spline"]},
}


def lines_of(changes, left, before, after, plots=10):
    changed, stayed = finding_lines(changes, left, before, after, plots=plots)
    return [*changed, *stayed]


def test_values_stand_where_the_change_is_largest(before, after):
    repaired, filled = Change("A", 2, 4, ("peak",), Outcome.REPAIRED), Change("B", 4, 6, ("gap",), Outcome.FILLED)
    after.positions[3, 0, 0] += 1.0
    peak, gap = lines_of([repaired, filled], [], before, after)
    assert (peak.row, peak.before, peak.after) == (3, (27.0, 28.0, 29.0), (31.0, 32.0, 29.0))
    assert (gap.row, gap.before, gap.after) == (5, None, (7.0, 7.0, 7.0))


def test_values_of_what_was_left_or_removed_stand_where_it_was_seen(before, after):
    left, removed = Change("C", 4, 9, ("peak",), Outcome.LEFT), Change("B", 0, 1, ("peak",), Outcome.BLANKED)
    gap = Change("B", 6, 7, ("gap",), Outcome.LEFT)
    blank, peak, still = lines_of([removed], [left, gap], before, after)
    assert (blank.row, blank.before, blank.after) == (0, (3.0, 4.0, 5.0), None)
    assert peak.row == 6 and peak.before == peak.after == (60.0, 61.0, 62.0)
    assert (still.row, still.before, still.after) == (None, None, None)


def test_findings_are_numbered_through_and_the_worst_have_plots(before, after):
    left = [change for change in RECORD if change.outcome is Outcome.LEFT]
    lines = lines_of([RECORD[0], RECORD[3]], left, before, after, plots=1)
    assert [line.name for line in lines] == ["finding-0", "finding-1", "finding-2", "finding-3"]
    assert [line.plotted for line in lines] == [True, False, True, False]


def test_a_person_may_name_the_methods_of_the_class(before, after):
    tried = (Alternative("local_ridge", 3.5),)
    changes = [
        Change("A", 2, 4, ("peak",), Outcome.REPAIRED, alternatives=tried),
        Change("A", 4, 5, ("swap",), Outcome.EXCHANGED, partner="C"),
        Change("A", 6, 8, ("peak", "slow"), Outcome.BLANKED),
        Change("B", 4, 6, ("gap",), Outcome.FILLED),
        Change("C", 4, 6, ("missing",), Outcome.BLANKED),
        Change("C", 7, 8, ("shift",), Outcome.LEFT, group="all"),
    ]
    stated = decidable(lines_of(changes, [], before, after), before, changes, STAGES)
    assert stated["findings"][0] == {
        "marker": "A", "markers": ["A"], "first_frame": 103, "last_frame": 104, "classes": ["peak"], "value": "peak",
        "errors": {"local_ridge": 3.5},
    }  # fmt: skip
    assert [finding["value"] for finding in stated["findings"]] == ["peak", "swap", "", "gap", None, "shift"]
    assert stated["methods"] == {
        "gap": ["local_gp", "spline", "leave"],
        "missing": ["local_gp", "spline", "leave"],
        "peak": ["spline", "local_ridge", "blank", "leave"],
        "shift": ["leave"],
        "slow": ["blank", "leave"],
        "swap": ["exchange", "leave"],
    }


def test_all_markers_of_a_joint_finding_are_named_as_in_the_table(before, after):
    slip = [Change(name, 2, 4, ("slip",), Outcome.LEFT, group="foot") for name in ("C", "A")]
    later = Change("B", 5, 6, ("slip",), Outcome.LEFT, group="foot")
    shift = [Change(name, 7, 8, ("shift",), Outcome.LEFT, group="all markers") for name in before.markers]
    stated = decidable(lines_of([slip[0], shift[0]], [], before, after), before, [*slip, later, *shift], STAGES)
    assert [finding["markers"] for finding in stated["findings"]] == [["A", "C"], ["*"]]


def test_what_a_person_may_state_of_any_frames(before, after):
    stated = decidable([], before, [], STAGES)
    assert (stated["markers"], stated["frames"], stated["findings"]) == (["A", "B", "C"], [101, 110], [])
    for name in stated["classes"]:
        row = {
            "recording": "r",
            "marker": "A",
            "decision": "class",
            "value": name,
            "first_frame": "101",
            "last_frame": "102",
        }
        assert dict(parse(row, ()))["value"] == name
    assert {"peak", "slow", "foreign"} <= set(stated["classes"]) and not {"swap", "unlabelled", "gap"} & set(
        stated["classes"]
    )
