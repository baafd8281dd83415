"""Distances at similar poses: what recurs with the pose is motion, such as that of soft tissue, and no artifact.

The distances of a marker to its neighbours are predicted by regression on the nearest poses at other times. Neither the
regression of the whole recording nor its usual distances know that a marker may be elsewhere in one pose, time and again.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from markermend.numerics.distances import distances
from markermend.options.detection.level import SimilarPosesOptions
from markermend.prediction.scene import Scene


@dataclass(frozen=True, eq=False)
class SimilarPoses:
    """The poses of the neighbours of a marker, and its distances to them.

    Attributes
    ----------
    scene : Scene
        What is observed.
    marker : int
        Index of the marker.
    options : SimilarPosesOptions
        How many poses count, and how they are compared.
    """

    scene: Scene
    marker: int
    options: SimilarPosesOptions

    @cached_property
    def neighbours(self) -> np.ndarray:
        """Indices of the nearest neighbours (k,)."""
        nearest: np.ndarray = np.asarray(self.scene.neighbours[self.marker], int)[: self.options.neighbours]
        return nearest

    def distances(self, points: np.ndarray, frames: np.ndarray) -> np.ndarray:
        """Compute the distances of points to the neighbours.

        Parameters
        ----------
        points : np.ndarray
            The points (n, 3), mm.
        frames : np.ndarray
            The frames (n,) in which they are.

        Returns
        -------
        np.ndarray
            Distances (n, k), mm, NaN = unknown.
        """
        return distances(points, self.scene.positions[frames][:, self.neighbours])

    def predict(self, frames: np.ndarray, excluded: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
        """Predict the distances of the marker to its neighbours from the most similar poses at other times.

        Parameters
        ----------
        frames : np.ndarray
            Frames (n,) whose distances are predicted.
        excluded : tuple of int
            Frames [start, stop) from which nothing is learnt.

        Returns
        -------
        distance : np.ndarray
            Distances (n, k), mm: weighted means over the poses; NaN where unknown.
        deviation : np.ndarray
            Their standard deviations (n, k), mm, without that of the measurement: how much the distances differ among the poses,
            and how much they would differ as far as the poses do.
        """
        step = max(1, round(self.options.sampling_interval_s * self.scene.rate))
        times = np.arange(0, len(self.scene.positions), step)
        times = times[(times < excluded[0]) | (times >= excluded[1])]
        times = times[self.scene.present[times, self.marker]]
        count = min(self.options.poses, len(times))
        if not len(self.neighbours) or count < self.options.min_poses:
            unknown = np.full((len(frames), len(self.neighbours)), np.nan)
            return unknown, unknown
        apart = _root_mean_square_difference(self._pose(frames), self._pose(times))
        nearest = np.argsort(apart, axis=1, kind="stable")[:, :count]
        apart = np.take_along_axis(apart, nearest, axis=1)
        own = self.distances(self.scene.positions[times, self.marker], times)[nearest]
        # Poses without a known distance in common have no weight.
        comparable = np.isfinite(apart)
        differing = self.options.distance_slope * np.where(comparable, apart, 0.0)
        weight = np.where(comparable, 1 / (self.options.pose_tolerance_mm**2 + differing**2), 0.0)
        weights = np.where(np.isnan(own), 0.0, weight[:, :, None])
        weights /= np.maximum(weights.sum(axis=1, keepdims=True), 1e-12)
        mean = np.where(weights.any(axis=1), np.nansum(weights * own, axis=1), np.nan)
        variance = np.nansum(weights * (own - mean[:, None]) ** 2, axis=1)
        farther = (weights * differing[:, :, None]).sum(axis=1)
        return mean, np.sqrt(variance + farther**2)

    def _pose(self, frames: np.ndarray) -> np.ndarray:
        """Distances among the neighbours (n, pairs), mm."""
        some = self.scene.positions[frames][:, self.neighbours]
        one, other = np.triu_indices(len(self.neighbours), 1)
        pose: np.ndarray = np.linalg.norm(some[:, one] - some[:, other], axis=2)
        return pose


def _root_mean_square_difference(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Differences (n, m), mm, between poses (n, pairs) and (m, pairs), over the pairs known in both; infinite without any."""
    squared = (one[:, None] - other[None]) ** 2
    known = ~np.isnan(squared)
    mean = np.where(known, squared, 0.0).sum(axis=2) / np.maximum(known.sum(axis=2), 1)
    return np.where(known.any(axis=2), np.sqrt(mean), np.inf)
