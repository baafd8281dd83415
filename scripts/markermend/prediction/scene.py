"""The scene: what is observed of a recording, with the neighbours of each marker, as predictors and detectors see it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from markermend.core.cache import CachesResults
from markermend.core.mesh import Mesh
from markermend.core.poses import Pool
from markermend.core.recording import Recording
from markermend.core.shape import Shape


@dataclass(frozen=True)
class Scene(CachesResults):
    """What is observed of a recording, as the predictors see it; it caches their results.

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
    shape : Shape | None
        The usual distances of the markers over all of the subject's recordings; None without a mesh.
    segments : Mapping[str, np.ndarray] | None
        For each segment the indices of its markers; None without a mesh.
    unlabelled : Mapping[str, np.ndarray] | None
        Positions of the unlabelled trajectories (frames, 3), mm, NaN = missing, by name; None without a mesh.
    near_jumps : np.ndarray | None
        Frames near those at which a marker is known to jump, bool (frames, markers): about the borders of what was found and
        left; None where nothing was left.
    pool : Pool | None
        Poses from the subject's other recordings, from which predictors learn besides; None where there are none.
    whole : Scene | None
        The scene of which this one hides pseudo-gaps for trial; None where it is no trial. A predictor may train on it once
        for all trials, if what it uses for each is as if it had been trained without the hidden frames.
    """

    positions: np.ndarray
    rate: float
    neighbours: Sequence[np.ndarray]
    measured: Scene | None = None
    inherited_std: np.ndarray | None = None
    segment_mates: Sequence[np.ndarray] | None = None
    shape: Shape | None = None
    segments: Mapping[str, np.ndarray] | None = None
    unlabelled: Mapping[str, np.ndarray] | None = None
    near_jumps: np.ndarray | None = None
    pool: Pool | None = None
    whole: Scene | None = None

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
        neighbours, shape = mesh.neighbour_indices(markers), mesh.shape(markers)
        segments = mesh.segment_indices(markers)
        return cls(
            shown,
            recording.rate,
            neighbours,
            segment_mates=mates,
            shape=shape,
            segments=segments,
            unlabelled=recording.unlabelled,
        )

    @cached_property
    def present(self) -> np.ndarray:
        """Whether each marker is observed, bool (frames, markers)."""
        absent = np.isnan(self.positions)
        # Ten times as fast as any() over so short an axis.
        present: np.ndarray = ~(absent[..., 0] | absent[..., 1] | absent[..., 2])
        # Markers are looked at one by one: their frames lie together.
        return np.asfortranarray(present)

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
