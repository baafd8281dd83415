"""One finding: repaired by the best candidate, or left or taken away for a reason; a person outweighs every limit."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.decisions import Decision
from markermend.core.events import Event, mask
from markermend.core.reasons import Cause
from markermend.core.recording import MISSING
from support import bodies
from support.repairs import MARKER, METHODS, START, STOP, Vague, body, decide, distorted, error, mend, usual_shape
from support.signals import detect, neighbours, put
from support.treated import expected

SLOW = {"slow": [Event(MARKER, START, STOP, 4.0)]}


@pytest.fixture(scope="module")
def clean():
    return body()


@pytest.fixture(scope="module")
def drifting(clean):
    return distorted(clean, 20.0)


def test_overlapping_classes_become_a_gap(clean):
    recording = distorted(clean, 20.0)
    found = {"peaks": [Event(MARKER, 610, 613, 2.0)], "slow": [Event(MARKER, START, STOP, 4.0)]}
    result = mend(recording, found)
    m = clean.markers.index(MARKER)
    assert np.isnan(result.positions[START:STOP, m]).all()
    assert (result.origin[START:STOP, m] == MISSING).all()
    (left,) = result.repairs_left
    assert (left.kind, left.start, left.stop, left.outcome) == ("peak+slow", START, STOP, "blanked")


def test_what_cannot_be_repaired_reliably_becomes_missing_with_a_reason(clean):
    recording = distorted(clean, 20.0)
    for changes, reason in (
        ({"max_error_mm": 1e-6}, "repair.max_error_mm: 1e-06"),
        ({"max_repair_s": 0.1}, "repair.max_repair_s: 0.1"),
    ):
        result = mend(recording, {"slow": [Event(MARKER, START, STOP, 4.0)]}, **changes)
        assert np.isnan(result.positions[START:STOP, clean.markers.index(MARKER)]).all()
        assert reason in result.repairs_left[0].reason.text
        assert not result.repairs


@pytest.mark.parametrize(
    ("changes", "facts", "reason"),
    [
        ({"protect": ["2*"]}, {}, "protected"),
        ({"max_altered_share": 0.0001}, {}, "repair.max_altered_share: 0.0001"),
        ({}, {"kind": "static"}, "static"),
    ],
)
def test_refusals_leave_every_sample(clean, changes, facts, reason):
    recording = bodies.recording(clean.markers, distorted(clean, 20.0).positions, **facts)
    result = mend(recording, {"slow": [Event(MARKER, START, STOP, 4.0)]}, **changes)
    assert np.array_equal(result.positions, recording.positions)
    (left,) = result.repairs_left
    assert reason in left.reason.text and left.outcome == "left"


@pytest.mark.parametrize(("stage", "kind"), [("frozen", "frozen"), ("tails", "tail")])
def test_what_was_not_measured_is_missing_says_so_and_can_be_kept(clean, stage, kind):
    recording = distorted(clean, 20.0)
    found = {stage: [Event(MARKER, START, STOP, 4.0)]}
    result = mend(recording, found)
    assert np.isnan(result.positions[START:STOP, clean.markers.index(MARKER)]).all()
    (left,) = result.repairs_left
    assert (left.kind, left.outcome, left.reason.text[:12]) == (kind, "blanked", "not measured")
    decided = [Decision(MARKER, START, STOP, "reject", kind)]
    assert np.array_equal(mend(recording, found, decisions=decided).positions, recording.positions)
    static = bodies.recording(clean.markers, recording.positions, kind="static")
    assert np.array_equal(mend(static, found).positions, recording.positions)


def test_missing_samples_inside_a_finding_stay_missing(clean):
    recording = distorted(clean, 20.0)
    m = clean.markers.index(MARKER)
    recording.positions[615:620, m] = np.nan
    result = mend(recording, {"slow": [Event(MARKER, START, STOP, 4.0)]})
    assert np.isnan(result.positions[615:620, m]).all()
    assert (result.origin[615:620, m] == MISSING).all()


@pytest.mark.parametrize(
    "limits", [{"max_altered_share": 0.00001}, {"max_error_mm": 1e-6}, {"max_repair_s": 0.1}, {}], ids=str
)
def test_what_a_person_accepts_is_repaired_whatever_the_limits(clean, drifting, limits):
    result = mend(drifting, SLOW, decisions=[decide("accept", note="taped")], **limits)
    assert error(clean, result).max() < 1
    (repair,) = result.repairs
    assert (repair.method, repair.decisions) == ("local_ridge", ("accept",))
    assert result.repairs_left == []


def test_the_limit_still_holds_for_all_else(clean, drifting):
    other = Event("1a", 900, 940, 5.0)
    found = {"slow": [*SLOW["slow"], other]}
    result = mend(drifting, found, decisions=[decide("accept")], max_altered_share=0.00001)
    assert [repair.marker for repair in result.repairs] == [MARKER]
    (left,) = result.repairs_left
    assert left.marker == "1a" and "repair.max_altered_share" in left.reason.text and not left.decisions


@pytest.fixture(scope="module")
def shape(clean):
    return usual_shape(clean.positions)


def test_a_repair_away_from_the_usual_shape_is_not_made(clean, shape):
    """The prediction is off, the marker is not: its distances to the others of its segment say so."""
    off = Vague(clean, "local_ridge", deviation=1.0)
    assert np.allclose(error(clean, mend(clean, SLOW, extra=off)), 12)
    result = mend(clean, SLOW, extra=off, shape=shape)
    assert np.array_equal(result.positions, clean.positions)
    (left,) = result.repairs_left
    assert (left.outcome, left.reason.cause) == ("left", Cause.AGAINST_SHAPE)
    assert "expected" in left.reason.text and "repaired" in left.reason.text
    accepted = mend(clean, SLOW, extra=off, shape=shape, decisions=[decide("accept")])
    assert np.allclose(error(clean, accepted), 12)


def test_a_repair_back_to_the_usual_shape_is_made(clean, drifting, shape):
    assert error(clean, mend(drifting, SLOW, shape=shape)).max() < 1


@pytest.mark.parametrize(
    ("found", "changes"),
    [
        (SLOW, {"methods": {**METHODS, "slow": ["vague"]}}),
        (SLOW, {"max_repair_s": 0.1}),
        ({"peaks": [Event(MARKER, 610, 613, 2.0)], **SLOW}, {}),
    ],
)
def test_samples_without_a_repair_are_taken_away_only_where_the_shape_contradicts_them(
    clean, drifting, shape, found, changes
):
    nothing = Vague(clean, off=np.nan)
    kept = mend(clean, found, shape=shape, extra=nothing, **changes)
    assert np.array_equal(kept.positions, clean.positions)
    (left,) = kept.repairs_left
    assert (
        left.outcome == "left" and "kept as measured: the distances to its neighbours are usual (" in left.reason.text
    )
    gone = mend(drifting, found, shape=shape, extra=nothing, **changes)
    assert np.isnan(gone.positions[START:STOP, clean.markers.index(MARKER)]).all()
    assert gone.repairs_left[0].outcome == "blanked"


def test_no_guard_vetoes_a_person(clean):
    methods = {**METHODS, "slow": ["vague"]}
    result = mend(clean, SLOW, methods=methods, extra=Vague(clean), decisions=[decide("accept")])
    assert np.allclose(error(clean, result), 12)
    assert result.error[START, clean.markers.index(MARKER)] == pytest.approx(18.0)


@pytest.mark.parametrize("method", ["linear", "spline", "savitzky_golay"])
def test_the_method_is_the_persons(drifting, method):
    result = mend(drifting, SLOW, decisions=[decide("method", method)])
    (repair,) = result.repairs
    assert (repair.method, repair.decisions) == (method, (f"method {method}",))


def test_one_method_for_kinds_that_overlap(clean, drifting):
    found = {"peaks": [Event(MARKER, 610, 613, 2.0)], **SLOW}
    result = mend(drifting, found, decisions=[decide("method", "local_ridge")])
    (repair,) = result.repairs
    assert (repair.kind, repair.start, repair.stop, repair.score) == ("slow", START, STOP, 4.0)
    assert error(clean, result).max() < 1


def test_a_method_that_only_fills_makes_a_gap(clean, drifting):
    result = mend(drifting, SLOW, decisions=[decide("method", "kalman")])
    m = clean.markers.index(MARKER)
    assert np.isnan(result.positions[START:STOP, m]).all()
    (left,) = result.repairs_left
    assert (left.reason.text, left.outcome) == ("to be filled by kalman", "blanked")


@pytest.mark.parametrize("limit", [5.0, 100.0])
def test_what_a_repair_would_not_better_stays_as_measured(clean, limit):
    methods = {**METHODS, "slow": ["vague"]}
    result = mend(
        clean,
        {"slow": [Event(MARKER, START, STOP, 1.1)]},
        methods=methods,
        max_error_mm=limit,
        extra=Vague(clean),
    )
    assert np.array_equal(result.positions, clean.positions)
    (left,) = result.repairs_left
    assert left.outcome == "left" and expected(left) == {"vague": 18.0}
    assert "vague: expected error 18.0 mm for a change of 12.0 mm" in left.reason.text


def test_a_sure_repair_away_from_the_neighbours_is_undone_unless_a_person_wants_it(clean):
    recording = distorted(clean, np.array([5.0, 0.0, 0.0]))
    found = {"slow": [Event(MARKER, START, STOP, 1.1)]}
    given = {"methods": {**METHODS, "slow": ["vague"]}, "extra": Vague(clean, off=30.0, deviation=0.1)}
    result = mend(recording, found, **given)
    assert np.array_equal(result.positions, recording.positions)
    assert "30.0 mm from where the neighbours predict it, measured 5.0 mm" in result.repairs_left[0].reason.text
    wanted = mend(recording, found, decisions=[Decision(MARKER, START, STOP, "accept", "slow")], **given)
    assert wanted.repairs[0].method == "vague"


@pytest.mark.parametrize("off", [{"deviation": 50.0}, {"off": 30.0, "deviation": 0.1}, {"deviation": 1.0}], ids=str)
def test_without_objections_every_finding_is_repaired(clean, shape, off):
    methods = {**METHODS, "slow": ["vague"]}
    given = {"methods": methods, "extra": Vague(clean, **off), "shape": shape, "max_error_mm": 5.0}
    assert not mend(clean, SLOW, **given).repairs
    (repair,) = mend(clean, SLOW, objections=False, **given).repairs
    assert repair.method == "vague"


def test_without_objections_samples_that_no_method_repairs_are_kept_and_several_classes_become_a_gap(drifting, shape):
    given = {"methods": {**METHODS, "slow": ["vague"]}, "extra": Vague(drifting, off=np.nan), "objections": False}
    assert np.array_equal(mend(drifting, SLOW, **given).positions, drifting.positions)
    both = {"peaks": [Event(MARKER, 610, 613, 2.0)], **SLOW}
    gap = mend(drifting, both, shape=shape, **given)
    assert np.isnan(gap.positions[START:STOP, drifting.markers.index(MARKER)]).all()


def test_a_peak_on_a_slow_change_becomes_a_gap_of_both(walker):
    """Combined forms (skurowski2022 figure 14), as the detectors find them."""

    def pulse(length):
        return 30 * np.sin(np.pi * (np.arange(length) + 0.5) / length)[:, None] * [1, 0.4, -0.5]

    recording = put(walker.recording, [("STRN", 200, 280)], pulse)
    m = recording.markers.index("STRN")
    recording.positions[240:242, m] += [20.0, -25.0, 10.0]
    found = {
        "peaks": [Event("STRN", 240, 242, 5.0)],
        "slow": [Event("STRN", 200, 280, 3.0)],
    }
    seen, _ = detect(recording, only=("peaks",))
    assert [(e.marker, e.start, e.stop) for e in seen["peaks"]] == [("STRN", 240, 242)]
    result = mend(replace(recording, facts={"recording": "walk"}), found, near=neighbours(recording.positions))
    covered = mask(found["slow"], recording.frames, recording.markers)
    assert np.array_equal(result.origin == MISSING, covered)
    assert np.array_equal(result.positions[~covered], recording.positions[~covered])
    (left,) = result.repairs_left
    assert left.kind == "peak+slow" and left.outcome == "blanked"


@pytest.mark.parametrize(("where", "kept"), [("start", True), ("end", True), ("middle", False)])
def test_frames_that_repeat_at_an_end_stay_as_recorded(clean, where, kept):
    """No gap is filled there: all markers would be lost."""
    frames = len(clean.positions)
    start, stop = {"start": (1, 4), "end": (frames - 3, frames), "middle": (500, 503)}[where]
    recording = bodies.recording(clean.markers, clean.positions.copy())
    recording.positions[start:stop] = recording.positions[start - 1]
    events = [Event(marker, start, stop, 1.0, kind="repeat", group="all markers") for marker in clean.markers]
    result = mend(recording, {"frames": events})
    assert np.array_equal(result.positions, recording.positions) == kept
    assert {(left.kind, left.outcome) for left in result.repairs_left} == {("repeat", "left" if kept else "blanked")}
    assert (f"nothing fills the recording's {where}" in result.repairs_left[0].reason.text) == kept
    decided = mend(recording, {"frames": events}, decisions=[Decision("*", start, stop, "accept", "repeat")])
    assert np.isnan(decided.positions[start:stop]).all()
