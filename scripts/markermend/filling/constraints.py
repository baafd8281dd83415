"""Constraints on a filled trajectory: continuity at the borders, and distances to the references as usual."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.numerics.kernel_density import Density


def constrain_time(predicted: np.ndarray, borders: np.ndarray) -> np.ndarray:
    """Subtract a ramp from a prediction so that it meets the observed samples at both borders.

    Parameters
    ----------
    predicted : ndarray, shape (n, 3)
        Positions from the frame before a gap to the frame after it, mm.
    borders : ndarray, shape (2, 3)
        Observed positions at the first and the last of these frames, mm; NaN beyond the ends of the recording, where
        the offset at the other border holds throughout.

    Returns
    -------
    ndarray, shape (n, 3)
        The constrained positions, mm; as predicted where no border is known.

    References
    ----------
    tits2018, eq 16-19.
    """
    offsets = predicted[[0, -1]] - borders
    known = ~np.isnan(offsets).any(axis=1)
    if not known.any():
        return predicted.copy()
    first, last = offsets[known][0], offsets[known][-1]
    share = np.linspace(0, 1, len(predicted))[:, None]
    constrained: np.ndarray = predicted - (first + share * (last - first))
    return constrained


def constrain_spacing(
    positions: np.ndarray,
    references: np.ndarray,
    densities: Sequence[Density],
    *,
    low: float,
    high: float,
    rounds: int,
) -> np.ndarray:
    """Project positions onto the shells in which their distances to the references usually lie.

    Parameters
    ----------
    positions : ndarray, shape (n, 3)
        Positions, mm; they are not modified.
    references : ndarray, shape (n, k, 3)
        Positions of the references, mm; one that is missing (NaN) does not count in that frame.
    densities : sequence of Density
        Densities of the k distances.
    low, high : float
        Probabilities of the quantiles between which a distance is usual.
    rounds : int
        Largest number of projections onto each shell, one reference after the other; fewer where every distance is usual before.

    Returns
    -------
    ndarray, shape (n, 3)
        The projected positions, mm.

    References
    ----------
    tits2018, eq 25-27.
    """
    placed = positions.copy()
    shells = [density.quantiles((low, high)) for density in densities]
    for _ in range(rounds):
        moved = False
        for r, (inner, outer) in enumerate(shells):
            away = placed - references[:, r]
            distance = np.linalg.norm(away, axis=1)
            # Rounding of the last projection is no reason for another.
            outside = (distance < inner - 1e-9) | (distance > outer + 1e-9)
            outside &= distance > 0
            usual = np.clip(distance[outside], inner, outer)
            placed[outside] = references[outside, r] + away[outside] * (usual / distance[outside])[:, None]
            moved = moved or bool(outside.any())
        if not moved:
            break
    return placed
