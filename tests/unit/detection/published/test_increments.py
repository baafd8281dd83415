"""Sudden changes: thresholds, edges without side lobes, and pairs of opposite changes."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from markermend.detection.published import increments
from markermend.options.detection.published import ThresholdOptions
from support.naive import detection as naive
from support.signals import gappy


@given(st.integers(0, 200), st.sampled_from([(1, 20), (3, 10), (6, 60)]), st.sampled_from([0.3, 0.5, 1.0]))
def test_derivative_pairs_equal_their_naive_twin(seed, lengths, ratio):
    change = gappy(seed)
    at = np.flatnonzero(np.abs(change) > 1)
    pairs, alone = increments.derivative_pairs(change, at, shortest=lengths[0], longest=lengths[1], ratio=ratio)
    expected = naive.derivative_pairs(change, at.tolist(), *lengths, ratio)
    assert (pairs, alone.tolist()) == expected


def test_threshold_is_the_larger_of_scale_and_floor():
    values = np.random.default_rng(3).normal(0, 1, 5000)
    assert increments.threshold(values, scale="mad", sigmas=5, floor_mm=1.5) == pytest.approx(5, rel=0.05)
    assert increments.threshold(values, scale="std", sigmas=1, floor_mm=1.5) == 1.5
    with pytest.raises(ValueError, match="neither"):
        increments.threshold(values, scale="iqr", sigmas=5, floor_mm=1)


@given(st.integers(0, 50), st.sampled_from(["coordinate", "marker", "recording"]), st.sampled_from(["mad", "std"]))
def test_thresholds_equal_their_naive_twin(seed, over, scale):
    changes = np.stack([gappy(seed + k) * (1 + k) for k in range(6)], axis=1).reshape(-1, 2, 3)
    options = ThresholdOptions(scale_estimator=scale, sigma_over=over, threshold_sigmas=3, floor_mm=1)
    assert increments.thresholds(changes, options) == pytest.approx(naive.thresholds(changes, over, scale, 3, 1))


def test_thresholds_over_something_else_are_refused():
    with pytest.raises(ValueError, match="none of coordinate"):
        increments.thresholds(np.zeros((9, 2, 3)), ThresholdOptions(sigma_over="subject"))


def test_edges_leave_out_side_lobes():
    change = np.zeros(60)
    change[[20, 19, 21]] = 7, -2.5, -2.4
    change[40] = 5
    assert increments.edges(change, 2.0, 6).tolist() == [20, 40]
