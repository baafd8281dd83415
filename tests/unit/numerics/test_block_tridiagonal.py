"""Cyclic reduction: against the dense solution and inverse."""

import numpy as np
import pytest

from markermend.numerics import block_tridiagonal
from support.naive import numerics as naive


def system(blocks, size=3):
    """A positive definite system: diagonal, below, right."""
    rng = np.random.default_rng(blocks)
    root = rng.normal(size=(blocks, size, size))
    diagonal = root @ root.transpose(0, 2, 1) + 6 * np.eye(size)
    return diagonal, rng.normal(size=(blocks - 1, size, size)), rng.normal(size=(blocks, size))


@pytest.mark.parametrize("blocks", [1, 2, 3, 6, 7, 16, 21])
def test_equals_the_dense_inverse(blocks):
    given = system(blocks)
    before = [array.copy() for array in given]
    solved = block_tridiagonal.solve(*given)
    assert all(np.array_equal(a, b) for a, b in zip(given, before, strict=True))
    solution, diagonal, below, log_determinant = naive.block_tridiagonal(*given)
    assert np.allclose(solved.solution, solution)
    assert np.allclose(solved.inverse_diagonal, diagonal)
    assert np.allclose(solved.inverse_below, below)
    assert np.isclose(solved.log_determinant, log_determinant)


def test_blocks_of_size_one_are_a_tridiagonal_system():
    diagonal, below, right = system(9, size=1)
    matrix = np.diag(diagonal[:, 0, 0]) + np.diag(below[:, 0, 0], -1) + np.diag(below[:, 0, 0], 1)
    solved = block_tridiagonal.solve(diagonal, below, right)
    assert np.allclose(matrix @ solved.solution[:, 0], right[:, 0])
    assert np.allclose(solved.inverse_diagonal[:, 0, 0], np.diag(np.linalg.inv(matrix)))
