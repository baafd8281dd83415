"""Where a fault can be put into a clean recording, and what a fault has to follow there: paths, rigid mates, limbs, the floor."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from functools import cached_property

import numpy as np

from markermend.numerics.rigid_alignment import align
from markermend.simulation.free_space import FreeSpace, choose

SAMPLED_FRAMES = 200
"""Frames from which distances of markers are estimated."""

NORMAL_RANGE = 3.29
"""Standard deviations between the 5th and the 95th percentile of a normal distribution."""

ANCHORS = 4
"""Markers that define the orientation of the body part under a marker."""

GUARDED = 6
"""Nearest markers of a faulty one that stay free of other faults meanwhile."""

SIDES = {"L": "R", "l": "r"}
"""Letters that tell left from right in names of markers."""


class Site:
    """A clean recording, and the stretches of it that no fault was put into yet.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        The clean trajectories in mm; NaN = missing. They are not changed.
    markers : sequence of str
        Names of the markers.
    rate : float
        Frame rate in Hz.
    margin_s : float
        Time kept free around each fault, s.
    rng : Generator
        Source of randomness.

    Attributes
    ----------
    positions, markers, rate, rng
        As given.
    frames : int
        Number of frames.
    """

    def __init__(
        self, positions: np.ndarray, markers: Sequence[str], *, rate: float, margin_s: float, rng: np.random.Generator
    ) -> None:
        self.positions, self.markers, self.rate, self.rng = positions, tuple(markers), rate, rng
        self.frames = len(positions)
        missing = np.isnan(positions).any(axis=2)
        margin = max(1, round(margin_s * rate))
        self._space = FreeSpace(missing.copy(), margin=margin, one_at_a_time=False)
        self._moments = FreeSpace(np.zeros((self.frames, 1), bool), margin=margin, one_at_a_time=False)

    def duration(self, low_s: float, high_s: float) -> int:
        """Draw a duration, log-uniformly.

        Parameters
        ----------
        low_s, high_s : float
            Its bounds, s.

        Returns
        -------
        int
            Frames, at least 1.
        """
        return max(1, round(float(np.exp(self.rng.uniform(np.log(low_s), np.log(high_s)))) * self.rate))

    def direction(self) -> np.ndarray:
        """Draw a direction.

        Returns
        -------
        ndarray of float, shape (3,)
            Unit vector.
        """
        vector = self.rng.normal(0.0, 1.0, 3)
        return np.asarray(vector / np.linalg.norm(vector))

    def along(self, sizes: np.ndarray) -> np.ndarray:
        """Displace along a random direction.

        Parameters
        ----------
        sizes : ndarray of float, shape (n,)
            How far, mm.

        Returns
        -------
        ndarray of float, shape (n, 3)
            The displacement, mm.
        """
        return np.asarray(sizes[:, None] * self.direction())

    def place(self, length: int, *, among: Collection[int] | None = None, at: str = "anywhere") -> tuple[int, int]:
        """Choose a marker and a stretch of it that are free.

        Parameters
        ----------
        length : int
            Frames of the stretch.
        among : collection of int, optional
            The markers to choose from; by default all.
        at : str
            A key of free_space.PLACES.

        Returns
        -------
        start, marker : int
            First row, and index of the marker.

        Raises
        ------
        ValueError
            If nothing is free.
        """
        free = self._space.starts(length, at=at, ends=at != "anywhere")
        if among is not None:
            free[:, [m for m in range(free.shape[1]) if m not in among]] = False
        return choose(free, self.rng)

    def place_group(
        self, groups: Sequence[Sequence[int]], length: int, *, at: str = "anywhere"
    ) -> tuple[int, list[int]]:
        """Choose a group of markers and a stretch in which all of them are free.

        Parameters
        ----------
        groups : sequence of sequence of int
            The groups to choose from.
        length : int
            Frames of the stretch.
        at : str
            A key of free_space.PLACES.

        Returns
        -------
        start : int
            First row.
        group : list of int
            The markers.

        Raises
        ------
        ValueError
            If nothing is free.
        """
        if not len(groups):
            raise ValueError("no group of markers is suitable")
        free = self._space.starts(length, at=at, ends=at != "anywhere")
        start, chosen = choose(np.stack([free[:, list(group)].all(axis=1) for group in groups], axis=1), self.rng)
        return start, list(groups[chosen])

    def place_all(self, length: int, *, at: str = "anywhere") -> int:
        """Choose a stretch in which no marker has a fault yet; some may be missing there.

        Parameters
        ----------
        length : int
            Frames of the stretch.
        at : str
            A key of free_space.PLACES.

        Returns
        -------
        int
            First row.

        Raises
        ------
        ValueError
            If nothing is free.
        """
        return choose(self._moments.starts(length, at=at, ends=at != "anywhere"), self.rng)[0]

    def take(self, markers: Sequence[int], start: int, stop: int) -> None:
        """Mark a stretch of some markers, and of those nearest to them, as no longer free.

        Parameters
        ----------
        markers : sequence of int
            Indices of the markers.
        start, stop : int
            Half-open interval of rows.
        """
        near = np.argsort(np.nan_to_num(self.distances[list(markers)], nan=np.inf), axis=1)[:, : GUARDED + 1]
        self._space.take(sorted({*markers, *near.ravel().tolist()}), start, stop)
        self._moments.take([0], start, stop)

    @cached_property
    def _pairs(self) -> tuple[np.ndarray, np.ndarray]:
        """Median and robust standard deviation in mm of the distance of every two markers."""
        some = self.positions[:: max(1, self.frames // SAMPLED_FRAMES)]
        low, middle, high = (np.full((len(self.markers),) * 2, np.nan) for _ in range(3))
        for m in range(len(self.markers)):
            apart = np.linalg.norm(some - some[:, m : m + 1], axis=2)
            seen = ~np.isnan(apart).all(axis=0)
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
        first = self.positions[: max(1, self.frames // 10)]
        return int(np.argmax(np.nanmedian(np.nanmax(first, axis=1) - np.nanmin(first, axis=1), axis=0)))

    @cached_property
    def floor(self) -> float:
        """Height of the lowest markers, mm."""
        return float(np.nanpercentile(self.positions[..., self.vertical], 0.5))


def _swap_case(name: str, at: int) -> str:
    """The name with the letter at a place in the other case: some recordings have L_knee and r_knee."""
    return name[:at] + name[at : at + 1].swapcase() + name[at + 1 :]
