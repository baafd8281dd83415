"""Subsets of frames, the ranking of reference markers, and markers that are observed together."""

import numpy as np
import pytest

from markermend.prediction.marker_selection import (
    evenly_spaced,
    jointly_observed,
    pseudo_random_subset,
    reference_markers,
)
from support.fillings import rigid_body, scene


def test_frames_are_evenly_spaced_and_both_ends_are_kept():
    frames = np.arange(100, 201)
    assert evenly_spaced(frames, 5).tolist() == [100, 125, 150, 175, 200]
    assert evenly_spaced(frames, 101) is frames


def test_pseudo_random_frames_are_of_even_density_and_at_every_distance():
    frames = np.arange(7, 50_007)
    chosen = pseudo_random_subset(frames, 2500)
    assert len(chosen) == 2500 and (np.diff(chosen) > 0).all() and np.isin(chosen, frames).all()
    assert np.ptp(np.histogram(chosen, bins=25, range=(7, 50_007))[0]) < 60  # 100 each
    seen = np.isin(frames, chosen)
    pairs = np.array([np.count_nonzero(seen[lag:] & seen[:-lag]) for lag in range(1, 250)])
    assert pairs.min() > 60 and abs(pairs.mean() - 125) < 10
    assert np.array_equal(pseudo_random_subset(frames[:9], 9), frames[:9])


def test_deviations_are_those_of_the_distance(walker):
    positions = walker.recording.positions[:400]
    ranked, deviation = reference_markers(scene(positions), 9, max_frames=1000, min_frames=60)
    for reference, value in zip(ranked[:5], deviation[:5], strict=True):
        assert value == pytest.approx(np.linalg.norm(positions[:, 9] - positions[:, reference], axis=1).std())
    assert (np.diff(deviation) >= 0).all()


def test_markers_that_are_rarely_observed_are_no_references():
    positions = rigid_body(frames=200)
    positions[50:, 3] = np.nan
    ranked, _ = reference_markers(scene(positions), 0, max_frames=1000, min_frames=60)
    assert sorted(ranked.tolist()) == [1, 2, 4, 5]


def test_a_marker_that_would_leave_too_few_joint_frames_is_left_out():
    positions = rigid_body(frames=200)
    positions[:70, 1] = np.nan
    positions[130:, 2] = np.nan
    seen = scene(positions)
    chosen, frames = jointly_observed(seen, 0, np.array([1, 2, 3]), min_share=0.5, min_frames=60)
    assert chosen.tolist() == [1, 3]
    assert frames.tolist() == list(range(70, 200))
    chosen, frames = jointly_observed(seen, 0, np.array([1, 2, 3]), min_share=0.1, min_frames=60)
    assert chosen.tolist() == [1, 2, 3] and frames.tolist() == list(range(70, 130))
    chosen, frames = jointly_observed(seen, 0, np.array([1]), min_share=0.0, min_frames=201)
    assert len(chosen) == len(frames) == 0
