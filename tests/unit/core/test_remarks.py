"""Remarks on decisions are kept from what is computed, and are back in what people read."""

import pytest

from markermend.core.changes import Change, Outcome
from markermend.core.decisions import Decision
from markermend.core.reasons import Cause, Reason
from markermend.core.remarks import with_remarks, without_remarks

TAPED = Decision("LANK", 4, 9, "reject", "peak", "taped", "A.L.", "2026-03-31")


def left(marker="LANK", start=5, stop=6, **parts):
    reason = Reason(Cause.DECIDED, "a person decided: reject peak")
    return Change(marker, start, stop, ("peak",), Outcome.LEFT, decisions=("reject peak",), reason=reason, **parts)


def test_what_differs_in_remarks_alone_is_one_decision():
    bare = {"marker": "LANK", "decision": "reject", "value": "peak"}
    other = {"marker": "LANK", "decision": "accept"}
    assert without_remarks([{**bare, "note": "hop", "by": "A.L."}, other, {**bare, "date": "2026-03-31"}]) == [
        bare,
        other,
    ]


def test_decision_and_reason_have_the_remarks():
    (change,) = with_remarks([left()], [TAPED])
    assert change.decisions == ("reject peak (taped; A.L., 2026-03-31)",)
    assert change.reason == Reason(Cause.DECIDED, "a person decided: reject peak (taped; A.L., 2026-03-31)")


@pytest.mark.parametrize(
    "other",
    [
        Decision("RANK", 4, 9, "reject", "peak", by="B.K."),
        Decision("LANK", 6, 9, "reject", "peak", by="B.K."),
        Decision("LANK", 4, 9, "reject", by="B.K."),
    ],
)
def test_remarks_on_other_decisions_are_not_taken_for_them(other):
    assert with_remarks([left()], [other, TAPED]) == with_remarks([left()], [TAPED])
    assert with_remarks([left(group="all markers")], [other, TAPED]) == with_remarks(
        [left(group="all markers")], [TAPED]
    )


def test_who_decided_the_same_is_named_side_by_side():
    (change,) = with_remarks([left()], [TAPED, Decision("L*", 0, 99, "reject", "peak", by="B.K.")])
    assert change.decisions == ("reject peak (taped; A.L., 2026-03-31)", "reject peak (B.K.)")
    assert change.reason.text == "a person decided: reject peak (taped; A.L., 2026-03-31); reject peak (B.K.)"


def test_a_decision_on_one_marker_of_a_joint_finding_is_remarked_on_all():
    changes = with_remarks([left("RANK", group="all markers"), left(group="all markers")], [TAPED])
    assert changes[0].decisions == changes[1].decisions == ("reject peak (taped; A.L., 2026-03-31)",)


def test_changes_without_decisions_stay_as_they_are():
    change = Change("LANK", 5, 6, ("peak",), Outcome.LEFT, reason=Reason(Cause.UNCERTAIN, "reject peak"))
    assert with_remarks([change], [TAPED]) == (change,)
