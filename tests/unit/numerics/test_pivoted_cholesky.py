"""Pivots of a Cholesky factor: those of the largest remaining variance."""

import numpy as np

from markermend.numerics.pivoted_cholesky import pivoted_cholesky


def smooth_covariance(seed=1, points=40):
    at = np.random.default_rng(seed).normal(size=(points, 2))
    return np.exp(-np.linalg.norm(at[:, None] - at, axis=2))


def remaining_variance(covariance, pivots):
    """Variance of every point given the pivots."""
    across = covariance[:, pivots]
    return np.diag(covariance - across @ np.linalg.solve(covariance[np.ix_(pivots, pivots)], across.T))


def test_each_pivot_has_the_largest_variance_given_those_before_it():
    covariance = smooth_covariance()
    pivots, factor = pivoted_cholesky(covariance, tolerance=1e-6)
    assert len(set(pivots.tolist())) == len(pivots) == 40
    assert np.allclose(factor @ factor.T, covariance[np.ix_(pivots, pivots)])
    assert np.array_equal(factor, np.tril(factor))
    for rank in range(1, 12):
        variance = remaining_variance(covariance, pivots[:rank])
        assert variance[pivots[rank]] >= variance.max() - 1e-9


def test_it_stops_where_all_points_are_known():
    covariance = smooth_covariance()
    pivots, _ = pivoted_cholesky(covariance, tolerance=0.3)
    assert len(pivots) < 40
    assert remaining_variance(covariance, pivots).max() < 0.3 <= remaining_variance(covariance, pivots[:-1]).max()
    twice = np.repeat(np.repeat(covariance[:5, :5], 2, axis=0), 2, axis=1)
    assert len(pivoted_cholesky(twice, tolerance=1e-6)[0]) == 5
