"""Where a fault can be put into a clean recording, and the randomness that it is drawn with."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np

from markermend.simulation.free_space import FreeSpace, choose
from markermend.simulation.marker_geometry import MarkerGeometry

GUARDED = 6
"""Nearest markers of a faulty one that stay free of other faults meanwhile."""


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
    geometry : MarkerGeometry
        Distances of the markers, rigid segments, limbs and the floor.
    """

    def __init__(
        self, positions: np.ndarray, markers: Sequence[str], *, rate: float, margin_s: float, rng: np.random.Generator
    ) -> None:
        self.positions, self.markers, self.rate, self.rng = positions, tuple(markers), rate, rng
        self.frames, self.geometry = len(positions), MarkerGeometry(positions, markers)
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
        near = np.argsort(np.nan_to_num(self.geometry.distances[list(markers)], nan=np.inf), axis=1)[:, : GUARDED + 1]
        self._space.take(sorted({*markers, *near.ravel().tolist()}), start, stop)
        self._moments.take([0], start, stop)
