"""Poses of a subject: a bounded sample of frames from all of the subject's recordings, from which predictors learn."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from markermend.core.cache import CachesResults


@dataclass(frozen=True, eq=False)
class Pool(CachesResults):
    """Poses from the subject's other recordings, as the predictors of one recording see them; it caches their results.

    Attributes
    ----------
    positions : np.ndarray
        Positions (rows, markers, 3), mm, NaN = missing; markers as in the recording.
    recording : np.ndarray
        Number of the recording of each row (rows,), ascending from 0 without a gap.
    names : tuple of str
        Names of these recordings.
    """

    positions: np.ndarray
    recording: np.ndarray
    names: tuple[str, ...]

    @cached_property
    def present(self) -> np.ndarray:
        """Whether each marker is seen, bool (rows, markers)."""
        present: np.ndarray = ~np.isnan(self.positions).any(axis=2)
        return present

    def rows_with(self, markers: Sequence[int], *, fewest: int) -> np.ndarray:
        """List the rows that show markers.

        Parameters
        ----------
        markers : sequence of int
            Indices of the markers.
        fewest : int
            Recordings with fewer such rows are left out.

        Returns
        -------
        np.ndarray
            Indices of the rows (n,), ascending.
        """
        shown = self.present[:, markers].all(axis=1)
        count = np.bincount(self.recording[shown], minlength=len(self.names))
        return np.flatnonzero(shown & (count >= fewest)[self.recording])


@dataclass(frozen=True, eq=False)
class Poses:
    """A bounded sample of the poses of a subject.

    Attributes
    ----------
    markers : tuple of str
        Names of all markers of the subject.
    positions : np.ndarray
        Positions after repair (rows, markers, 3), mm, NaN = missing, or not a marker of that recording.
    recordings : tuple of str
        Names of the recordings.
    recording : np.ndarray
        Index of the recording of each row (rows,), ascending.
    frames : np.ndarray
        Index of the frame in its recording of each row (rows,), ascending within a recording.
    """

    markers: tuple[str, ...]
    positions: np.ndarray
    recordings: tuple[str, ...]
    recording: np.ndarray
    frames: np.ndarray

    def others(self, recording: str, markers: Sequence[str], *, among: Collection[str] | None = None) -> Pool | None:
        """Show the poses of the other recordings to one recording.

        Parameters
        ----------
        recording : str
            Name of the recording; its own poses are left out.
        markers : sequence of str
            Its markers.
        among : collection of str, optional
            Names of the recordings that share its mesh; poses of no others are shown. By default of all.

        Returns
        -------
        Pool or None
            The poses with these markers; None where no other recording shows any of them.
        """
        place = {name: column for column, name in enumerate(self.markers)}
        columns = [place.get(name, -1) for name in markers]
        known = np.array(columns) >= 0
        if not known.any():
            return None
        positions = np.where(known[:, None], self.positions[:, columns], np.nan)
        shown = set(self.recordings if among is None else among) - {recording}
        kept = np.array([name in shown for name in self.recordings], bool)[self.recording]
        kept &= ~np.isnan(positions).all(axis=(1, 2))
        if not kept.any():
            return None
        numbers, recordings = np.unique(self.recording[kept], return_inverse=True)
        return Pool(positions[kept], recordings, tuple(self.recordings[number] for number in numbers))
