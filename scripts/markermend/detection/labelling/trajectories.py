"""The trajectories of markers under the labels that are supposed to be right, and where these are broken."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.options.detection.labels import LabelsOptions


@dataclass(frozen=True)
class LabelledTrajectories:
    """What is recorded under each label, and under which label each marker is supposed to be.

    Attributes
    ----------
    positions : np.ndarray
        Positions as recorded (frames, labels, 3), mm, NaN = missing.
    under : np.ndarray
        Under which label each marker is supposed to be recorded, int (frames, markers).
    present : np.ndarray
        Whether each label is recorded, bool (frames, labels).
    border : np.ndarray
        Where the trajectory of each label is broken, bool (frames, labels): see find_borders.
    options : LabelsOptions
        When trajectories count as broken.
    """

    positions: np.ndarray
    under: np.ndarray
    present: np.ndarray
    border: np.ndarray
    options: LabelsOptions

    def is_broken(self, m: int, frame: int) -> bool:
        """Check whether the trajectory under the label of a marker is broken.

        Parameters
        ----------
        m : int
            Index of the marker.
        frame : int
            The frame that may begin a piece.

        Returns
        -------
        bool
            Whether it is.
        """
        return bool(self.border[frame, self.under[frame, m]])

    def section_starts(self, members: Sequence[int]) -> np.ndarray:
        """List the frames at which labels of some markers may pass to each other.

        Parameters
        ----------
        members : Sequence[int]
            Indices of the markers.

        Returns
        -------
        np.ndarray
            The first frames of the sections between them, 0 among them. There the trajectories of at least `min_broken_share`
            of the markers are broken that are observed before and after. Where another label continues a trajectory, it is not
            broken.
        """
        labels = self.under[:, members]
        border = np.take_along_axis(self.border, labels, axis=1)
        frames, columns = np.nonzero(labels[1:] != labels[:-1])
        border[frames + 1, columns] = ~self._continues(frames + 1, labels[frames, columns], labels[frames + 1, columns])
        joined = np.take_along_axis(self.present, labels, axis=1)
        joined[1:] &= joined[:-1].copy()
        joined[0] = False
        broken = np.count_nonzero(border & joined, axis=1) >= self.options.min_broken_share * joined.sum(axis=1)
        return np.unique(np.concatenate([[0], np.flatnonzero(broken & border.any(axis=1))]))

    def _continues(self, frames: np.ndarray, before: np.ndarray, now: np.ndarray) -> np.ndarray:
        """Whether what is under one label from a frame on continues what was under another one before, bool (n,)."""
        step = self.positions[frames, now] - self.positions[frames - 1, before]
        jump = self.positions[frames, now] - self.positions[frames - 1, now]
        last = self.positions[frames - 1, before] - self.positions[np.maximum(frames - 2, 0), before]
        departure = np.linalg.norm(step - np.nan_to_num(last), axis=1)
        less = departure <= self.options.max_remaining_fraction * np.linalg.norm(jump, axis=1)
        continues: np.ndarray = less & (departure <= self.options.floor_mm)
        return continues
