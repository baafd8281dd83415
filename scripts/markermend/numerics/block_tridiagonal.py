"""Solution of symmetric block-tridiagonal systems by cyclic reduction.

Such a system is the posterior precision of a linear Gaussian chain: frame by frame, its solution and the blocks of its
inverse are what a Kalman filter followed by a Rauch-Tung-Striebel smoother computes.

With diagonal blocks ``D[t]``, blocks ``L[t]`` below them (rows of block ``t + 1``, columns of block ``t``) and right
side ``b[t]``, block row ``t`` of the system reads::

    L[t-1] x[t-1] + D[t] x[t] + L[t]' x[t+1] = b[t]                                              (1)

Elimination. With the gains ``G[t] = inv(D[t]) L[t-1]`` and ``H[t] = inv(D[t]) L[t]'``, every odd block is::

    x[t] = inv(D[t]) b[t] - G[t] x[t-1] - H[t] x[t+1]                                            (2)

Put into the rows of the even blocks ``s``, (2) leaves a block-tridiagonal system of half the length::

    D[s] - L[s]' G[s+1] - L[s-1] H[s-1]                on the diagonal                           (3)
    -L[s+1] G[s+1]                                     below it: rows of s + 2, columns of s     (4)
    b[s] - G[s+1]' b[s+1] - H[s-1]' b[s-1]             on the right side                         (5)

    log det A = log det A(reduced) + sum over odd t of log det D[t]                              (6)

Back substitution. The even blocks of the inverse ``S`` are those of the reduced system's inverse; for odd ``t``::

    S[t,t-1] = -G[t] S[t-1,t-1] - H[t] S[t+1,t-1]                                                (7)
    S[t,t+1] = -G[t] S[t-1,t+1] - H[t] S[t+1,t+1]                                                (8)
    S[t,t]   = inv(D[t]) - S[t,t-1] G[t]' - S[t,t+1] H[t]'                                       (9)

A chain of n blocks takes log2(n) rounds of stacked products.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Solution:
    """The solution of a system of n blocks of size d, with the blocks of the inverse inside the band.

    Attributes
    ----------
    solution : np.ndarray
        Solution (n, d).
    inverse_diagonal : np.ndarray
        Diagonal blocks of the inverse, (n, d, d).
    inverse_below : np.ndarray
        Blocks of the inverse below the diagonal, (n - 1, d, d): rows of block t + 1, columns of block t.
    log_determinant : float
        Logarithm of the determinant of the system's matrix.
    """

    solution: np.ndarray
    inverse_diagonal: np.ndarray
    inverse_below: np.ndarray
    log_determinant: float


@dataclass(frozen=True)
class _Elimination:
    """What remains of m eliminated (odd) blocks; each has a left neighbour, the first r also have a right one.

    inverse: inv(D), (m, d, d). left_gain: G, (m, d, d). right_gain: H, (r, d, d). scaled_right: inv(D) b, (m, d).
    """

    inverse: np.ndarray
    left_gain: np.ndarray
    right_gain: np.ndarray
    scaled_right: np.ndarray


def solve(diagonal: np.ndarray, below: np.ndarray, right: np.ndarray) -> Solution:
    """Solve a positive definite block-tridiagonal system by cyclic reduction.

    Parameters
    ----------
    diagonal : np.ndarray
        Diagonal blocks (n, d, d), symmetric; no NaN in any of the three.
    below : np.ndarray
        Blocks below the diagonal, (n - 1, d, d): rows of block t + 1, columns of block t.
    right : np.ndarray
        Right side (n, d).

    Returns
    -------
    Solution
        The solution, the inverse inside the band, and the log-determinant.

    References
    ----------
    Buzbee, Golub & Nielson (1970), "On direct methods for solving Poisson's equations", SIAM J. Numer. Anal. 7(4).
    """
    if len(right) == 1:
        inverse = np.linalg.inv(diagonal)
        return Solution(_apply(inverse, right), inverse, below, float(np.linalg.slogdet(diagonal)[1][0]))
    eliminated, *reduced = _eliminate(diagonal, below, right)
    half = solve(*reduced)
    log_determinant = float(np.linalg.slogdet(diagonal[1::2])[1].sum())  # (6)
    solution = np.empty_like(right)
    solution[::2], solution[1::2] = half.solution, _substitute(eliminated, half.solution)
    inverse, inverse_below = _band_of_inverse(eliminated, half)
    return Solution(solution, inverse, inverse_below, half.log_determinant + log_determinant)


def _eliminate(
    diagonal: np.ndarray, below: np.ndarray, right: np.ndarray
) -> tuple[_Elimination, np.ndarray, np.ndarray, np.ndarray]:
    """Eliminate the odd blocks; the rest is the reduced system: diagonal, below, right."""
    inner = (len(right) - 1) // 2  # number of eliminated blocks that have a right neighbour
    inverse, to_left, to_right = np.linalg.inv(diagonal[1::2]), below[::2], _transpose(below[1::2])
    left_gain, right_gain = inverse @ to_left, inverse[:inner] @ to_right
    reduced_diagonal, reduced_right = diagonal[::2].copy(), right[::2].copy()
    reduced_diagonal[: len(left_gain)] -= _transpose(to_left) @ left_gain  # (3)
    reduced_diagonal[1:] -= _transpose(to_right) @ right_gain
    reduced_below = -_transpose(to_right) @ left_gain[:inner]  # (4)
    reduced_right[: len(left_gain)] -= _apply(_transpose(left_gain), right[1::2])  # (5)
    reduced_right[1:] -= _apply(_transpose(right_gain), right[1::2][:inner])
    scaled_right = _apply(inverse, right[1::2])
    eliminated = _Elimination(inverse, left_gain, right_gain, scaled_right)
    return eliminated, reduced_diagonal, reduced_below, reduced_right


def _substitute(eliminated: _Elimination, even: np.ndarray) -> np.ndarray:
    """Solution (m, d) at the eliminated blocks, given that at the even ones: (2)."""
    left_gain, right_gain = eliminated.left_gain, eliminated.right_gain
    odd: np.ndarray = eliminated.scaled_right - _apply(left_gain, even[: len(left_gain)])
    odd[: len(right_gain)] -= _apply(right_gain, even[1:])
    return odd


def _band_of_inverse(eliminated: _Elimination, half: Solution) -> tuple[np.ndarray, np.ndarray]:
    """Blocks of the inverse on the diagonal (n, d, d) and below it (n - 1, d, d), given those of the reduced system."""
    left_gain, right_gain = eliminated.left_gain, eliminated.right_gain
    even, inner = half.inverse_diagonal, len(right_gain)
    with_left = -left_gain @ even[: len(left_gain)]  # (7)
    with_left[:inner] -= right_gain @ half.inverse_below
    with_right = -left_gain[:inner] @ _transpose(half.inverse_below) - right_gain @ even[1:]  # (8)
    blocks, size = len(even) + len(left_gain), even.shape[1]
    inverse, inverse_below = np.empty((blocks, size, size)), np.empty((blocks - 1, size, size))
    inverse[::2] = even
    inverse[1::2] = eliminated.inverse - with_left @ _transpose(left_gain)  # (9)
    inverse[1::2][:inner] -= with_right @ _transpose(right_gain)
    inverse_below[::2], inverse_below[1::2] = with_left, _transpose(with_right)
    return inverse, inverse_below


def _transpose(matrices: np.ndarray) -> np.ndarray:
    """Each matrix (n, d, e) transposed."""
    return matrices.transpose(0, 2, 1)


def _apply(matrices: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Each matrix (n, d, e) times its vector (n, e)."""
    products: np.ndarray = (matrices @ vectors[..., None])[..., 0]
    return products
