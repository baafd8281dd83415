"""Which gaps may be filled: every rule by itself, with the limit that caused it."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.reasons import Cause, Reason
from markermend.core.rulings import Ruling
from markermend.filling.eligibility import Eligibility, max_gap_s
from markermend.filling.gap import Gap
from support.fillings import fill_options, restored, rigid_body

NAMES = ("A1", "A2", "B1", "B2")


def reason(start, stop, *, facts=None, ruling=None, blanked=(), **limits):
    """The reason for a gap of B1 in 600 frames of 100 Hz."""
    positions = rigid_body(frames=600, markers=4)
    positions[start:stop, 2] = np.nan
    recording = replace(restored(positions, markers=NAMES), facts=facts or {})
    eligibility = Eligibility(recording, fill_options(**limits), frozenset(blanked))
    return eligibility.reason_to_leave(Gap(2, start, stop), ruling or Ruling())


@pytest.mark.parametrize(
    ("gap", "limits", "cause", "text", "limit"),
    [
        ((100, 350), {}, Cause.TOO_LONG, "gap of 2.50 s (fill.max_gap_s: 2)", (2.0, 2.5)),
        ((0, 20), {}, Cause.AT_END, "at the recording's start", None),
        ((590, 600), {}, Cause.AT_END, "at the recording's end", None),
        ((0, 600), {}, Cause.NEVER_SEEN, "never seen", None),
        ((50, 500), {}, Cause.SELDOM_SEEN, "marker seen in 25% of the frames (fill.min_seen_share: 0.3)", (0.3, 0.25)),
        ((200, 220), {"protect": ["?1", "NECK"]}, Cause.PROTECTED, "protected marker", None),
        (
            (1, 20),
            {"border_s": 0.05},
            Cause.BORDER,
            "not seen on both sides for long enough (advanced.fill.border_s: 0.05)",
            (0.05, 0.01),
        ),
    ],
)
def test_what_stays_open_says_why(gap, limits, cause, text, limit):
    found = reason(*gap, **limits)
    assert (found.cause, found.text) == (cause, text)
    assert (None if found.limit is None else (found.limit.value, found.limit.actual)) == limit


@pytest.mark.parametrize(
    ("gap", "limits"),
    [
        ((200, 220), {}),
        ((0, 20), {"fill_ends": True}),
        ((100, 350), {"max_gap_s": None}),
        ((2, 20), {"border_s": 0.02}),
    ],
)
def test_what_may_be_filled_has_no_reason(gap, limits):
    assert reason(*gap, **limits) is None


def test_a_border_must_be_seen_without_a_break():
    positions = rigid_body(frames=600, markers=4)
    positions[[200, 201, 202, 210], 2] = np.nan
    for border_s, expected in ((0.05, None), (0.08, 0.07)):
        eligibility = Eligibility(restored(positions), fill_options(border_s=border_s))
        found = eligibility.reason_to_leave(Gap(2, 200, 203), Ruling())
        assert (found and found.limit.actual) == expected


def test_a_marker_that_repair_took_away_was_seen():
    found = reason(0, 600, blanked=["B1"])
    assert found.text == "nothing of it was left to learn from"


def test_a_static_recording_is_not_touched():
    assert reason(200, 220, facts={"kind": "static"}).cause is Cause.STATIC


def test_a_decision_outweighs_limits_but_not_what_is_certain():
    confirmed = Ruling(confirmed=True)
    assert reason(100, 350, ruling=confirmed) is None
    assert reason(0, 600, ruling=confirmed).cause is Cause.NEVER_SEEN
    left = reason(200, 220, ruling=Ruling(left=Reason(Cause.DECIDED, "a person decided: reject gap")))
    assert (left.cause, left.text) == (Cause.DECIDED, "a person decided: reject gap")


def test_the_last_pattern_that_fits_gives_the_longest_gap():
    options = fill_options(max_gap_s=2.0, max_gap_s_of={"B*": 0.5, "B1": 1.0, "C*": 3.0})
    assert [max_gap_s(name, options) for name in ("A1", "B1", "B2")] == [2.0, 1.0, 0.5]
