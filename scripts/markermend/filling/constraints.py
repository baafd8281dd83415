"""What a filled trajectory must respect: continuity at the borders, and the usual distances to its references."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.numerics.kernel_density import Density


def constrain_time(predicted: np.ndarray, borders: np.ndarray) -> np.ndarray:
    """Subtract a ramp, so that a prediction meets the observed samples at both borders; source: tits2018 eq 16-19.

    predicted: (n, 3) over [start - 1, stop + 1), mm. borders: (2, 3), observed positions at its first and last frame,
    NaN where there is none (the end of a recording): then the other border's offset holds throughout.
    """
    offsets = predicted[[0, -1]] - borders
    known = ~np.isnan(offsets).any(axis=1)
    if not known.any():
        return predicted.copy()
    first, last = offsets[known][0], offsets[known][-1]
    share = np.linspace(0, 1, len(predicted))[:, None]
    return predicted - (first + share * (last - first))


def constrain_spacing(
    positions: np.ndarray,
    references: np.ndarray,
    densities: Sequence[Density],
    *,
    low: float,
    high: float,
    rounds: int,
) -> np.ndarray:
    """Project positions onto the shells in which their distances to the references usually lie; tits2018 eq 25-27.

    positions: (n, 3), mm. references: (n, k, 3), NaN = not seen, then that reference does not count. densities: of the
    k distances. The shell holds the distances between the quantiles `low` and `high`. One reference after the other, at
    most `rounds` times, until every distance is usual.
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
