"""The interface of all predictors: what they are given of a recording, and what they return.

Detection, repair and filling use it: where should a marker be during a gap, and how large is the error?
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol, TypeVar, runtime_checkable

import numpy as np

from markermend.core.mesh import Mesh
from markermend.core.recording import Recording

CACHE_SIZE = 60
"""Results that a scene caches for its predictors: enough for the members and missing neighbours of one marker."""

Result = TypeVar("Result")


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


@dataclass(frozen=True)
class Scene:
    """What is observed of a recording, as the predictors see it.

    Attributes
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), float64, mm, NaN = missing or rejected.
    rate : float
        Sampling rate, Hz.
    neighbours : Sequence[np.ndarray]
        For each marker the indices of the other markers of its connected component, as the mesh ranks them.
    measured : Scene | None
        The scene before any gap was filled; None where nothing was filled.
    inherited_std : np.ndarray | None
        Standard deviation of each axis of filled samples (frames, markers), mm, 0 elsewhere; None where nothing was
        filled.
    segment_mates : Sequence[np.ndarray] | None
        For each marker the indices of the other markers of its segment and of its parent marker; None without a mesh.
    """

    positions: np.ndarray
    rate: float
    neighbours: Sequence[np.ndarray]
    measured: Scene | None = None
    inherited_std: np.ndarray | None = None
    segment_mates: Sequence[np.ndarray] | None = None

    @classmethod
    def of(cls, recording: Recording, mesh: Mesh, positions: np.ndarray | None = None) -> Scene:
        """Show a recording with the neighbours and segment mates of its mesh.

        Parameters
        ----------
        recording : Recording
            The recording.
        mesh : Mesh
            Its functional body mesh.
        positions : ndarray, shape (frames, markers, 3), optional
            Positions to show in place of the recording's, mm; NaN = missing.

        Returns
        -------
        Scene
            What predictors and detectors look at.
        """
        markers = recording.markers
        shown = recording.positions if positions is None else positions
        mates = mesh.segment_mate_indices(markers)
        return cls(shown, recording.rate, mesh.neighbour_indices(markers), segment_mates=mates)

    @cached_property
    def present(self) -> np.ndarray:
        """Whether each marker is observed, bool (frames, markers)."""
        absent = np.isnan(self.positions)
        # Ten times as fast as any() over so short an axis.
        present: np.ndarray = ~(absent[..., 0] | absent[..., 1] | absent[..., 2])
        return present

    @cached_property
    def _cache(self) -> dict[Hashable, object]:
        """Results of predictors on this scene, oldest first."""
        return {}

    def cached(self, key: Hashable, compute: Callable[[], Result]) -> Result:
        """Compute a result once for all gaps that share the scene.

        Parameters
        ----------
        key : Hashable
            Identifies the result: it must hold everything that the result depends on besides the scene.
        compute : Callable[[], Result]
            Computes the result.

        Returns
        -------
        Result
            The result, computed now or before.
        """
        if key not in self._cache:
            while len(self._cache) >= CACHE_SIZE:
                del self._cache[next(iter(self._cache))]
            self._cache[key] = compute()
        return self._cache[key]  # type: ignore[return-value]

    def without(self, marker: int, start: int, stop: int) -> Scene:
        """Hide a marker during a gap.

        Parameters
        ----------
        marker : int
            Index of the marker.
        start, stop : int
            The gap, [start, stop).

        Returns
        -------
        Scene
            The scene without these samples; the same one where none of them is observed.
        """
        if not self.present[start:stop, marker].any():
            return self
        positions = self.positions.copy()
        positions[start:stop, marker] = np.nan
        return replace(self, positions=positions, measured=None, inherited_std=None)

    def bordered(self, start: int, stop: int) -> np.ndarray:
        """List the frames of a gap and of its two borders.

        Parameters
        ----------
        start, stop : int
            The gap, [start, stop).

        Returns
        -------
        np.ndarray
            Frames (n,) from start - 1 to stop, as far as they lie in the recording.
        """
        return np.arange(max(start - 1, 0), min(stop + 1, len(self.positions)))


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


class ScaledResidualSource(Protocol):
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
