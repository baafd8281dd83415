"""Other labels than those as recorded or as supposed so far, and the stretches over which samples fit better under them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.detection.labelling.permutations import Permutation


@dataclass(frozen=True)
class Relabelling:
    """Other labels of some markers.

    Attributes
    ----------
    permutation : Permutation
        Under which label each marker is.
    as_recorded : bool
        Whether these are labels as recorded, else labels after the changes that were found so far.
    """

    permutation: Permutation
    as_recorded: bool = False

    @property
    def markers(self) -> list[int]:
        """Indices of the markers."""
        return list(self.permutation.markers)

    def of(self, under: np.ndarray) -> np.ndarray:
        """Relabel the markers.

        Parameters
        ----------
        under : np.ndarray
            Under which label each marker was supposed to be recorded, int (frames, markers).

        Returns
        -------
        np.ndarray
            The same with other labels; frames in which the markers are exchanged with others stay as they are.
        """
        members, labels = self.markers, list(self.permutation.labels)
        after = under.copy()
        after[:, members] = labels if self.as_recorded else under[:, labels]
        if self.as_recorded:
            closed = (np.sort(after[:, members], axis=1) == np.sort(under[:, members], axis=1)).all(axis=1)
            after[~closed] = under[~closed]
        return after


@dataclass(frozen=True)
class LabelChange:
    """Other labels over a stretch, under which the samples fit better.

    Attributes
    ----------
    relabelling : Relabelling
        The labels.
    start, stop : int
        The stretch, [start, stop).
    evidence : float
        Gain of log likelihood, counting frames that are close in time as one.
    """

    relabelling: Relabelling
    start: int
    stop: int
    evidence: float

    @property
    def place(self) -> tuple[Relabelling, int, int]:
        """The labels and the stretch."""
        return self.relabelling, self.start, self.stop
