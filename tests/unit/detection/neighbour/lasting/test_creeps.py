"""Creeps of a loose marker stand out by their standard deviations; what comes back like a drift does not."""

import numpy as np
import pytest

from markermend.detection.neighbour.lasting.creeps import EstimatedCreeps
from markermend.numerics.matched_filter import raised_cosine
from markermend.options.detection.displacement import DisplacementOptions
from support.loose_marker import RATE, drifts

FRAMES = 1500


def creep(start, stop=FRAMES, *, rise_s=1.5):
    time = np.arange(FRAMES)
    return np.clip((time - start) / (rise_s * RATE), 0, 1)[:, None] * (time < stop)[:, None] * np.array([6.0, 0, 8])


def course(change):
    return EstimatedCreeps(drifts(change), DisplacementOptions()).course(0)


@pytest.mark.parametrize("rise_s", [1, 1.5])
@pytest.mark.parametrize("start", [300, 900])
def test_a_creep_to_the_end_is_proposed_with_its_course(start, rise_s):
    found = course(3 * creep(start, rise_s=rise_s))
    assert found.middle_s == pytest.approx(start / RATE + rise_s / 2, abs=0.3)
    assert abs(found.rise_s - rise_s) <= 1
    assert found.stop_s == np.inf


@pytest.mark.parametrize(("start", "stop"), [(300, 1200), (500, 1105)])
def test_a_creep_that_ends_is_proposed_with_its_end(start, stop):
    found = course(creep(start, stop))
    assert found.middle_s == pytest.approx(start / RATE + 0.75, abs=0.8)
    assert found.stop_s == pytest.approx(stop / RATE, abs=0.1)


def test_nothing_where_all_is_well():
    for seed in range(3):
        assert EstimatedCreeps(drifts(np.zeros((FRAMES, 3)), seed), DisplacementOptions()).course(0) is None


def test_a_drift_is_no_creep():
    bump = raised_cosine((np.arange(FRAMES) - 499.5) / 400)[:, None] * np.array([6.0, 0, 8])
    assert course(bump) is None


def test_too_short_to_tell():
    assert EstimatedCreeps(drifts(creep(50)[:180]), DisplacementOptions()).course(0) is None
