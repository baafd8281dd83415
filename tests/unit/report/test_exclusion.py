"""What speaks against a recording is named by codes, and a recording of which nothing does has none."""

import pytest

from markermend.report.exclusion import CODES, exclusion_codes
from support.paths import PROJECT

CLEAN = {
    "status": "cleaned",
    "markers_never_seen": 0,
    "gaps_open": {"events": 0},
    "findings_open": {"events": 0},
    "unjudged": [],
    "refused_samples": 0,
}


def test_nothing_speaks_against_a_recording_that_is_complete():
    assert exclusion_codes(CLEAN) == []


@pytest.mark.parametrize(
    ("code", "change"),
    [
        ("static", {"status": "static"}),
        ("missing_marker", {"markers_never_seen": 1}),
        ("gaps_left", {"gaps_open": {"events": 2}}),
        ("artifacts_left", {"findings_open": {"events": 1}}),
        ("not_judged", {"unjudged": ["LASI"]}),
        ("refused", {"refused_samples": 3}),
    ],
)
def test_each_code_has_its_cause(code, change):
    assert exclusion_codes(CLEAN | change) == [code]


def test_several_are_listed_in_their_order_and_one_that_was_set_aside_has_no_other():
    assert exclusion_codes(CLEAN | {"unjudged": ["LASI"], "gaps_open": {"events": 2}}) == ["gaps_left", "not_judged"]
    assert exclusion_codes({"status": "set aside"}) == ["set_aside"]


def test_every_code_is_explained_to_users():
    text = (PROJECT / "README.md").read_text(encoding="utf-8")
    assert [code for code, meaning in CODES.items() if f"| `{code}` | {meaning} |" not in text] == []
