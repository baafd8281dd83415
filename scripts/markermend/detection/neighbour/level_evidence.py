"""Evidence of a displaced level: whether the residual and the usual distances of a marker fit better without a displacement.

The residual shows how far a marker is from where its neighbours predict it, the distances how far from where the subject's
shape has it. The residual of a short recording has learnt part of the displacement; the shape has not.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from markermend.detection.neighbour.similar_poses import SimilarPoses
from markermend.numerics import robust
from markermend.options.detection.level import LevelOptions
from markermend.options.shape import ShapeOptions
from markermend.prediction.scene import Scene
from markermend.prediction.shape_evidence import ShapeEvidence

AXES = 3
"""Distances to any number of markers tell no more than the three coordinates."""

MIN_SCALE_MM = 1e-3
"""A residual smaller than this is rounded."""


@dataclass(frozen=True, eq=False)
class LevelEvidence:
    """What the level of one marker says for or against a displacement.

    Attributes
    ----------
    scene : Scene
        What is observed, without what earlier detectors claimed.
    marker : int
        Index of the marker.
    residual : np.ndarray
        Its residual (frames, 3), mm, NaN = missing.
    options : LevelOptions
        What remains in the residual, and over which time levels vary.
    shape : ShapeOptions
        Numbers of distances that count.
    """

    scene: Scene
    marker: int
    residual: np.ndarray
    options: LevelOptions
    shape: ShapeOptions

    @cached_property
    def _shape(self) -> ShapeOptions:
        """The options of the shape for comparisons of levels, which are finer than contradictions."""
        return replace(self.shape, min_deviation_mm=self.options.min_shape_deviation_mm)

    @cached_property
    def _scale(self) -> np.ndarray:
        """Robust standard deviation of the residual (3,), mm."""
        return np.array([max(robust.mad_std(axis), MIN_SCALE_MM) for axis in self.residual.T])

    @cached_property
    def _poses(self) -> SimilarPoses:
        """The poses of the neighbours."""
        return SimilarPoses(self.scene, self.marker, self.options.similar_poses)

    @cached_property
    def _anchors(self) -> np.ndarray:
        """The markers whose distances count: none without a shape, or with too few of them."""
        if self.scene.shape is None:
            return np.zeros(0, int)
        anchors = self.scene.shape.steadiest(self.marker, self._shape.anchors)
        return anchors if len(anchors) >= self._shape.min_anchors else anchors[:0]

    def log_ratio(self, displacement: np.ndarray, frames: np.ndarray) -> float:
        """Compare a displacement with none.

        Parameters
        ----------
        displacement : np.ndarray
            By how much the marker is displaced (3,), mm.
        frames : np.ndarray
            In which frames (n,).

        Returns
        -------
        float
            Logarithm of the likelihood with the displacement less that without it; 0 where nothing is known.
        """
        return sum(self.log_ratios(displacement, frames))

    def log_ratios(self, displacement: np.ndarray, frames: np.ndarray) -> tuple[float, float]:
        """Compare a displacement with none, by the residual and by the usual distances.

        Parameters
        ----------
        displacement : np.ndarray
            By how much the marker is displaced (3,), mm.
        frames : np.ndarray
            In which frames (n,).

        Returns
        -------
        tuple[float, float]
            Logarithms of the likelihood with the displacement less that without it, of the residual and of the distances; each is 0 where
            nothing is known.
        """
        weight = self._weight(frames)
        parts = self.options.remaining_fractions
        residual = [weight * self._of_residual(part * displacement, frames) for part in parts]
        average = float(np.logaddexp.reduce(residual)) - float(np.log(len(parts)))
        return average, weight * self._of_shape(displacement, frames)

    def recurrence(self, displacement: np.ndarray, frames: np.ndarray, *, apart: int) -> float:
        """Compare a displacement with none at similar poses at other times: what recurs with the pose is motion.

        Parameters
        ----------
        displacement : np.ndarray
            By how much the marker is displaced (3,), mm.
        frames : np.ndarray
            In which frames (n,).
        apart : int
            Frames beside these that are no other time.

        Returns
        -------
        float
            Logarithm of the likelihood with the displacement less that without it, at most 0: that the marker is elsewhere at similar
            poses is no evidence for a displacement, since motion may differ.
        """
        poses, count = self._poses, self.options.similar_poses.max_samples
        some = frames[np.unique(np.linspace(0, len(frames) - 1, count).astype(int))]
        usual, deviation = poses.predict(some, excluded=(int(frames[0]) - apart, int(frames[-1]) + 1 + apart))
        scale = np.hypot(deviation, self.options.similar_poses.min_deviation_mm)
        points = self.scene.positions[some, self.marker]
        before, after = (poses.distances(own, some) - usual for own in (points, points - displacement))
        return min(0.0, self._weight(frames) * self._of_distances(before, after, scale))

    def _weight(self, frames: np.ndarray) -> float:
        """How many independent samples frames (n,) are worth: those nearer than the time over which levels vary say the same."""
        return 1 + len(frames) / (self.options.correlation_time_s * self.scene.rate)

    def _of_residual(self, displacement: np.ndarray, frames: np.ndarray) -> float:
        """The part of the residual, by a multivariate t distribution about 0: the mean over the frames."""
        own, freedom = self.residual[frames], self._shape.degrees_of_freedom
        before, after = (((values / self._scale) ** 2).sum(axis=1) for values in (own, own - displacement))
        return _mean_known((freedom + AXES) / 2 * (np.log1p(before / freedom) - np.log1p(after / freedom)))

    def _of_shape(self, displacement: np.ndarray, frames: np.ndarray) -> float:
        """The part of the usual distances: the mean by precision, for each of three coordinates, over the frames."""
        if self.scene.shape is None or not len(self._anchors):
            return 0.0
        evidence = ShapeEvidence(self.scene.positions[frames], self.scene.shape, self._shape)
        scale = evidence.scale(self.marker, self._anchors)
        points = self.scene.positions[frames, self.marker]
        before, after = (
            evidence.deviations(self.marker, self._anchors, points=own) for own in (points, points - displacement)
        )
        return self._of_distances(before, after, np.broadcast_to(scale, before.shape))

    def _of_distances(self, before: np.ndarray, after: np.ndarray, scale: np.ndarray) -> float:
        """The part of distances that deviate (n, k), mm, as they are and less a displacement, with standard deviations."""
        freedom = self._shape.degrees_of_freedom
        before, after = (np.log1p((deviation / scale) ** 2 / freedom) for deviation in (before, after))
        ratio = (freedom + 1) / 2 * (before - after)
        weight = np.where(np.isnan(ratio), 0.0, scale**-2)
        mean = (np.nan_to_num(ratio) * weight).sum(axis=1) / np.maximum(weight.sum(axis=1), 1e-12)
        return AXES * _mean_known(np.where(weight.any(axis=1), mean, np.nan))


def _mean_known(values: np.ndarray) -> float:
    """Mean of what is known; 0 where nothing is."""
    known = values[~np.isnan(values)]
    return float(known.mean()) if len(known) else 0.0
