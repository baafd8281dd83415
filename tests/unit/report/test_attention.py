"""The score of attention, of a summary written by hand."""

import pytest

from markermend.report.attention import attention, with_attention
from support.small_result import WEIGHTS

SUMMARY = {
    "changed_share": 5 / 30, "missing_share_after": 3 / 30, "expected_error_max_mm": 6.0, "findings_open": {"events": 2, "samples": 3},
    "unjudged": [], "warnings": ["odd"],
}  # fmt: skip


def test_points_by_cause_add_up():
    scored = with_attention(SUMMARY, WEIGHTS)
    assert scored["attention"] == pytest.approx(2 * 100 * 5 / 30 + 100 * 3 / 30 + 0.5 * 6 + 3 * 2 + 10, abs=0.01)
    assert sum(scored["attention_parts"].values()) == pytest.approx(scored["attention"], abs=1e-9)
    assert {name: scored[name] for name in SUMMARY} == SUMMARY


def test_what_is_not_there_has_no_points():
    nothing = {
        "changed_share": 0, "missing_share_after": 0, "expected_error_max_mm": None, "findings_open": {"events": 0}, "unjudged": [], "warnings": [],
    }  # fmt: skip
    assert set(attention(nothing, WEIGHTS).values()) == {0}


@pytest.mark.parametrize("cause", ["unjudged", "warnings"])
def test_each_marker_and_each_warning_counts(cause):
    more = attention({**SUMMARY, cause: [*SUMMARY[cause], "a", "b"]}, WEIGHTS)
    name, points = {"unjudged": ("markers not judged", WEIGHTS.unjudged), "warnings": ("warnings", WEIGHTS.warning)}[
        cause
    ]
    assert more[name] - attention(SUMMARY, WEIGHTS)[name] == pytest.approx(2 * points)
