"""A ruling: what follows from several decisions on one stretch."""

import pytest

from markermend.core.artifacts import BY_NAME
from markermend.core.changes import GAP
from markermend.core.decisions import Decision, protecting
from markermend.core.reasons import Cause, Reason
from markermend.core.rulings import Ruling, rule

STRETCH = (["LANK"], 10, 20)


@pytest.mark.parametrize("kind", [*BY_NAME, GAP])
@pytest.mark.parametrize("verb", ["accept", "reject"])
def test_without_a_class_all_artifacts_are_meant_and_no_gap(verb, kind):
    general, special = (rule([Decision("L*", 0, 99, verb, value)], [kind], *STRETCH) for value in ("", kind))
    assert (general == Ruling()) == (kind == GAP)
    assert special.confirmed == (verb == "accept") and (special.left is None) == (verb == "accept")
    assert rule([Decision("L*", 0, 99, verb, "other")], [kind], *STRETCH) == Ruling()


def test_without_decisions_nothing_follows():
    assert rule([], ["peak"], *STRETCH) == Ruling(None, False, None, ())


def test_how_and_whether_are_two_decisions():
    decided = [Decision("LANK", 0, 12, "accept", note="sure"), Decision("LANK", 15, 30, "method", "spline")]
    assert rule(decided, ["slow"], *STRETCH) == Ruling(None, True, "spline", ("accept", "method spline"))
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


def test_an_option_is_not_a_person():
    (option,) = protecting(["L*"])
    assert rule([option], ["peak"], *STRETCH) == Ruling(Reason(Cause.PROTECTED, "protected"))
