"""Which gaps may be filled: every rule by itself, with the limit that caused it."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.reasons import Cause, Reason
from markermend.core.rulings import Ruling
from markermend.core.shape import Shape
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
            "not seen on both sides for long enough (advanced.fill.border_s: 0.05), nor rigid with 3 seen markers; "
            "without the short pieces: at the recording's start",
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


def eligibility(pieces, *, shape=None, start=200, stop=260, **limits):
    """The rules for B1 in 600 frames of 100 Hz, seen in [start, stop) on some frames alone."""
    positions = rigid_body(frames=600, markers=4)
    hidden = np.setdiff1d(np.arange(start, stop), pieces)
    positions[hidden, 2] = np.nan
    return Eligibility(restored(positions, markers=NAMES), fill_options(**limits), shape=shape)


def spread(*values):
    """A shape in which the distances of B1 to A1, A2 and B2 have these spreads."""
    known = np.full((4, 4), np.nan)
    known[2, [0, 1, 3]] = values
    return Shape(known, known, known)


def test_a_gap_between_short_pieces_may_be_filled_if_it_could_be_without_them():
    found = eligibility([220, 240])
    assert found.reason_to_leave(Gap(2, 221, 240), Ruling()) is None
    assert found.checked_stretch(Gap(2, 221, 240)) == Gap(2, 200, 260)
    reason = eligibility([220, 240], max_gap_s=0.5).reason_to_leave(Gap(2, 221, 240), Ruling())
    assert (reason.cause, reason.limit.actual) == (Cause.BORDER, 0.01)
    assert reason.text.endswith("without the short pieces: fill.max_gap_s: 0.5")


@pytest.mark.parametrize(
    ("spreads", "filled"), [((1.0, 1.0, 1.0), True), ((1.0, 1.0, 4.0), False), ((1.0, 1.0, np.nan), False)]
)
def test_a_rigid_marker_needs_no_border(spreads, filled):
    own = Gap(2, 21, 40)
    for limits in ({"start": 0, "stop": 60}, {"start": 1, "stop": 60, "max_gap_s": 0.3}):
        found = eligibility([20, 40], shape=spread(*spreads), **limits)
        assert (found.reason_to_leave(own, Ruling()) is None) == filled
        assert found.reason_to_leave(Gap(2, 0, 20), Ruling()) is not None


def test_its_mates_must_be_seen_throughout_the_gap():
    found = eligibility([20, 40], shape=spread(1.0, 1.0, 1.0), start=0, stop=60)
    found.restored.positions[30, 3] = np.nan
    assert found.reason_to_leave(Gap(2, 21, 40), Ruling()).cause is Cause.BORDER
    assert found.reason_to_leave(Gap(2, 41, 60), Ruling()) is None


def test_pieces_longer_than_a_border_are_checked_too_where_the_gap_could_be_filled_without_them():
    pieces, gap = [220, 221, 222], Gap(2, 200, 220)
    assert eligibility(pieces).checked_stretch(gap) == Gap(2, 200, 260)
    assert eligibility(pieces, checked_piece_s=0.03).checked_stretch(gap) is None
    assert eligibility(pieces, max_gap_s=0.5).checked_stretch(gap) is None
    assert eligibility(pieces, max_gap_s=0.5).reason_to_leave(gap, Ruling()) is None


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
