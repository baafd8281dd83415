"""A decision: which markers and frames it is about."""

import pytest

from markermend.core.decisions import EVER, Decision, read

STRETCH = (["LANK"], 10, 20)


def test_frames_are_the_capture_programs_and_inclusive():
    entries = [
        {"marker": "LANK", "decision": "reject", "first_frame": 705, "last_frame": 706, "value": "peak", "note": "hop"},
        {"marker": "L*", "decision": "protect", "by": "A.L.", "date": "2026-03-31"},
    ]
    assert read(entries, first_frame=701) == [
        Decision("LANK", 4, 6, "reject", "peak", "hop"),
        Decision("L*", -EVER, EVER, "protect", by="A.L.", date="2026-03-31"),
    ]


@pytest.mark.parametrize(
    ("remarks", "words"),
    [
        ({}, "reject peak"),
        ({"note": "hop"}, "reject peak (hop)"),
        ({"by": "A.L."}, "reject peak (A.L.)"),
        ({"note": "hop", "date": "2026-03-31"}, "reject peak (hop; 2026-03-31)"),
        ({"note": "hop", "by": "王", "date": "2026-03-31"}, "reject peak (hop; 王, 2026-03-31)"),
    ],
)
def test_what_is_remarked_stands_behind_the_words_of_the_table(remarks, words):
    decision = Decision("LANK", 4, 6, "reject", "peak", **remarks)
    assert (decision.text, decision.words) == ("reject peak", words)


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
