"""Symmetric block-tridiagonal systems, such as the posterior of a Gaussian chain, by cyclic reduction.

Every other block is eliminated at once, and what remains is such a system of half the length. A chain of n frames takes
log2(n) rounds of stacked products; frame by frame it is what the filter and the backward smoother find.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Solved:
    """The solution of a system of n blocks of size d, and those blocks of the inverse where the system has blocks.

    solution: (n, d). diagonal: (n, d, d). below: (n - 1, d, d), rows of block t + 1 and columns of block t.
    log_determinant: of the system's matrix.
    """

    solution: np.ndarray
    diagonal: np.ndarray
    below: np.ndarray
    log_determinant: float


def solve(diagonal: np.ndarray, below: np.ndarray, right: np.ndarray) -> Solved:
    """Solve a positive definite block-tridiagonal system.

    diagonal: (n, d, d), symmetric. below: (n - 1, d, d), rows of block t + 1 and columns of block t. right: (n, d).
    None may hold NaN. Source: block cyclic reduction (Buzbee, Golub & Nielson 1970), with the inverse carried back.
    """
    blocks = len(right)
    if blocks == 1:
        inverse = np.linalg.inv(diagonal)
        return Solved(_times(inverse, right), inverse, below, float(np.linalg.slogdet(diagonal)[1][0]))
    # Of `blocks // 2` that are eliminated, all have one before them and `inner` one after them.
    inner = (blocks - 1) // 2
    own, to_left, to_right = np.linalg.inv(diagonal[1::2]), below[::2], _turned(below[1::2])
    left, after = own @ to_left, own[:inner] @ to_right
    kept, pulled = diagonal[::2].copy(), right[::2].copy()
    kept[: len(left)] -= _turned(to_left) @ left
    kept[1:] -= _turned(to_right) @ after
    pulled[: len(left)] -= _times(_turned(left), right[1::2])
    pulled[1:] -= _times(_turned(after), right[1::2][:inner])
    half = solve(kept, -_turned(to_right) @ left[:inner], pulled)
    solution, inverse, cross = np.empty_like(right), np.empty_like(diagonal), np.empty(below.shape)
    solution[::2], inverse[::2] = half.solution, half.diagonal
    solution[1::2] = _times(own, right[1::2]) - _times(left, half.solution[: len(left)])
    solution[1::2][:inner] -= _times(after, half.solution[1:])
    with_left = -left @ half.diagonal[: len(left)]
    with_left[:inner] -= after @ half.below
    with_right = -left[:inner] @ _turned(half.below) - after @ half.diagonal[1:]
    inverse[1::2] = own - with_left @ _turned(left)
    inverse[1::2][:inner] -= with_right @ _turned(after)
    cross[::2], cross[1::2] = with_left, _turned(with_right)
    eliminated = float(np.linalg.slogdet(diagonal[1::2])[1].sum())
    return Solved(solution, inverse, cross, half.log_determinant + eliminated)


def _turned(matrices: np.ndarray) -> np.ndarray:
    """Each matrix transposed."""
    return matrices.transpose(0, 2, 1)


def _times(matrices: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Each matrix times its vector."""
    return (matrices @ vectors[..., None])[..., 0]
