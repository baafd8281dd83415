"""Repair: each class undone on a body whose truth is known, nothing else touched, every refusal with its reason."""

import numpy as np
import pytest

from markermend.core.decisions import Decision
from markermend.core.events import Event
from markermend.core.recording import MEASURED, MISSING, ORIGINS
from support import bodies
from support.repairs import MARKER, METHODS, START, STOP, body, distorted, error, mend
from support.treated import expected


@pytest.fixture(scope="module")
def clean():
    return body()


def check_only(recording, result, start, stop, origin, marker=MARKER):
    """Everything outside the interval is the original bit for bit; inside it is marked as repaired, with an error."""
    m = recording.markers.index(marker)
    inside = np.zeros(result.origin.shape, bool)
    inside[start:stop, m] = True
    assert np.array_equal(result.positions[~inside], recording.positions[~inside])
    assert (result.origin[~inside] == MEASURED).all()
    assert (result.error[~inside] == 0).all()
    assert (result.origin[start:stop, m] == ORIGINS.index(origin)).all()
    assert (result.error[start:stop, m] > 0).all()
    assert (result.error95 >= result.error).all()


@pytest.mark.parametrize("kind", ["noise", "slow"])
def test_prediction_replaces_noise_and_drift(clean, kind):
    rng = np.random.default_rng(1)
    recording = distorted(clean, rng.normal(0, 10, (STOP - START, 3)))
    result = mend(recording, {kind: [Event(MARKER, START, STOP, 3.0)]})
    check_only(recording, result, START, STOP, kind)
    assert error(clean, result).max() < 1
    (told,) = result.repairs
    assert expected(told).keys() == {"local_ridge"}
    assert (told.marker, told.start, told.stop, told.kind, told.score) == (MARKER, START, STOP, kind, 3.0)
    assert (told.outcome, told.method, told.samples, told.reason) == ("repaired", "local_ridge", STOP - START, None)
    m = clean.markers.index(MARKER)
    span = slice(START, STOP), m
    moved = np.linalg.norm(result.positions[span] - recording.positions[span], axis=1).max()
    figures = moved, result.error[span].max(), result.error95[span].max()
    assert (told.largest_change_mm, told.expected_error_mm, told.expected_error95_mm) == pytest.approx(
        figures, abs=5e-4
    )


def test_spline_replaces_a_peak_and_states_a_fair_error(clean):
    recording = distorted(clean, 15.0, 700, 703)
    result = mend(recording, {"peaks": [Event(MARKER, 700, 703, 5.0)]})
    check_only(recording, result, 700, 703, "peak")
    miss = error(clean, result, 700, 703)
    stated = result.error95[700:703, clean.markers.index(MARKER)]
    assert miss.max() < 0.5
    assert stated.max() < 1
    assert (miss < 2 * stated).all()


def test_a_step_is_taken_off_and_its_measured_detail_stays(clean):
    recording = distorted(clean, np.array([9.0, -4.0, 2.0]))
    result = mend(recording, {"steps": [Event(MARKER, START, STOP, 5.0)]})
    check_only(recording, result, START, STOP, "step")
    assert result.repairs[0].method == "separate_step"
    m = clean.markers.index(MARKER)
    shift = result.positions[START:STOP, m] - clean.positions[START:STOP, m]
    assert np.abs(shift).max() < 0.3
    assert np.ptp(shift, axis=0).max() < 0.3


def test_a_step_with_noise_on_it_loses_both(clean):
    rng = np.random.default_rng(2)
    recording = distorted(clean, 9.0 + rng.normal(0, 6, (STOP - START, 3)))
    result = mend(recording, {"steps": [Event(MARKER, START, STOP, 5.0)]})
    assert error(clean, result).max() < 1


def test_swap_is_undone_bit_for_bit(clean):
    a, b = clean.markers.index("2b"), clean.markers.index("3a")
    positions = clean.positions.copy()
    positions[START:STOP, [a, b]] = positions[START:STOP, [b, a]]
    recording = bodies.recording(clean.markers, positions)
    events = [Event("2b", START, STOP, 9.0, "xyz", "3a"), Event("3a", START, STOP, 9.0, "xyz", "2b")]
    result = mend(recording, {"labels": events})
    assert np.array_equal(result.positions, clean.positions)
    assert (result.origin[START:STOP, [a, b]] == ORIGINS.index("swap")).all()
    assert [(r.marker, r.partner, r.kind) for r in result.repairs] == [
        ("2b", "3a", "swap"),
        ("3a", "2b", "swap"),
    ]


