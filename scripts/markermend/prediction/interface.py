"""The interface of all predictors: what they are asked about a scene, and what they return.

Detection, repair and filling use it: where should a marker be during a gap, and how large is the error?
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np

from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class Prediction:
    """Where a marker should be at n frames.

    Attributes
    ----------
    positions : np.ndarray
        Positions (n, 3), mm, NaN where the method makes no prediction.
    error : np.ndarray
        Standard deviation of each axis (n,), mm, NaN where the method does not state one.
    """

    positions: np.ndarray
    error: np.ndarray

    @classmethod
    def empty(cls, start: int, stop: int) -> Prediction:
        """Make a prediction that is NaN throughout a gap and at its borders.

        Parameters
        ----------
        start, stop : int
            The gap, [start, stop).

        Returns
        -------
        Prediction
            NaN at stop - start + 2 frames; the arrays are its own and may be written to.
        """
        frames = stop - start + 2
        return cls(np.full((frames, 3), np.nan), np.full(frames, np.nan))


class Predictor(Protocol):
    """A method that predicts a marker during a gap.

    Attributes
    ----------
    name : str
        Name of the predictor, as in the config.
    continuous : bool
        Whether predictions meet the observed samples at the borders by themselves; otherwise the time constraint has to
        be applied (tits2018 eq 16-19).
    """

    name: str
    continuous: bool

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """Predict a marker during a gap and at the frame on either side of it.

        Parameters
        ----------
        scene : Scene
            What is observed; the marker's samples in the gap are not used.
        marker : int
            Index of the marker.
        start, stop : int
            The gap, [start, stop).

        Returns
        -------
        Prediction
            At the stop - start + 2 frames [start - 1, stop + 1); NaN at borders outside the recording.
        """
        ...


@runtime_checkable
class Trainable(Protocol):
    """A predictor that trains for several markers and scenes at once much faster than one by one."""

    def train(self, jobs: Sequence[tuple[Scene, int]]) -> None:
        """Train for the gaps of markers in scenes; the scenes cache the results for `predict`.

        Parameters
        ----------
        jobs : Sequence[tuple[Scene, int]]
            Scenes and indices of markers.
        """
        ...


@runtime_checkable
class Abridgeable(Protocol):
    """A predictor that trains so long that pseudo-gaps have to do with less."""

    def abridged(self) -> Predictor:
        """Make the same predictor with less training.

        Returns
        -------
        Predictor
            What is tried on pseudo-gaps in place of this one.
        """
        ...


@runtime_checkable
class LocallyContinuous(Protocol):
    """A predictor in a local frame of reference, in which its predictions can be made to meet the observed samples."""

    def predict_continuous(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """Predict a marker, and subtract a ramp in the local frame so that the observed samples at the borders are met.

        Parameters
        ----------
        scene : Scene
            What is observed; the marker's samples in the gap are not used.
        marker : int
            Index of the marker.
        start, stop : int
            The gap, [start, stop).

        Returns
        -------
        Prediction
            As `Predictor.predict` gives it; NaN where the local frame is not known at both borders.
        """
        ...


@dataclass(frozen=True, eq=False)
class LocalRegression:
    """The regression of a marker on its neighbours in one local frame, where it can be predicted.

    Attributes
    ----------
    marker : int
        Index of the marker.
    frames : np.ndarray
        Frames (n,), ascending.
    inputs : np.ndarray
        Inputs (n, columns), mm.
    target : np.ndarray
        Observed positions (n, 3) in the axes of the local frame, mm.
    residual : np.ndarray
        Observed minus predicted positions (n, 3), mm, laboratory axes.
    factors : np.ndarray
        Factors (n,), at least 1, by which the leverage of the pose widens the distribution of the residual.
    """

    marker: int
    frames: np.ndarray
    inputs: np.ndarray
    target: np.ndarray
    residual: np.ndarray
    factors: np.ndarray


class RegressionSource(Protocol):
    """A predictor that shows the regressions of its markers."""

    def regressions(self, scene: Scene, markers: np.ndarray | None = None, *, blocks: int) -> Iterator[LocalRegression]:
        """Fit the regressions of markers to all frames with robust weights.

        Parameters
        ----------
        scene : Scene
            What is observed.
        markers : np.ndarray | None
            Indices of the markers to predict; all if None.
        blocks : int
            Number of equal parts of the recording that are left out of the training in turn to estimate the factors.

        Yields
        ------
        LocalRegression
            Each frame of a marker that can be predicted is in one of them.
        """
        ...


class ScaledResidualSource(RegressionSource, Protocol):
    """A predictor that also states how its errors grow with the leverage of the pose."""

    def scaled_residuals(
        self, scene: Scene, markers: np.ndarray | None = None, *, blocks: int
    ) -> tuple[np.ndarray, np.ndarray]:
        """Compute residuals, and the factors by which the leverage of the pose widens their distribution.

        Parameters
        ----------
        scene : Scene
            What is observed.
        markers : np.ndarray | None
            Indices of the markers to predict; all if None.
        blocks : int
            Number of equal parts of the recording that are left out of the training in turn to estimate the factors.

        Returns
        -------
        residuals : np.ndarray
            Observed minus predicted positions (frames, markers, 3), mm; NaN where either is missing.
        factors : np.ndarray
            Factors (frames, markers), at least 1; NaN likewise.
        """
        ...


class ResidualSource(Protocol):
    """A predictor that predicts every marker in all frames from the other markers of the scene."""

    def residuals(self, scene: Scene, markers: np.ndarray | None = None) -> np.ndarray:
        """Compute how far markers are from their predictions.

        Parameters
        ----------
        scene : Scene
            What is observed.
        markers : np.ndarray | None
            Indices of the markers to predict; all if None.

        Returns
        -------
        np.ndarray
            Observed minus predicted positions (frames, markers, 3), mm, laboratory axes; NaN where either is missing
            and for the other markers.
        """
        ...
