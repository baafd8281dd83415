"""The plan: which gaps are filled, in which order, and what a person's decisions change."""

import numpy as np

from markermend.core.decisions import Decision
from markermend.core.reasons import Cause
from markermend.core.recording import ORIGINS
from markermend.filling.fill_plan import plan_filling
from markermend.filling.gap import Gap
from support.fillings import fill_options, restored, rigid_body

GAPS = [Gap(0, 100, 120), Gap(1, 50, 60), Gap(2, 200, 215), Gap(2, 240, 250), Gap(3, 10, 300)]


def plan(decisions=(), methods=("spline",), *, peaks=0, **limits):
    positions = rigid_body(frames=600, markers=6)
    for gap in GAPS:
        positions[gap.samples] = np.nan
    recording = restored(positions)
    recording.origin[:peaks, 5] = ORIGINS.index("peak")
    return plan_filling(recording, fill_options(**limits), decisions=decisions, methods=methods)


def decide(verb, value, gap):
    return Decision(f"M{gap.marker}", gap.start, gap.start + 1, verb, value)


def test_gaps_of_the_marker_seen_most_come_first():
    found = plan()
    assert list(found.rulings) == GAPS
    assert found.ordinary == (GAPS[1], GAPS[0], GAPS[2], GAPS[3]) and not found.confirmed
    assert {gap: reason.cause for gap, reason in found.refused.items()} == {GAPS[4]: Cause.TOO_LONG}
    # Of two markers that are seen equally often the first comes first.
    assert plan(max_gap_s=None).ordinary == (GAPS[1], GAPS[0], GAPS[2], GAPS[3], GAPS[4])


def test_confirmed_gaps_are_grouped_by_method():
    decisions = [
        decide("accept", "gap", GAPS[4]),
        decide("method", "spline", GAPS[0]),
        decide("method", "spline", GAPS[2]),
    ]
    found = plan(decisions)
    assert found.confirmed == {"": (GAPS[4],), "spline": (GAPS[0], GAPS[2])}
    assert found.ordinary == (GAPS[1], GAPS[3]) and not found.refused
    # A method that fills no gaps decides nothing about them.
    assert plan([decide("method", "savitzky_golay", GAPS[0])]).ordinary == plan().ordinary


def test_a_gap_that_a_person_rejects_is_refused_with_the_decision():
    found = plan([decide("reject", "gap", GAPS[1])])
    assert found.refused[GAPS[1]].cause is Cause.DECIDED and GAPS[1] not in found.ordinary


def test_nothing_but_confirmed_gaps_is_filled_where_too_much_would_be_altered():
    share = (20 + 10 + 15 + 10) / 3600
    assert plan(max_altered_share=share + 1e-9).ordinary
    for changed in ({"max_altered_share": share - 1e-9}, {"max_altered_share": share + 1e-9, "peaks": 1}):
        found = plan([decide("accept", "gap", GAPS[4])], **changed)
        assert found.ordinary == () and found.confirmed == {"": (GAPS[4],)}
        reason = found.refused[GAPS[0]]
        assert (reason.cause, reason.limit.setting) == (Cause.TOO_MUCH, "fill.max_altered_share")
        assert reason.limit.actual > reason.limit.value
