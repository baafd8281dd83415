"""Pieces of trajectories whose markers are to be found, and their assignment to markers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

WORST, IMPOSSIBLE = 2.0, 1e6
"""Cost of the worst match of a piece and a marker that is accepted, and one that no assignment can bear."""


@dataclass(frozen=True)
class Piece:
    """A piece of a trajectory without a gap.

    Attributes
    ----------
    name : str
        Name of the trajectory.
    start, stop : int
        Its frames, [start, stop).
    """

    name: str
    start: int
    stop: int

    def meets(self, other: Piece) -> bool:
        """Check whether another piece has a frame in common.

        Parameters
        ----------
        other : Piece
            The other one.

        Returns
        -------
        bool
            Whether it has.
        """
        return self.start < other.stop and other.start < self.stop


def assigned(costs: Mapping[Piece, Mapping[int, float]], *, min_lead: float) -> Iterator[tuple[Piece, int, float]]:
    """Assign pieces to markers one to one, with the least total cost at any time.

    Parameters
    ----------
    costs : Mapping[Piece, Mapping[int, float]]
        For each piece the cost of each marker that it may be (0 to 2); infinite where it cannot be.
    min_lead : float
        By how much the next likeliest explanation of the pieces at that time must cost more.

    Yields
    ------
    piece : Piece
        A piece.
    marker : int
        Index of its marker.
    lead : float
        By how much the next likeliest explanation costs more.
    """
    for piece, own in costs.items():
        if not np.isfinite(list(own.values())).any():
            continue
        together = [other for other in costs if other.meets(piece)]
        markers = sorted({m for other in together for m in costs[other]})
        # A piece may be no marker's at all, which costs as much as the worst that is accepted.
        cost = np.full((len(together), len(markers) + len(together)), np.inf)
        for row, other in enumerate(together):
            cost[row, : len(markers)] = [costs[other].get(m, np.inf) for m in markers]
            cost[row, len(markers) + row] = WORST
        row = together.index(piece)
        best, total = _assignment(cost)
        if best[row] < len(markers):
            m = markers[best[row]]
            cost[row, best[row]] = np.inf
            lead = _assignment(cost)[1] - total
            if lead >= min_lead:
                yield piece, m, lead


def _assignment(cost: np.ndarray) -> tuple[np.ndarray, float]:
    """The column of each row with the least total cost, and this cost."""
    from scipy.optimize import linear_sum_assignment  # 0.2 s to import, and few recordings get here

    row, column = linear_sum_assignment(np.where(np.isfinite(cost), cost, IMPOSSIBLE))
    return column[np.argsort(row)], float(cost[row, column].sum())
