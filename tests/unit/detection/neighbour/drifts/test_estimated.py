"""Drifts on a body whose loose marker is predicted by its neighbours: found whole, and only those that come back."""

import numpy as np
import pytest

from markermend.numerics.matched_filter import raised_cosine
from support.loose_marker import drifts


def bump(start, stop, frames=1500, height=(6.0, 0, 8)):
    return raised_cosine((np.arange(frames) + 0.5 - start) / (stop - start))[:, None] * np.array(height)


@pytest.mark.parametrize(("start", "stop"), [(400, 540), (600, 800), (20, 220), (1290, 1490)])
def test_a_drift_is_found_whole_also_at_the_ends(start, stop):
    [event] = drifts(bump(start, stop)).find(0, name="a")
    assert abs(event.start - start) <= 0.2 * (stop - start)
    assert abs(event.stop - stop) <= 0.2 * (stop - start)
    assert event.axes == "xz"


def test_nothing_where_all_is_well_or_something_does_not_come_back():
    assert drifts(np.zeros((1500, 3))).find(0, name="a") == []
    shift = (np.arange(1500) >= 700)[:, None] * np.array([6.0, 0, 8])
    assert drifts(shift).find(0, name="a") == []


@pytest.mark.parametrize(("start", "stop"), [(700, 750), (702, 745), (955, 1030)])
def test_one_as_short_as_templates_is_found_to_the_frame(start, stop):
    [event] = drifts(bump(start, stop)).find(0, name="a")
    assert abs(event.start - start) <= 6
    assert abs(event.stop - stop) <= 6


def test_what_fits_best_with_the_longest_drift_is_no_drift():
    assert drifts(bump(200, 1300)).find(0, name="a") == []


def test_samples_may_be_missing_but_not_most_of_the_drift():
    known = np.ones(1500, bool)
    known[[650, 651, *range(660, 680)]] = False
    [event] = drifts(bump(600, 900), known=known).find(0, name="a")
    assert abs(event.start - 600) <= 60
    known[640:860] = False
    assert drifts(bump(600, 900), known=known).find(0, name="a") == []


def test_long_recordings_are_divided_and_nothing_is_lost_between_the_parts():
    change = bump(5800, 6100, frames=15000) + bump(11000, 11300, frames=15000)
    found = drifts(change).find(0, name="a")
    assert [(round(event.start, -2), round(event.stop, -2)) for event in found] in (
        [(5800, 6100), (11000, 11300)],
        [(11000, 11300), (5800, 6100)],
    )
