"""Lists of words and limits, as sentences have them."""

from markermend.report.phrases import LIMITS, enumeration, limits


def test_enumerations():
    assert [enumeration(words) for words in ([], ["a"], ["a", "b"], ["a", "b", "c"])] == [
        "",
        "a",
        "a and b",
        "a, b and c",
    ]


def test_limits_are_joined_and_absent_ones_left_out():
    assert (
        limits({"max_gap_s": 2.0, "max_error_mm": 50}) == " of at most 2 s and with an expected error of at most 50 mm"
    )
    assert limits({"max_gap_s": None}) == limits({}) == ""
    assert all("{:g}" in phrase for phrase in LIMITS.values())
