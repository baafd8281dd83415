"""Numbers on one small recording, worked out by hand: 10 frames of 3 markers at 10 Hz, numbered from 101."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.changes import Change
from markermend.core.recording import Recording, Restored
from markermend.report import summary as report_summary
from markermend.report.attention import with_attention
from markermend.report.open_findings import left_open
from support.small_result import FOUND, RECORD, WEIGHTS


def summary_of(before: Recording, after: Restored, changes: list[Change], **more) -> dict:
    left = left_open(after, FOUND, changes, RECORD)
    parts = {"found": FOUND, "changes": changes, "left": left, "warnings": ["odd"], **more}
    return with_attention(report_summary.summarize(before=before, after=after, **parts), WEIGHTS)


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


def test_nothing_done_is_unchanged_and_wants_no_attention(before):
    whole = replace(before, positions=np.nan_to_num(before.positions))
    still = Restored(
        **vars(whole), origin=np.zeros((10, 3), np.uint8), error=np.zeros((10, 3)), error95=np.zeros((10, 3))
    )
    parts = {"found": {"peaks": []}, "changes": [], "left": [], "warnings": []}
    summary = with_attention(report_summary.summarize(before=whole, after=still, **parts), WEIGHTS)
    assert (summary["status"], summary["attention"], summary["changed_samples"]) == ("unchanged", 0.0, 0)
    assert summary["largest_change_mm"] is None and summary["expected_error_max_mm"] is None


def test_static_recordings_say_so(before, after):
    static = replace(before, facts={**before.facts, "kind": "static"})
    assert summary_of(static, after, [])["status"] == "static"
