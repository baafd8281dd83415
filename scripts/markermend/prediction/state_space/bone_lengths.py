"""Bone lengths: distances between markers that vary little, and how much they vary (BoLeRO, Li et al. 2010)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.prediction.marker_selection import evenly_spaced, reference_markers
from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class Bones:
    """Distances between pairs of markers.

    Attributes
    ----------
    pairs : np.ndarray
        Indices of the markers (bones, 2).
    length : np.ndarray
        Mean distances (bones,).
    deviation : np.ndarray
        Their standard deviations (bones,).
    """

    pairs: np.ndarray
    length: np.ndarray
    deviation: np.ndarray

    def rescaled(self, unit: float, min_deviation: float) -> Bones:
        """Express the lengths in another unit.

        Parameters
        ----------
        unit : float
            The unit, in present units.
        min_deviation : float
            Least standard deviation, in the new unit.

        Returns
        -------
        Bones
            The same bones in the new unit.
        """
        return Bones(self.pairs, self.length / unit, np.maximum(self.deviation / unit, min_deviation))


def select_bones(
    scene: Scene, body: np.ndarray, markers: np.ndarray, *, count: int, max_frames: int, min_frames: int
) -> Bones:
    """Choose the bones of markers: those to the markers whose distance varies least.

    Parameters
    ----------
    scene : Scene
        What is observed.
    body : np.ndarray
        Indices of the markers (k,) that bones may connect.
    markers : np.ndarray
        Those of them that need bones.
    count : int
        Number of bones of each.
    max_frames : int
        Largest number of frames from which lengths are estimated.
    min_frames : int
        Markers observed together in fewer frames make no bone.

    Returns
    -------
    Bones
        The bones, mm; their pairs are places in `body`.
    """
    pairs: dict[tuple[int, int], tuple[float, float]] = {}
    place = {int(marker): number for number, marker in enumerate(body)}
    for marker in markers.tolist():
        ranked, deviation = reference_markers(scene, marker, max_frames=max_frames, min_frames=min_frames)
        inside = np.flatnonzero(np.isin(ranked, body))[:count]
        rows = evenly_spaced(np.flatnonzero(scene.present[:, marker]), max_frames)
        for other, spread in zip(ranked[inside].tolist(), deviation[inside].tolist(), strict=True):
            distance = np.linalg.norm(scene.positions[rows, other] - scene.positions[rows, marker], axis=1)
            ends = sorted((place[marker], place[other]))
            pairs[ends[0], ends[1]] = float(np.nanmean(distance)), spread
    values = np.array(list(pairs.values())).reshape(-1, 2)
    return Bones(np.array(list(pairs), int).reshape(-1, 2), values[:, 0], values[:, 1])
