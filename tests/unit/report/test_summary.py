"""Numbers on one small recording, worked out by hand: 10 frames of 3 markers at 10 Hz, numbered from 101."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.changes import Change, Outcome
from markermend.core.events import Event
from markermend.core.reasons import UNSTATED, Cause, Reason
from markermend.core.recording import FILLED, MISSING, ORIGINS, Recording, Restored, changed
from markermend.numerics.intervals import runs
from markermend.report import summary as report_summary
from markermend.report import timeline
from markermend.report.open_findings import left_open, open_gaps, reasons_for_blanking, worst_first
from markermend.report.plot_data import delta, excerpt

WEIGHTS = {"changed_percent": 2, "missing_percent": 1, "error_mm": 0.5, "open": 3, "warning": 10}
PEAK = ORIGINS.index("peak")
FOUND = {
    "peaks": [Event("A", 2, 4, 2.5, "xz"), Event("C", 6, 7, 4.0)],
    "steps": [Event("B", 8, 10, 1.5, "xyz", "C")],
}
RECORD = [
    Change("A", 2, 4, ("peak",), Outcome.REPAIRED, 2.5, "xz", method="pchip"),
    Change("C", 6, 7, ("peak",), Outcome.LEFT, 4.0, reason=Reason(Cause.PROTECTED, "protected")),
    Change("B", 0, 1, ("peak", "slow"), Outcome.BLANKED, reason=Reason(Cause.UNCERTAIN, "too uncertain")),
    Change("B", 4, 6, ("gap",), Outcome.FILLED, method="linear"),
    Change("B", 6, 7, ("gap",), Outcome.LEFT, samples=1, reason=Reason(Cause.NO_METHOD, "no neighbours")),
]


@pytest.fixture
def before() -> Recording:
    positions = np.arange(90.0).reshape(10, 3, 3)
    positions[4:7, 1] = np.nan
    positions[9, 2] = np.nan
    return Recording(("A", "B", "C"), positions, 10.0, 101, {"recording": "r", "subject": "s", "kind": "dynamic"})


@pytest.fixture
def after(before: Recording) -> Restored:
    """A: a peak of two samples repaired by 3, 4, 0 mm. B: two of three missing samples filled, one taken away."""
    positions = before.positions.copy()
    positions[2:4, 0] += (3.0, 4.0, 0.0)
    positions[4:6, 1] = 7.0
    positions[0, 1] = np.nan
    origin = np.where(np.isnan(positions).any(axis=2), MISSING, 0).astype(np.uint8)
    origin[2:4, 0], origin[4:6, 1] = PEAK, FILLED
    error = np.where(origin == MISSING, np.nan, 0.0)
    error[2:4, 0], error[4:6, 1] = 1.0, (2.0, 6.0)
    return Restored(before.markers, positions, 10.0, 101, before.facts, origin, error, 2 * error)


@pytest.fixture
def changes(before: Recording, after: Restored) -> list[Change]:
    return worst_first(before, after, RECORD)


def summary_of(before: Recording, after: Restored, changes: list[Change], **more) -> dict:
    left = left_open(after, FOUND, changes, RECORD)
    parts = {"found": FOUND, "changes": changes, "left": left, "warnings": ["odd"], "weights": WEIGHTS, **more}
    return report_summary.summarize(before=before, after=after, **parts)


def test_a_sample_is_changed_where_its_value_differs(before, after):
    where = np.argwhere(changed(before, after)).tolist()
    assert where == [[0, 1], [2, 0], [3, 0], [4, 1], [5, 1]]


def test_two_missing_samples_are_equal(before):
    assert not changed(before, before).any()


def test_summary(before, after, changes):
    summary = summary_of(before, after, changes)
    assert summary["status"] == "cleaned"
    assert (summary["frames"], summary["duration_s"], summary["markers"]) == (10, 1.0, 3)
    assert summary["missing_share_before"] == pytest.approx(4 / 30, abs=1e-6)
    assert summary["missing_share_after"] == pytest.approx(3 / 30, abs=1e-6)
    assert summary["findings"] == {"peaks": {"events": 2, "samples": 3}, "steps": {"events": 1, "samples": 2}}
    assert summary["changed_samples"] == 5
    assert (summary["repaired"], summary["blanked"]) == ({"events": 1, "samples": 2}, {"events": 1, "samples": 1})
    assert summary["origins"]["peak"] == 2 and summary["origins"]["filled"] == 2 and summary["origins"]["missing"] == 3
    assert summary["filled"] == {"events": 1, "samples": 2}
    assert summary["findings_open"]["events"] == 2
    assert summary["gaps_open"]["events"] == 3
    assert summary["gaps_open"]["reasons"]["no neighbours"] == 1
    assert summary["largest_change_mm"] == 5.0
    assert (summary["expected_error_median_mm"], summary["expected_error_max_mm"]) == (1.5, 6.0)
    assert summary["expected_error95_max_mm"] == 12.0
    assert summary["warnings"] == ["odd"]


def test_attention_adds_up(before, after, changes):
    summary = summary_of(before, after, changes)
    assert summary["attention"] == pytest.approx(2 * 100 * 5 / 30 + 100 * 3 / 30 + 0.5 * 6 + 3 * 2 + 10, abs=0.01)
    assert sum(summary["attention_parts"].values()) == pytest.approx(summary["attention"], abs=1e-9)


def test_nothing_done_is_unchanged_and_wants_no_attention(before):
    whole = replace(before, positions=np.nan_to_num(before.positions))
    still = Restored(*vars(whole).values(), np.zeros((10, 3), np.uint8), np.zeros((10, 3)), np.zeros((10, 3)))
    summary = report_summary.summarize(
        before=whole, after=still, found={"peaks": []}, changes=[], left=[], warnings=[], weights=WEIGHTS
    )
    assert (summary["status"], summary["attention"], summary["changed_samples"]) == ("unchanged", 0.0, 0)
    assert summary["largest_change_mm"] is None and summary["expected_error_max_mm"] is None


def test_static_recordings_say_so(before, after):
    static = replace(before, facts={**before.facts, "kind": "static"})
    assert summary_of(static, after, [])["status"] == "static"


def test_a_measured_sample_that_differs_is_reported(before, after):
    origin = after.origin.copy()
    origin[2, 0] = 0
    (warning,) = report_summary.broken_promises(before, replace(after, origin=origin))
    assert warning.startswith("1 samples are marked as measured but differ")


def test_missing_samples_that_are_not_marked_are_reported(before, after):
    origin = after.origin.copy()
    origin[0, 1] = PEAK
    (warning,) = report_summary.broken_promises(before, replace(after, origin=origin))
    assert warning.startswith("1 samples are marked as missing but are not")


def test_per_marker(before, after):
    rows = {row["marker"]: row for row in report_summary.per_marker(before, after)}
    assert (rows["A"]["gaps"], rows["A"]["repaired"], rows["A"]["missing_share_before"]) == (0, 2, 0.0)
    assert (rows["B"]["gaps"], rows["B"]["filled"], rows["B"]["missing_share_after"]) == (1, 2, 0.2)
    assert (rows["B"]["longest_gap_before_s"], rows["B"]["longest_gap_after_s"]) == (0.3, 0.1)


def test_changes_are_listed_worst_first(changes):
    assert [(c.kind, c.marker, c.start, c.stop) for c in changes] == [
        ("gap", "B", 4, 6),
        ("peak", "A", 2, 4),
        ("peak+slow", "B", 0, 1),
    ]
    peak = changes[1]
    assert (peak.score, peak.axes, peak.method, peak.samples, peak.largest_change_mm) == (2.5, "xz", "pchip", 2, 5.0)
    assert reasons_for_blanking(changes, RECORD) == {changes[2]: "peak+slow: too uncertain"}
    assert changes[0].largest_change_mm is None


def test_a_recording_that_nothing_was_done_to_has_no_changes(before, after):
    whole = replace(after, positions=before.positions)
    assert worst_first(before, whole, []) == [] and reasons_for_blanking([], []) == {}


def test_left_open_tells_what_and_why(after, changes):
    left = left_open(after, FOUND, changes, RECORD)
    told = [(f.kind, f.marker, f.start, f.stop, f.reason.text) for f in left]
    assert told == [
        ("peak", "C", 6, 7, "protected"),
        ("step", "B", 8, 10, UNSTATED.text),
        ("gap", "B", 0, 1, UNSTATED.text),
        ("gap", "B", 6, 7, "no neighbours"),
        ("gap", "C", 9, 10, UNSTATED.text),
    ]
    assert (left[0].score, left[1].partner) == (4.0, "C")


def test_gaps_are_listed_longest_first(before, after):
    restored = replace(after, positions=before.positions)
    assert [(g.marker, g.samples) for g in open_gaps(restored, RECORD)] == [("B", 3), ("C", 1)]


def unpack(series):
    """Plain reading of a packed series: (offset, values) for each run."""
    return [(offset, np.cumsum(columns, axis=1).T / 100) for offset, *columns in series]


def test_an_excerpt_holds_the_window_to_a_hundredth(before, after, changes):
    gap = changes[0]
    cut = excerpt(gap, before, after, context_s=0.2, frames=100)
    assert (cut["first"], cut["step"], cut["frames"], cut["span"], cut["origin"]) == (103, 1, 6, [105, 107], 101)
    (first, early), (second, late) = unpack(cut["before"])
    assert (first, second) == (0, 5)
    np.testing.assert_allclose(early, before.positions[2:4, 1], atol=0.005)
    np.testing.assert_allclose(late, before.positions[7:8, 1], atol=0.005)
    ((offset, filled),) = unpack(cut["after"])
    assert offset == 1, "one measured sample joins the filled ones to the curve"
    np.testing.assert_allclose(filled[:, :3], after.positions[3:6, 1], atol=0.005)
    np.testing.assert_allclose(filled[:, 3:], [[0, 0], [2, 4], [6, 12]], atol=0.005)


def test_a_long_excerpt_thins_its_frames(before, after, changes):
    cut = excerpt(changes[0], before, after, context_s=9.0, frames=4)
    assert (cut["first"], cut["step"], cut["frames"]) == (101, 3, 4)


def test_a_swap_shows_its_partner(before, after):
    cut = excerpt(Change("A", 2, 4, ("swap",), Outcome.LEFT, partner="C"), before, after, context_s=0.1, frames=100)
    ((offset, values),) = unpack(cut["partner"])
    np.testing.assert_allclose(values, before.positions[1:5, 2], atol=0.005)
    assert offset == 0


def test_differences_restore_the_numbers():
    values = np.random.default_rng(3).normal(0, 2000, 500)
    np.testing.assert_allclose(np.cumsum(delta(values)) / 100, values, atol=0.00501)


def test_a_map_shows_every_stretch_at_its_place():
    where = np.zeros(5000, bool)
    where[1000:2000] = where[4999] = True
    assert timeline.path(where) == "M200 0h200M997 0h3"


@pytest.mark.parametrize("frames", [1, 7, 999, 1000, 12345])
def test_no_frame_is_lost_on_a_map(frames):
    where = np.random.default_rng(frames).random(frames) < 0.02
    where[-1] = True
    drawn = np.zeros(timeline.WIDTH, bool)
    for stroke in timeline.path(where).split("M")[1:]:
        start, length = stroke.split(" 0h")
        drawn[int(start) : int(start) + int(length)] = True
    for start, stop in runs(where):
        assert drawn[start * timeline.WIDTH // frames]
        assert drawn[min(timeline.WIDTH - 1, (stop * timeline.WIDTH - 1) // frames)]


def test_ticks_are_round_times_with_the_capture_programs_frames(before):
    ticks = timeline.ticks(replace(before, first_frame=705), 5)
    assert [tick["second"] for tick in ticks] == [0.0, 0.2, 0.4, 0.6, 0.8]
    assert [tick["frame"] for tick in ticks] == [705, 707, 709, 711, 713]
