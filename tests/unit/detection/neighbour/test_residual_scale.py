"""The local scale of residuals: how large they usually are there and then."""

import numpy as np

from markermend.detection.neighbour import residual_scale


def test_the_local_scale_follows_the_marker_no_further_than_its_neighbours():
    size = np.ones((300, 3))
    size[100:200, 0] = 50
    size[100:200, 2] = 4
    near = [np.array([1, 2]), np.array([2]), np.array([1])]
    usual = residual_scale.local_scale(size, near, window=21, count=2, max_ratio=3)
    assert usual[50].tolist() == [1, 1, 1]
    assert usual[150].tolist() == [7.5, 1, 3]


def test_the_fitted_scale_rises_where_the_neighbours_fit_badly_or_move_fast():
    rng = np.random.default_rng(3)
    near = [np.delete(np.arange(6), m) for m in range(6)]
    scale_ratio = np.where((np.arange(2000) // 250) % 2, 4.0, 1.0)
    size = np.abs(rng.normal(size=(2000, 6))) * scale_ratio[:, None]
    still = np.zeros((2, 2000, 6))
    moving = np.broadcast_to(100 * scale_ratio[:, None], (2, 2000, 6))
    for kinds in (still, moving):
        found = residual_scale.fitted_scale(size, near, kinds, count=5, window=50, min_scale=0.1)
        ratio = np.median(found[scale_ratio > 1]) / np.median(found[scale_ratio == 1])
        assert 3 < ratio < 5
    broken = size.copy()
    broken[600:650, 0] += 50
    again = residual_scale.fitted_scale(broken, near, moving, count=5, window=50, min_scale=0.1)
    assert (
        again[625, 0] < 1.5 * residual_scale.fitted_scale(size, near, moving, count=5, window=50, min_scale=0.1)[625, 0]
    )


def test_low_levels_do_not_follow_an_artifact_of_half_of_the_recording():
    size = np.abs(np.random.default_rng(4).normal(0, 1.0, (400, 5)))
    size[100:340, 2] += 8.0
    size[:50, 3] = np.nan
    levels = residual_scale.low_levels(size, 0.25, min_level=0.01)
    np.testing.assert_allclose(levels[[0, 1, 3, 4]], 0.67, atol=0.2)
    assert levels[2] < 3 < np.median(size[:, 2])


def test_low_levels_of_markers_that_are_never_seen_or_fit_exactly_are_the_smallest():
    size = np.stack([np.full(50, np.nan), np.zeros(50)], axis=1)
    np.testing.assert_array_equal(residual_scale.low_levels(size, 0.25, min_level=0.01), 0.01)


def test_markers_that_are_never_seen_do_not_lower_the_levels_of_others():
    size = np.abs(np.random.default_rng(4).normal(0, 1.0, (400, 2)))
    levels = residual_scale.low_levels(size, 0.25, min_level=0.01)
    unseen = np.concatenate([size, np.full((400, 3), np.nan)], axis=1)
    np.testing.assert_array_equal(residual_scale.low_levels(unseen, 0.25, min_level=0.01)[:2], levels)
