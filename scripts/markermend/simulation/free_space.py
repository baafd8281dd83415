"""Which stretches of a recording are still free for another artifact, and a random choice among them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

PLACES = {"anywhere": slice(0, 0), "start": slice(1, None), "stop": slice(0, -1)}
"""Where a stretch may lie, and the starts that this rules out."""


class FreeSpace:
    """The samples of a recording that nothing was put into yet.

    Parameters
    ----------
    taken : ndarray of bool, shape (frames, markers)
        Samples that are not free; changed as more is taken.
    margin : int
        Frames that stay free on either side of what is put in.
    one_at_a_time : bool
        Whether a frame is free only while no marker is taken in it.
    """

    def __init__(self, taken: np.ndarray, *, margin: int, one_at_a_time: bool) -> None:
        self.margin = margin
        self._taken = taken
        self._one_at_a_time = one_at_a_time

    def starts(self, length: int, *, at: str = "anywhere", ends: bool = False) -> np.ndarray:
        """Determine from which frames on a stretch is free.

        Parameters
        ----------
        length : int
            Frames of the stretch.
        at : str
            A key of PLACES: "start" or "stop" of the recording, or "anywhere".
        ends : bool
            Whether the margin may lie beyond the ends of the recording.

        Returns
        -------
        ndarray of bool, shape (starts, markers)
            True where the stretch, and the margin around it, are free.

        Raises
        ------
        ValueError
            If the recording is shorter than the stretch.
        """
        frames, markers = self._taken.shape
        if length > frames:
            raise ValueError(f"{length} frames do not fit into a recording of {frames}")
        taken = (
            np.repeat(np.any(self._taken, axis=1, keepdims=True), markers, axis=1)
            if self._one_at_a_time
            else self._taken
        )
        padded = np.pad(taken, ((self.margin, self.margin), (0, 0)), constant_values=not ends)
        total = np.pad(np.cumsum(padded, axis=0), ((1, 0), (0, 0)))
        width = length + 2 * self.margin
        free = np.asarray(total[width:] == total[:-width])
        free[PLACES[at]] = False
        return free

    def take(self, markers: Sequence[int], start: int, stop: int) -> None:
        """Mark samples as taken.

        Parameters
        ----------
        markers : sequence of int
            Indices of the markers.
        start, stop : int
            Half-open interval of rows.
        """
        self._taken[start:stop, markers] = True


def choose(free: np.ndarray, rng: np.random.Generator) -> tuple[int, int]:
    """Choose a random start and marker among those that are free.

    Parameters
    ----------
    free : ndarray of bool, shape (starts, markers)
        As FreeSpace.starts gives it.
    rng : Generator
        Source of randomness.

    Returns
    -------
    start, marker : int
        Indices.

    Raises
    ------
    ValueError
        If nothing is free.
    """
    places = np.flatnonzero(free)
    if not len(places):
        raise ValueError("no room left for another artifact")
    start, marker = np.unravel_index(rng.choice(places), free.shape)
    return int(start), int(marker)