def test_swap_with_a_missing_partner_moves_the_samples(clean):
    a, b = clean.markers.index("2b"), clean.markers.index("3a")
    positions = clean.positions.copy()
    positions[START:STOP, b] = positions[START:STOP, a]
    positions[START:STOP, a] = np.nan
    recording = bodies.recording(clean.markers, positions)
    result = mend(recording, {"labels": [Event("3a", START, STOP, 9.0, "xyz", "2b")]})
    assert np.array_equal(result.positions[:, a], clean.positions[:, a])
    assert np.isnan(result.positions[START:STOP, b]).all()
    assert (result.origin[START:STOP, b] == MISSING).all()


def test_a_peak_within_a_swap_is_mended_after_the_swap(clean):
    a, b = clean.markers.index("2b"), clean.markers.index("3a")
    positions = clean.positions.copy()
    positions[610:613, a] += 20.0
    positions[START:STOP, [a, b]] = positions[START:STOP, [b, a]]
    swap = [Event("2b", START, STOP, 9.0, "xyz", "3a"), Event("3a", START, STOP, 9.0, "xyz", "2b")]
    result = mend(bodies.recording(clean.markers, positions), {"peaks": [Event("2b", 610, 613, 5.0)], "labels": swap})
    assert error(clean, result).max() < 1
    assert (result.origin[610:613, a] == ORIGINS.index("peak")).all()
    others = np.delete(np.arange(len(positions)), slice(610, 613))
    assert np.array_equal(result.positions[others], clean.positions[others])
    assert np.array_equal(result.positions[:, b], clean.positions[:, b])


@pytest.mark.parametrize("protect", ["2b", "3a"])
def test_a_swap_with_a_protected_marker_is_left(clean, protect):
    swap = [Event("2b", START, STOP, 9.0, "xyz", "3a"), Event("3a", START, STOP, 9.0, "xyz", "2b")]
    result = mend(clean, {"labels": swap}, protect=[protect])
    assert np.array_equal(result.positions, clean.positions)
    assert [left.reason.text for left in result.repairs_left] == ["protected", "protected"]


def test_the_neighbours_artifact_does_not_leak_into_a_repair(clean):
    recording = distorted(distorted(clean, 30.0), 40.0, marker="1a")
    events = [Event(MARKER, START, STOP, 5.0), Event("1a", START, STOP, 5.0)]
    result = mend(recording, {"slow": events})
    assert error(clean, result).max() < 1.5
    assert error(clean, result, marker="1a").max() < 1.5


def test_overlapping_classes_become_a_gap(clean):
    recording = distorted(clean, 20.0)
    found = {"peaks": [Event(MARKER, 610, 613, 2.0)], "slow": [Event(MARKER, START, STOP, 4.0)]}
    result = mend(recording, found)
    m = clean.markers.index(MARKER)
    assert np.isnan(result.positions[START:STOP, m]).all()
    assert (result.origin[START:STOP, m] == MISSING).all()
    (left,) = result.repairs_left
    assert (left.kind, left.start, left.stop, left.outcome) == ("peak+slow", START, STOP, "blanked")


def test_what_cannot_be_trusted_becomes_missing_and_says_why(clean):
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
def test_what_nobody_measured_is_missing_says_so_and_can_be_kept(clean, stage, kind):
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


@pytest.mark.parametrize("method", ["linear", "spline", "savitzky_golay"])
def test_selectable_methods_bring_a_peak_closer(clean, method):
    recording = distorted(clean, 15.0, 700, 703)
    result = mend(recording, {"peaks": [Event(MARKER, 700, 703, 5.0)]}, methods={**METHODS, "peaks": [method]})
    assert result.repairs[0].method == method
    assert error(clean, result, 700, 703).max() < error(clean, recording, 700, 703).min()


def test_nothing_found_gives_the_recording_back(clean):
    result = mend(clean, {})
    assert np.array_equal(result.positions, clean.positions)
    assert not result.origin.any() and not result.error.any()
    assert result.repairs == result.repairs_left == []
