"""The usual shape of a subject: how far apart each two markers are, and how much that varies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Shape:
    """The usual distances of all pairs of markers, in the order of a recording.

    Attributes
    ----------
    distance : ndarray, shape (markers, markers)
        Usual distance, mm; NaN where a pair is unknown, 0 on the diagonal.
    deviation : ndarray, shape (markers, markers)
        Robust standard deviation, mm, from the median absolute deviation: right while fewer than half of the samples are
        wrong, but small for two poses of which one is rare; NaN where a pair is unknown.
    spread : ndarray, shape (markers, markers)
        Standard deviation by the 5th and the 95th percentile, mm: covers rare poses, and faults of more than 5 % of the
        frames; NaN where a pair is unknown.
    recordings : int
        Number of the subject's recordings that they were estimated from.
    """

    distance: np.ndarray
    deviation: np.ndarray
    spread: np.ndarray
    recordings: int = 1

    def steadiest(self, marker: int, count: int, *, among: np.ndarray | None = None) -> np.ndarray:
        """List the markers to which a marker keeps its distance best.

        Parameters
        ----------
        marker : int
            Index of the marker.
        count : int
            Number of markers to list, at most.
        among : ndarray of bool, shape (markers,), optional
            The markers that may be listed; by default all others.

        Returns
        -------
        ndarray of int
            Their indices, the steadiest first; ties go to the smaller index.
        """
        deviation = self.deviation[marker].copy()
        deviation[marker] = np.nan
        if among is not None:
            deviation[~among] = np.nan
        order = np.argsort(deviation, kind="stable")
        return order[: min(count, int(np.count_nonzero(~np.isnan(deviation))))]

    def rigid_mates(self, marker: int, *, max_spread_mm: float) -> np.ndarray:
        """List the markers with which a marker forms a rigid body.

        Parameters
        ----------
        marker : int
            Index of the marker.
        max_spread_mm : float
            Largest spread of the distances between them, mm.

        Returns
        -------
        ndarray of int
            Their indices.
        """
        near = self.spread[marker] <= max_spread_mm
        near[marker] = False
        return np.flatnonzero(near)

    def unsteady(self, *, mates: int, max_spread_mm: float) -> np.ndarray:
        """Find the markers that keep their distances to too few others, such as a ball in flight.

        Parameters
        ----------
        mates : int
            Number of distances that must be kept.
        max_spread_mm : float
            Largest spread of a distance that is kept, mm.

        Returns
        -------
        ndarray of bool, shape (markers,)
            Where they are; not those with fewer known distances.
        """
        if len(self.spread) <= mates:
            return np.zeros(len(self.spread), bool)
        others = np.where(np.eye(len(self.spread), dtype=bool), np.nan, self.spread)
        unsteady: np.ndarray = np.sort(others, axis=1)[:, mates - 1] > max_spread_mm
        return unsteady


def shape_of(
    distances: dict[str, dict[str, tuple[float, float, float]]], markers: Sequence[str], recordings: int = 1
) -> Shape:
    """Arrange named distances in the order of markers.

    Parameters
    ----------
    distances : dict
        For each marker, by the name of each later one: usual distance, deviation, and spread, mm.
    markers : sequence of str
        Names of the markers in the wanted order.
    recordings : int, optional
        Number of recordings that they were estimated from.

    Returns
    -------
    Shape
        The shape; NaN for pairs that are not named.
    """
    usual = np.full((3, len(markers), len(markers)), np.nan)
    place = {marker: m for m, marker in enumerate(markers)}
    for first, others in distances.items():
        if first in place:
            known = [(place[second], values) for second, values in others.items() if second in place]
            for m, values in known:
                usual[:, place[first], m] = usual[:, m, place[first]] = values
    usual[:, range(len(markers)), range(len(markers))] = 0.0
    return Shape(usual[0], usual[1], usual[2], recordings)
