"""Findings: intervals from masks and back, sorted and disjoint per marker."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.events import Event, count_findings, disjoint, from_mask, mask

MARKERS = ("A", "B")


def test_from_mask_and_back():
    covered = np.zeros((10, 2), bool)
    covered[2:5, 0] = covered[8:, 0] = covered[0, 1] = True
    score = np.where(covered, 2.0, 0.0)
    score[3, 0], score[0, 1] = 7.0, 0.5
    fired = np.zeros((10, 2, 3), bool)
    fired[3, 0, [0, 2]] = True
    events = from_mask(covered, score, fired, MARKERS)
    assert events == [Event("A", 2, 5, 7.0, "xz"), Event("A", 8, 10, 2.0, "xyz"), Event("B", 0, 1, 1.0, "xyz")]
    assert np.array_equal(mask(events, 10, MARKERS), covered)


def test_disjoint_merges_what_touches_and_keeps_partners_separate():
    events = [
        Event("A", 5, 8, 1.0, "y"),
        Event("A", 1, 3, 2.0, "x"),
        Event("A", 3, 6, 4.0, "x"),
        Event("A", 7, 12, 3.0, "z", "B"),
        Event("B", 1, 3, 1.0, "z"),
    ]
    assert disjoint(events) == [
        Event("A", 1, 8, 4.0, "xy"),
        Event("A", 8, 12, 3.0, "z", "B"),
        Event("B", 1, 3, 1.0, "z"),
    ]


def test_an_event_on_an_unknown_marker_is_an_error():
    with pytest.raises(KeyError):
        mask([Event("Z", 0, 1, 1.0)], 5, MARKERS)


def test_a_finding_about_several_markers_counts_once():
    slip = [Event(marker, 4, 7, 2.0, kind="peak", group="hand") for marker in "AB"]
    later = [replace(event, start=9, stop=12) for event in slip]
    assert count_findings([*later, *slip, Event("C", 4, 7, 2.0), Event("A", 20, 30, 1.0)]) == 4
    assert slip[0].joined_with(slip[1]) and not slip[0].joined_with(later[1])
    assert not Event("A", 0, 5, 1.0).joined_with(Event("B", 0, 5, 1.0))


def test_every_second_frame_that_repeats_is_one_finding():
    repeated = [Event(m, k, k + 1, 1.0, kind="repeat", group="all") for m in "AB" for k in (*range(3, 15, 2), 40)]
    assert count_findings(repeated) == 2


def test_events_of_other_kinds_are_not_merged():
    parts = [Event("A", 2, 6, 2.0, kind="peak"), Event("A", 4, 9, 3.0, kind="step")]
    assert [(event.start, event.stop, event.kind) for event in disjoint(parts)] == [(2, 6, "peak"), (6, 9, "step")]
