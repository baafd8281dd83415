"""Low-rank completion: exact where the rank is low, and it iterates until nothing moves."""

import numpy as np
import pytest

from markermend.numerics.low_rank import complete_matrix, components_for_share
from support.naive import numerics as naive


def low_rank(whole, rows=200, columns=12, rank=3, seed=4):
    """A matrix of the given rank plus a constant row, and holes in all but the first rows."""
    rng = np.random.default_rng(seed)
    matrix = rng.normal(size=(rows, rank)) @ rng.normal(size=(rank, columns)) * 50 + rng.normal(size=columns) * 10
    hidden = rng.random(matrix.shape) < 0.1
    hidden[np.arange(rows), rng.integers(0, columns, rows)] = True
    hidden[:whole] = False
    return matrix, np.where(hidden, np.nan, matrix)


@pytest.mark.parametrize("whole", [0, 10, 40])
@pytest.mark.parametrize("shrinkage", [True, False])
def test_a_matrix_of_low_rank_is_recovered(shrinkage, whole):
    matrix, gapped = low_rank(whole)
    before = gapped.copy()
    # Without enough complete rows the rank comes from the straight lines: higher than it is.
    explained = 1 - 1e-9 if whole == 40 else 0.8
    filled, misfit = complete_matrix(gapped, explained=explained, shrinkage=shrinkage, tolerance=1e-7, iterations=3000)
    assert np.array_equal(gapped, before, equal_nan=True)
    assert np.abs(filled - matrix).max() < 1e-3
    assert len(misfit) < 3000 and (whole == 40 or len(misfit) > 5)
    known = ~np.isnan(gapped)
    assert np.allclose(filled[known], matrix[known], rtol=0, atol=1e-9)


def test_it_iterates_and_the_misfit_never_grows():
    matrix, gapped = low_rank(10)
    noisy = gapped + np.random.default_rng(5).normal(size=gapped.shape)
    filled, misfit = complete_matrix(noisy, explained=0.8, shrinkage=False, tolerance=1e-6, iterations=500)
    assert len(misfit) > 5 and (np.diff(misfit) <= 1e-9).all()
    assert misfit[-1] < 0.9 * misfit[0]
    once, _ = complete_matrix(noisy, explained=0.8, shrinkage=False, tolerance=1e-6, iterations=1)
    hidden = np.isnan(gapped)
    assert np.abs(filled - matrix)[hidden].mean() < 0.2 * np.abs(once - matrix)[hidden].mean()


def test_complete_rows_start_it_near_the_end():
    _, gapped = low_rank(40)
    noisy = gapped + np.random.default_rng(5).normal(size=gapped.shape)
    _, started = complete_matrix(noisy, explained=0.99, shrinkage=True, tolerance=1e-6, iterations=500)
    _, lines = complete_matrix(noisy[30:], explained=0.8, shrinkage=True, tolerance=1e-6, iterations=500)
    assert len(started) < len(lines)


def test_the_end_of_the_iteration_is_a_fixed_point():
    _, gapped = low_rank(10)
    filled, _ = complete_matrix(gapped + 0.0, explained=0.9, shrinkage=False, tolerance=1e-9, iterations=5000)
    centred = filled - filled.mean(axis=0)
    left, sizes, right = np.linalg.svd(centred, full_matrices=False)
    errors = [
        np.abs(filled - filled.mean(axis=0) - (left[:, :r] * sizes[:r]) @ right[:r])[np.isnan(gapped)].max()
        for r in range(1, 6)
    ]
    assert min(errors) < 1e-6


def test_iterations_are_those_of_truncated_decompositions():
    _, gapped = low_rank(0)
    for iterations in (1, 4, 20):
        # All rows are incomplete: the rank comes from the straight lines.
        filled, _ = complete_matrix(gapped, explained=0.8, shrinkage=False, tolerance=0.0, iterations=iterations)
        expected = [naive.complete_matrix(gapped, rank, iterations) for rank in range(1, 8)]
        assert min(np.abs(filled - own).max() for own in expected) < 1e-6


def test_the_share_is_reached_by_the_fewest_components():
    assert [components_for_share(np.array([6.0, 3, 1]), share) for share in (0.1, 0.59, 0.61, 0.95, 1.0)] == [
        1,
        1,
        2,
        3,
        3,
    ]
