"""Evidence of level against shape: whether points are where the usual distances of a marker say, frame by frame.

No change from one frame to the next is needed. Every explanation of a scene (as it is, under another label, displaced, not
a marker of the subject) states which points belong to which marker, and has a likelihood.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import lgamma

import numpy as np

from markermend.core.shape import Shape
from markermend.numerics.distances import distances
from markermend.options.shape import ShapeOptions


@dataclass(frozen=True)
class ShapeEvidence:
    """What the usual distances say of the positions of a recording.

    Attributes
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing.
    shape : Shape
        The usual distances of these markers.
    options : ShapeOptions
        Numbers of anchors, and what contradicts the shape.
    """

    positions: np.ndarray
    shape: Shape
    options: ShapeOptions

    def anchors(self, marker: int, *, among: np.ndarray | None = None) -> np.ndarray:
        """List the markers by whose distances a marker is judged.

        Parameters
        ----------
        marker : int
            Index of the marker.
        among : np.ndarray | None
            The markers that may serve, bool (markers,); by default all others.

        Returns
        -------
        np.ndarray
            Their indices, the steadiest first.
        """
        return self.shape.steadiest(marker, self.options.anchors, among=among)

    def scale(self, marker: int, anchors: np.ndarray) -> np.ndarray:
        """Give the standard deviations of distances.

        Parameters
        ----------
        marker : int
            Index of the marker.
        anchors : np.ndarray
            Indices of the anchors.

        Returns
        -------
        np.ndarray
            Robust standard deviations, at least `min_deviation_mm` (anchors,).
        """
        deviation: np.ndarray = np.maximum(self.shape.deviation[marker, anchors], self.options.min_deviation_mm)
        return deviation

    def deviations(self, marker: int, anchors: np.ndarray, *, points: np.ndarray | None = None) -> np.ndarray:
        """Compute by how much the distances of points to anchors differ from those of a marker.

        Parameters
        ----------
        marker : int
            Index of the marker that the points may be.
        anchors : np.ndarray
            Indices of the anchors.
        points : np.ndarray | None
            The points (frames, 3), mm, NaN = missing; by default those recorded under the label of the marker.

        Returns
        -------
        np.ndarray
            Distance less the usual one (frames, anchors), mm; NaN where a point or an anchor is missing.
        """
        own = self.positions[:, marker] if points is None else points
        deviation: np.ndarray = distances(own, self.positions[:, anchors]) - self.shape.distance[marker, anchors]
        return deviation

    def log_likelihood(self, marker: int, anchors: np.ndarray, *, points: np.ndarray | None = None) -> np.ndarray:
        """Compute the likelihood of the distances of points if they are those of a marker.

        Parameters
        ----------
        marker : int
            Index of the marker that the points may be.
        anchors : np.ndarray
            Indices of the anchors; explanations are compared over the same points with equally many anchors.
        points : np.ndarray | None
            The points (frames, 3), mm, NaN = missing; by default those recorded under the label of the marker.

        Returns
        -------
        np.ndarray
            Mean over the anchors of the log density (1/mm) of Student's t distribution (frames,); NaN where fewer than
            `min_anchors` distances are known. The mean, since distances to the markers of one segment vary together.
        """
        deviation, scale = self.deviations(marker, anchors, points=points), self.scale(marker, anchors)
        return self._mean(self._log_density(deviation, scale))

    def own_log_likelihoods(self, markers: np.ndarray) -> np.ndarray:
        """Compute the likelihood of points if they are those of the markers under whose labels they are recorded.

        Parameters
        ----------
        markers : np.ndarray
            Indices of the markers (n,).

        Returns
        -------
        np.ndarray
            Log likelihoods (frames, n), see `log_likelihood`; NaN where they are unknown.
        """
        own = [self.log_likelihood(m, self.anchors(m)) for m in markers.tolist()]
        return np.stack(own, axis=1) if own else np.empty((len(self.positions), 0))

    def label_log_likelihoods(self) -> np.ndarray:
        """Compute the likelihood of every point if it is that of any marker.

        Returns
        -------
        np.ndarray
            Log likelihoods (frames, labels, markers) of the point that is recorded under a label, if it is that of a marker,
            see `log_likelihood`; the distance from what is recorded under its own label is left out. NaN where unknown.
        """
        tracks, count = self.positions, self.positions.shape[1]
        distance = np.stack([np.sqrt(np.square(tracks - tracks[:, m, None]).sum(axis=2)) for m in range(count)], axis=1)
        likelihood = np.full(distance.shape, np.nan)
        for marker in range(count):
            anchors = self.anchors(marker)
            if len(anchors) >= self.options.min_anchors:
                deviation = distance[:, :, anchors] - self.shape.distance[marker, anchors]
                deviation[:, anchors, np.arange(len(anchors))] = np.nan
                likelihood[:, :, marker] = self._mean(self._log_density(deviation, self.scale(marker, anchors)))
        return likelihood

    def own_log_likelihoods_without_other(self) -> np.ndarray:
        """Compute the likelihood of every point if it is that of its own label, leaving out one other marker at a time.

        Returns
        -------
        np.ndarray
            Log likelihoods (frames, markers, others), see `log_likelihood`, without the distance to each other marker: where two are
            exchanged, the distance between them stays the same. NaN where unknown.
        """
        count = self.positions.shape[1]
        likelihood = np.full((len(self.positions), count, count), np.nan)
        for marker in range(count):
            anchors = self.anchors(marker)
            density = self._log_density(self.deviations(marker, anchors), self.scale(marker, anchors))
            likelihood[:, marker] = self._mean(density)[:, None]
            known = ~np.isnan(density)
            left = known.sum(axis=1)[:, None] - known
            total = np.where(known, density, 0.0)
            rest = (total.sum(axis=1)[:, None] - total) / np.maximum(left, 1)
            likelihood[:, marker, anchors] = np.where(left >= self.options.min_anchors, rest, np.nan)
        return likelihood

    def mean_misfits(self, marker: int, label: int, anchors: np.ndarray, labels: np.ndarray) -> np.ndarray:
        """Compute how badly the distances fit if a marker and its anchors are recorded under other labels.

        Parameters
        ----------
        marker, label : int
            Indices of the marker, and of the label under which it is recorded.
        anchors, labels : np.ndarray
            Indices of its anchors, and of the labels under which they are recorded (anchors,).

        Returns
        -------
        np.ndarray
            Log density of the usual distance less that of what is measured, per anchor (anchors,), mean over the frames and
            divided by the number of anchors; frames in which a distance is unknown count as none.
        """
        distance = distances(self.positions[:, label], self.positions[:, labels])
        deviation = distance - self.shape.distance[marker, anchors]
        scale = self.scale(marker, anchors)
        misfit = self._log_density(np.zeros(len(anchors)), scale) - self._log_density(deviation, scale)
        mean: np.ndarray = np.nan_to_num(misfit).mean(axis=0) / len(anchors) if len(misfit) else np.zeros(len(anchors))
        return mean

    def _log_density(self, deviation: np.ndarray, scale: np.ndarray) -> np.ndarray:
        """Log density (1/mm) of Student's t distribution at deviations (..., anchors) of distances, mm."""
        freedom = self.options.degrees_of_freedom
        constant = lgamma((freedom + 1) / 2) - lgamma(freedom / 2) - np.log(freedom * np.pi) / 2
        density: np.ndarray = (
            constant - np.log(scale) - (freedom + 1) / 2 * np.log1p((deviation / scale) ** 2 / freedom)
        )
        return density

    def _mean(self, density: np.ndarray) -> np.ndarray:
        """Mean over the last axis of what is known; NaN where that is from too few anchors."""
        known = ~np.isnan(density)
        count = known.sum(axis=-1)
        mean = np.where(known, density, 0.0).sum(axis=-1) / np.maximum(count, 1)
        likelihood: np.ndarray = np.where(count >= self.options.min_anchors, mean, np.nan)
        return likelihood

    def contradicting_share(self, marker: int, anchors: np.ndarray, *, points: np.ndarray | None = None) -> np.ndarray:
        """Compute which share of the distances of points contradicts that they are those of a marker.

        Parameters
        ----------
        marker : int
            Index of the marker that the points may be.
        anchors : np.ndarray
            Indices of the anchors.
        points : np.ndarray | None
            The points (frames, 3), mm, NaN = missing; by default those recorded under the label of the marker.

        Returns
        -------
        np.ndarray
            Shares (frames,), 0 to 1; NaN where fewer than `min_anchors` distances are known.
        """
        deviation = self.deviations(marker, anchors, points=points)
        limit = self.options.threshold_sigmas * self.scale(marker, anchors) + self.options.floor_mm
        known = np.count_nonzero(~np.isnan(deviation), axis=1)
        off = np.count_nonzero(np.abs(deviation) > limit, axis=1)
        share: np.ndarray = np.where(known >= self.options.min_anchors, off / np.maximum(known, 1), np.nan)
        return share

    def contradiction(self) -> np.ndarray:
        """Mark the samples that contradict the shape.

        Returns
        -------
        np.ndarray
            Bool (frames, markers): at least `min_contradicting_share` of the distances to the steadiest markers are off.
        """
        shares = [self.contradicting_share(m, self.anchors(m)) for m in range(self.positions.shape[1])]
        contradicting: np.ndarray = np.nan_to_num(np.stack(shares, axis=1)) >= max(
            self.options.min_contradicting_share, np.finfo(float).tiny
        )
        return contradicting
