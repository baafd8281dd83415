"""Samples are counted as changed where their value differs, whatever their origin says."""

from dataclasses import replace

import numpy as np

from markermend.core.events import Event
from markermend.core.recording import changed
from markermend.report import sample_statistics
from support.small_result import PEAK


def test_a_sample_is_changed_where_its_value_differs(before, after):
    where = np.argwhere(changed(before, after)).tolist()
    assert where == [[0, 1], [2, 0], [3, 0], [4, 1], [5, 1]]


def test_two_missing_samples_are_equal(before):
    assert not changed(before, before).any()


def test_a_measured_sample_that_differs_is_reported(before, after):
    origin = after.origin.copy()
    origin[2, 0] = 0
    (warning,) = sample_statistics.inconsistent_origins(before, replace(after, origin=origin))
    assert warning.startswith("1 samples are marked as measured but differ")


def test_missing_samples_that_are_not_marked_are_reported(before, after):
    origin = after.origin.copy()
    origin[0, 1] = PEAK
    (warning,) = sample_statistics.inconsistent_origins(before, replace(after, origin=origin))
    assert warning.startswith("1 samples are marked as missing but are not")


def test_per_marker(before, after):
    rows = {row["marker"]: row for row in sample_statistics.per_marker(before, after)}
    assert (rows["A"]["gaps"], rows["A"]["repaired"], rows["A"]["missing_share_before"]) == (0, 2, 0.0)
    assert (rows["B"]["gaps"], rows["B"]["filled"], rows["B"]["missing_share_after"]) == (1, 2, 0.2)
    assert (rows["B"]["longest_gap_before_s"], rows["B"]["longest_gap_after_s"]) == (0.3, 0.1)


def test_findings_are_counted_by_class(before):
    """One finding about several markers counts once; the classes of a detector that did not run are left out."""
    together = [Event(marker, 1, 3, 1.0, kind="jump", group="all markers") for marker in before.markers]
    found = {"frames": together, "steps": [Event("A", 0, 2, 1.0), Event("A", 3, 5, 1.0, kind="displaced")]}
    counted = {
        row["artifact"].name: (row["events"], row["samples"]) for row in sample_statistics.per_class(found, before)
    }
    assert counted["jump"] == (1, 2 * len(before.markers))
    assert counted["step"] == counted["displaced"] == (1, 2)
    assert counted["repeat"] == (0, 0) and "peak" not in counted
