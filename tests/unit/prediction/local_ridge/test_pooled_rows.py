"""Rows from other recordings: local coordinates about the mean of each recording."""

import numpy as np

from markermend.core.poses import Pool
from markermend.numerics.rigid_alignment import align
from markermend.prediction.local_ridge.offsets import about_mean
from markermend.prediction.local_ridge.pooled_rows import pooled_rows
from support.fillings import rigid_body

LIMITS = {"row_limits": (5, 1000), "ridge": 5.0, "sigmas": 6.0}


def pool(*recordings):
    """A pool of the recordings."""
    numbers = np.repeat(np.arange(len(recordings)), [len(each) for each in recordings])
    return Pool(np.concatenate(recordings), numbers, tuple(f"take {n}" for n in range(len(recordings))))


def test_rows_that_miss_a_marker_and_recordings_with_few_rows_are_left_out():
    first, second = rigid_body(frames=40, markers=6), rigid_body(frames=30, markers=6, seed=2)
    first[10:15, 4] = np.nan
    second[4:, 5] = np.nan
    found = pooled_rows(pool(first, second), np.arange(3), np.array([3, 4, 5]), **LIMITS)
    assert found.local.shape == (35, 9) and not found.recording.any()
    first[:, 1] = np.nan
    assert pooled_rows(pool(first, second), np.arange(3), np.array([3, 4, 5]), **LIMITS) is None


def test_a_marker_that_was_attached_elsewhere_makes_no_difference():
    """A marker hangs on a rigid body with some motion of its own; its place differs between the recordings."""
    rng = np.random.default_rng(3)
    bodies = [rigid_body(frames=60, markers=5) for _ in range(2)]
    frames = align(bodies[0][:, :3], bodies[0][0, :3] - bodies[0][0, :3].mean(axis=0))
    own = rng.normal(0, 5, (60, 3))
    for body, place in zip(bodies, ([0.0, 50, 20], [8.0, 45, 30]), strict=True):
        body[:, 4] = frames.laboratory(place + own)
    found = pooled_rows(pool(*bodies), np.arange(3), np.array([3, 4]), **LIMITS)
    assert np.allclose(found.local[:60], found.local[60:], atol=1e-6)
    assert np.allclose(found.local[:60, :3], 0, atol=1e-6)
    there = found.about(np.zeros(6))[:, 3:]
    assert np.allclose(np.linalg.norm(there[60:] - there[:60], axis=1), np.linalg.norm([8.0, -5.0, 10.0]))


def test_the_shape_of_another_recording_is_turned_onto_the_template():
    rows = pooled_rows(pool(rigid_body(frames=40)), np.arange(3), np.array([3, 4]), **LIMITS)
    other = rigid_body(frames=40)[17, :3]
    assert np.allclose(rows.turned(other - other.mean(axis=0)), rows.template, atol=1e-6)


def test_the_products_are_weighted_means():
    rows = pooled_rows(pool(rigid_body(), rigid_body(seed=4)), np.arange(3), np.array([3, 4]), **LIMITS)
    expected = np.mean([np.outer(row, row) for row in rows.local], axis=0)
    assert (rows.weights == 1).all() and np.allclose(rows.products, expected)


def test_rows_are_taken_about_the_weighted_mean_of_their_recording():
    rng = np.random.default_rng(4)
    rows, weights, recording = rng.normal(3, 1, (9, 2)), rng.uniform(0.1, 1, 9), np.repeat([0, 2], [4, 5])
    found = about_mean(rows, weights, recording)
    for number in (0, 2):
        own = recording == number
        assert np.allclose(found[own], rows[own] - np.average(rows[own], axis=0, weights=weights[own]))


def test_more_rows_than_wanted_are_sampled_evenly():
    takes = pool(rigid_body(frames=60), rigid_body(frames=30, seed=2))
    found = pooled_rows(takes, np.arange(3), np.array([3, 4]), **LIMITS | {"row_limits": (5, 30)})
    assert found.poses == 90 and np.bincount(found.recording).tolist() == [20, 10]
