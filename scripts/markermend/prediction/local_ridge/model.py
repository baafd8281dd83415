"""What regressions in a local frame learn from, and what they have in common."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from markermend.numerics.rigid_alignment import LocalFrames, align
from markermend.numerics.selection import cells
from markermend.prediction.local_ridge.pooled_rows import PooledRows


@dataclass(frozen=True, eq=False)
class LocalInputs:
    """Inputs of a regression at n frames, and the local frames that they are expressed in.

    Attributes
    ----------
    values : np.ndarray
        Local coordinates (n, 3 u) of u inputs, mm, about their typical values.
    frames : LocalFrames
        The local frames.
    """

    values: np.ndarray
    frames: LocalFrames


@dataclass(frozen=True, eq=False)
class TrainingSet:
    """A marker's training data in one local frame of anchors.

    Attributes
    ----------
    anchors, inputs : np.ndarray
        Indices of the markers that carry the frame (a,), and of the k inputs.
    template : np.ndarray
        Mean shape of the anchors (a, 3), mm.
    centre : np.ndarray
        Typical local coordinates (3 k + 3,), mm, of the inputs and, last, of the marker itself.
    local : np.ndarray
        Local coordinates (n, 3 k + 3), mm, about the centre.
    weights : np.ndarray
        Weights of the training frames (n,), between 0 and 1.
    training : np.ndarray
        Training frames (n,), ascending.
    pooled : PooledRows | None
        Training rows from the subject's other recordings in the same local frame; None where there are none.
    """

    anchors: np.ndarray
    inputs: np.ndarray
    template: np.ndarray
    centre: np.ndarray
    local: np.ndarray
    weights: np.ndarray
    training: np.ndarray
    pooled: PooledRows | None = None

    @property
    def target(self) -> np.ndarray:
        """Local coordinates of the marker (n, 3), mm, about its typical place."""
        return self.local[:, -3:]

    def design(self, used: np.ndarray) -> np.ndarray:
        """Select the columns of some inputs.

        Parameters
        ----------
        used : np.ndarray
            Which of the inputs are used, bool (k,).

        Returns
        -------
        np.ndarray
            Local coordinates (n, 3 u), mm.
        """
        if used.all():
            return self.local[:, :-3]
        columns: np.ndarray = self.local[:, np.flatnonzero(np.repeat(used, 3))]
        return columns

    def inputs_at(self, positions: np.ndarray, used: np.ndarray, rows: np.ndarray) -> LocalInputs:
        """Express the inputs in the local frame.

        Parameters
        ----------
        positions : np.ndarray
            Positions (frames, markers, 3), mm.
        used : np.ndarray
            Which of the inputs are used, bool (k,).
        rows : np.ndarray
            Frames (m,) that show the anchors and the used inputs.

        Returns
        -------
        LocalInputs
            The inputs at these frames.
        """
        frames = align(cells(positions, rows, self.anchors), self.template)
        local = frames.local(cells(positions, rows, self.inputs[used])).reshape(len(rows), -1)
        local -= self.centre[np.flatnonzero(np.repeat(used, 3))]
        return LocalInputs(local, frames)


class PoseFunction(Protocol):
    """The local position of a marker as a function of those of the used inputs."""

    def predict(self, inputs: np.ndarray) -> np.ndarray:
        """Predict the local position of the marker.

        Parameters
        ----------
        inputs : np.ndarray
            Local coordinates (n, 3 u) of the used inputs, mm, about their typical values.

        Returns
        -------
        np.ndarray
            Local positions (n, 3), mm.
        """
        ...


class Regression(PoseFunction, Protocol):
    """Such a function, trained on a TrainingSet."""

    def without(self, rows: np.ndarray) -> PoseFunction:
        """Train the function without some of the training frames.

        Parameters
        ----------
        rows : np.ndarray
            Places of these frames in the training set (h,).

        Returns
        -------
        PoseFunction
            What is left to learn.
        """
        ...

    def left_out(self, block: np.ndarray) -> np.ndarray:
        """Compute the residual of each training frame under a regression trained without its block.

        Parameters
        ----------
        block : np.ndarray
            Block of each training frame (n,), ascending numbers.

        Returns
        -------
        np.ndarray
            Residuals (n, 3), mm; NaN if there is one block only, as nothing is left to train on.
        """
        ...
