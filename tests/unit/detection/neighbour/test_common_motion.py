"""Common motion: what the body makes is no artifact of a marker."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.events import Event
from markermend.detection.neighbour import common_motion
from markermend.options.detection.peaks import CommonMotionOptions
from markermend.prediction.scene import Scene

MARKERS = [f"M{m}" for m in range(10)]
FOUND = [Event("M3", 50, 51, 1.5), Event("M3", 70, 72, 1.5)]


class Source:
    """Gives residuals that are known."""

    def __init__(self, residual):
        self.residual = residual

    def residuals(self, scene, markers=None):
        return self.residual


@pytest.fixture
def jumps():
    """Ten markers that rest, of which M3 jumps by 8 mm twice, with noise."""
    positions = np.random.default_rng(1).normal(0, 0.1, (100, 10, 3))
    positions[50, 3] += [8, 0, 0]
    positions[70:72, 3] += [8, 0, 0]
    return positions


def kept(positions, residual, found=FOUND):
    scene = Scene(positions, 100.0, [np.delete(np.arange(10), m) for m in range(10)])
    return common_motion.without_common_motion(found, scene, MARKERS, Source(residual), CommonMotionOptions())


def test_a_marker_that_jumps_alone_is_kept(jumps):
    assert kept(jumps, jumps) == FOUND


def test_a_moment_at_which_many_markers_are_accelerated_needs_more_that_they_leave_unexplained(jumps):
    residual = jumps.copy()
    jumps[50, [0, 1]] += [0, 6, 0]
    assert kept(jumps, residual) == FOUND
    residual[50, 3] -= [4, 0, 0]
    assert kept(jumps, residual) == FOUND[1:]


def test_one_other_marker_excuses_nobody(jumps):
    residual = jumps.copy()
    residual[50, 3] -= [4, 0, 0]
    jumps[50, 0] += [0, 6, 0]
    assert kept(jumps, residual) == FOUND


def test_what_the_neighbours_explain_once_all_are_seen_is_left_out(jumps):
    residual = jumps.copy()
    residual[70:72, 3] -= [7.6, 0, 0]
    assert kept(jumps, residual) == FOUND[:1]


def test_without_a_residual_an_event_is_kept(jumps):
    assert kept(jumps, np.full_like(jumps, np.nan)) == FOUND


def test_nothing_found_is_nothing(jumps):
    scene = Scene(jumps, 100.0, [np.zeros(0, int)] * 10)
    assert common_motion.without_common_motion([], scene, MARKERS, Source(jumps), CommonMotionOptions()) == []


def test_a_peak_stays_of_which_the_neighbours_leave_as_much_as_would_be_found(jumps):
    residual = jumps.copy()
    jumps[50, [0, 1]] += [0, 6, 0]
    residual[50, 3] -= [4, 0, 0]
    large = [replace(event, score=2.2) for event in FOUND]
    assert kept(jumps, residual, found=large) == large


def test_the_acceleration_of_the_neighbours_leaves_out_a_few_with_artifacts(jumps):
    jumps[50, 1] += [0, 20, 0]
    bends = common_motion.bend(jumps)
    around = [np.delete(np.arange(10), m) for m in range(10)]
    common = common_motion.neighbour_bend(bends, around, count=8, quantile=0.75)
    assert bends[50, 1] > 35 and bends[50, 3] > 14 and common[50, 0] < 1
    jumps[50, [4, 5]] += [0, 20, 0]
    assert common_motion.neighbour_bend(common_motion.bend(jumps), around, count=8, quantile=0.75)[50, 0] > 14
    assert not common_motion.neighbour_bend(bends, [np.zeros(0, int)] * 10, count=8, quantile=0.75).any()
