"""A decision: which markers and frames it is about, and what several come to together."""

import pytest

from markermend.core.artifacts import BY_NAME, DETECTORS
from markermend.core.changes import GAP
from markermend.core.decisions import EVER, Decision, Ruling, class_name, protecting, read, rule
from markermend.core.events import Event
from markermend.core.reasons import Cause, Reason

STRETCH = (["LANK"], 10, 20)


def test_frames_are_the_capture_programs_and_inclusive():
    entries = [
        {"marker": "LANK", "decision": "reject", "first_frame": 705, "last_frame": 706, "value": "peak", "note": "hop"},
        {"marker": "L*", "decision": "protect"},
    ]
    assert read(entries, first_frame=701) == [
        Decision("LANK", 4, 6, "reject", "peak", "hop"),
        Decision("L*", -EVER, EVER, "protect"),
    ]


@pytest.mark.parametrize(
    ("pattern", "marker", "fits"),
    [
        ("LANK", "LANK", True),
        ("LANK", "LANKX", False),
        ("L*", "LANK", True),
        ("L???", "LANK", True),
        ("L?", "LANK", False),
        ("lank", "LANK", False),
        ("M[1]", "M[1]", True),
        ("M[1]", "M1", False),
        ("M[*", "M[1]", True),
        ("Bob:*", "Bob:LANK", True),
    ],
)
def test_markers_are_named_or_fit_a_pattern(pattern, marker, fits):
    assert Decision(pattern, 0, 1, "protect").matches(marker) is fits


@pytest.mark.parametrize(("start", "stop", "shares"), [(0, 10, False), (0, 11, True), (19, 30, True), (20, 30, False)])
def test_one_frame_in_common_is_enough(start, stop, shares):
    assert Decision("LANK", start, stop, "accept").on(*STRETCH) is shares


def test_a_finding_is_named_as_in_the_table_of_changes():
    kinds = [class_name(stage, Event("A", 0, 1, 1.0)) for stage in DETECTORS]
    assert kinds == ["swap", "frozen", "tail", "peak", "noise", "step", "slow"]
    assert class_name("labels", Event("A", 0, 1, 1.0, "xyz", "B")) == "swap"


@pytest.mark.parametrize("kind", [*BY_NAME, GAP])
@pytest.mark.parametrize("verb", ["accept", "reject"])
def test_without_a_class_all_artifacts_are_meant_and_no_gap(verb, kind):
    general, special = (rule([Decision("L*", 0, 99, verb, value)], [kind], *STRETCH) for value in ("", kind))
    assert (general == Ruling()) == (kind == GAP)
    assert special.confirmed == (verb == "accept") and (special.left is None) == (verb == "accept")
    assert rule([Decision("L*", 0, 99, verb, "other")], [kind], *STRETCH) == Ruling()


def test_nobody_decided_anything():
    assert rule([], ["peak"], *STRETCH) == Ruling(None, False, None, ())


def test_how_and_whether_are_two_decisions():
    decided = [Decision("LANK", 0, 12, "accept", note="sure"), Decision("LANK", 15, 30, "method", "spline")]
    assert rule(decided, ["slow"], *STRETCH) == Ruling(None, True, "spline", ("accept (sure)", "method spline"))
    assert rule(decided, [GAP], *STRETCH, methods={"linear"}) == Ruling()


@pytest.mark.parametrize(
    ("stronger", "weaker"),
    [
        ("protect", "reject"),
        ("protect", "accept"),
        ("protect", "method spline"),
        ("reject", "accept"),
        ("reject", "method spline"),
        ("method leave", "accept"),
    ],
)
@pytest.mark.parametrize("turn", [1, -1])
def test_what_keeps_samples_is_stronger_than_what_changes_them(stronger, weaker, turn):
    decided = [Decision("LANK", n, n + 11, *text.split()) for n, text in enumerate((stronger, weaker))]
    ruling = rule(decided[::turn], ["peak"], *STRETCH)
    assert ruling == Ruling(Reason(Cause.DECIDED, f"a person decided: {stronger}"), texts=(stronger,))


def test_a_setting_is_not_a_person():
    (setting,) = protecting(["L*"])
    assert rule([setting], ["peak"], *STRETCH) == Ruling(Reason(Cause.PROTECTED, "protected"))
