"""What stays constant while markers move: distances, rigid segments, limbs left and right, and where the floor is."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from markermend.numerics.rigid_alignment import align

SAMPLED_FRAMES = 200
"""Frames from which distances of markers are estimated."""

NORMAL_RANGE = 3.29
"""Standard deviations between the 5th and the 95th percentile of a normal distribution."""

ANCHORS = 4
"""Markers that define the orientation of the body part under a marker."""

SIDES = {"L": "R", "l": "r"}
"""Letters that tell left from right in names of markers."""


class MarkerGeometry:
    """The geometry of the markers of a clean recording.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        The clean trajectories in mm; NaN = missing.
    markers : sequence of str
        Names of the markers.

    Attributes
    ----------
    positions, markers
        As given.
    """

    def __init__(self, positions: np.ndarray, markers: Sequence[str]) -> None:
        self.positions, self.markers = positions, tuple(markers)

    @cached_property
    def _pairs(self) -> tuple[np.ndarray, np.ndarray]:
        """Median and robust standard deviation in mm of the distance of every two markers."""
        some = self.positions[:: max(1, len(self.positions) // SAMPLED_FRAMES)]
        low, middle, high = (np.full((len(self.markers),) * 2, np.nan) for _ in range(3))
        for m in range(len(self.markers)):
            apart = np.linalg.norm(some - some[:, m : m + 1], axis=2)
            seen = ~np.isnan(apart).all(axis=0)
            if seen.any():
                low[m, seen], middle[m, seen], high[m, seen] = np.nanpercentile(apart[:, seen], [5, 50, 95], axis=0)
        return middle, (high - low) / NORMAL_RANGE

    @property
    def distances(self) -> np.ndarray:
        """Median distance in mm of every two markers, (markers, markers)."""
        return self._pairs[0]

    @property
    def deviations(self) -> np.ndarray:
        """Robust standard deviation in mm of the distance of every two markers, (markers, markers)."""
        return self._pairs[1]

    def steadiest(self, marker: int) -> np.ndarray:
        """Rank the other markers by how constant their distance to a marker is.

        Parameters
        ----------
        marker : int
            Its index.

        Returns
        -------
        ndarray of int
            Indices of the others, steadiest first; near ones win among equals.
        """
        cost = (self.deviations[marker] + 0.1) * self.distances[marker]
        order = np.argsort(np.nan_to_num(cost, nan=np.inf), kind="stable")
        return np.asarray(order[order != marker])

    def rigid(self, mates: int, deviation_mm: float) -> list[int]:
        """List the markers on rigid segments.

        Parameters
        ----------
        mates : int
            How many steady markers make a segment rigid.
        deviation_mm : float
            Largest standard deviation of their distances, mm.

        Returns
        -------
        list of int
            Indices of the markers.
        """
        steady = (self.deviations < deviation_mm) & (self.distances > 0)
        found: list[int] = np.flatnonzero(steady.sum(axis=1) >= mates).tolist()
        return found

    def turned(self, vectors: np.ndarray, marker: int, start: int) -> np.ndarray:
        """Turn vectors with the body part under a marker.

        Parameters
        ----------
        vectors : ndarray of float, shape (n, 3)
            Vectors as they are in the laboratory at the first frame.
        marker : int
            Index of the marker.
        start : int
            The first frame.

        Returns
        -------
        ndarray of float, shape (n, 3)
            The vectors as the body part carries them along; unchanged where its markers are not all seen.
        """
        anchors = self.steadiest(marker)[:ANCHORS]
        points = self.positions[start : start + len(vectors), anchors]
        if np.isnan(points).any():
            return vectors
        axes = align(points, points[0] - points[0].mean(axis=0)).axes
        return np.asarray(np.einsum("nij,nj->ni", axes @ axes[0].T, vectors))

    @cached_property
    def sides(self) -> list[tuple[int, int]]:
        """Left and right markers of the same name, as pairs of indices."""
        places = {marker: m for m, marker in enumerate(self.markers)}
        pairs = []
        for marker, m in places.items():
            short = marker.rpartition(":")[2]
            for at in range(len(marker) - len(short), len(marker)):
                other = marker[:at] + SIDES.get(marker[at], "") + marker[at + 1 :]
                other = next((name for name in (other, _swap_case(other, at)) if name in places), marker)
                if marker[at] in SIDES and other != marker:
                    pairs.append((m, places[other]))
                    break
        return pairs

    @cached_property
    def vertical(self) -> int:
        """The axis along which the body extends most, at the start of the recording."""
        first = self.positions[: max(1, len(self.positions) // 10)]
        return int(np.argmax(np.nanmedian(np.nanmax(first, axis=1) - np.nanmin(first, axis=1), axis=0)))

    @cached_property
    def floor(self) -> float:
        """Height of the lowest markers, mm."""
        return float(np.nanpercentile(self.positions[..., self.vertical], 0.5))


def _swap_case(name: str, at: int) -> str:
    """The name with the letter at a place in the other case: some recordings have L_knee and r_knee."""
    return name[:at] + name[at : at + 1].swapcase() + name[at + 1 :]
