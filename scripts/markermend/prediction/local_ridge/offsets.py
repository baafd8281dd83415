"""Offsets of rows: those of a recording, whose markers are attached anew, and those of stretches of time, in which markers shift.

A regression whose rows are taken about a share of the mean of their group is the generalised least squares with an offset of each
group that is random (share below 1) or unknown (1).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Offsets:
    """Groups of training frames whose rows may have an offset of their own.

    Attributes
    ----------
    group : np.ndarray
        Number of the group of each training frame (n,), ascending.
    share : float
        Share of the mean of the group that is subtracted: 0 where groups have no offset, towards 1 the more offsets vary.

    References
    ----------
    Fuller & Battese (1973), Journal of the American Statistical Association 68(343).
    """

    group: np.ndarray
    share: float

    @classmethod
    def none(cls, rows: int) -> Offsets:
        """Give no offset to any row.

        Parameters
        ----------
        rows : int
            Number of rows.

        Returns
        -------
        Offsets
            No offsets.
        """
        return cls(np.zeros(rows, int), 0.0)

    @property
    def groups(self) -> int:
        """Number of groups that have offsets."""
        return int(self.group[-1]) + 1 if self.share else 0

    @classmethod
    def of_stretches(cls, frames: np.ndarray, *, length: int, share: float) -> Offsets:
        """Give an offset to each stretch of time.

        Parameters
        ----------
        frames : np.ndarray
            Training frames (n,), ascending.
        length : int
            Frames of a stretch.
        share : float
            Share of the mean that is subtracted.

        Returns
        -------
        Offsets
            The offsets.
        """
        return cls((frames - frames[0]) // length, share)


def about_mean(rows: np.ndarray, weights: np.ndarray, group: np.ndarray) -> np.ndarray:
    """Subtract from rows the weighted mean of their group.

    Parameters
    ----------
    rows : np.ndarray
        Rows (m, columns).
    weights : np.ndarray
        Weights of the rows (m,), positive.
    group : np.ndarray
        Number of the group of each row (m,), ascending.

    Returns
    -------
    np.ndarray
        The differences (m, columns).
    """
    starts = np.flatnonzero(np.diff(group, prepend=-1))
    means = np.add.reduceat(rows * weights[:, None], starts) / np.add.reduceat(weights, starts)[:, None]
    return rows - np.repeat(means, np.diff(np.append(starts, len(rows))), axis=0)
