"""Attribution of drifts: whether one belongs to the marker in whose residual it is, or to one of its neighbours."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from markermend.core.events import Event
from markermend.detection.neighbour import drift_shape
from markermend.detection.neighbour.drift_scores import DriftScorer, DriftScores
from markermend.numerics import intervals, robust
from markermend.options.detection import SlowOptions
from markermend.prediction.interface import ScaledResidualSource
from markermend.prediction.scene import Scene

RIGID_MM = 0.1
"""Deviation of distances that every segment is granted, mm: rounded positions of a rigid body have as much."""

BRIEF_SHARE = 8
"""A time is brief next to a drift if it is at most one part in this many of it."""


@dataclass(frozen=True, eq=False)
class DriftAttribution:
    """Decides whether drifts are the marker's own.

    Attributes
    ----------
    scene : Scene
        What is observed, without what earlier detectors claimed.
    scores : DriftScores
        The scores of drifts in it.
    scorer : DriftScorer
        By which they were scored.
    predictor : ScaledResidualSource
        Source of their residuals.
    """

    scene: Scene
    scores: DriftScores
    scorer: DriftScorer
    predictor: ScaledResidualSource

    @property
    def options(self) -> SlowOptions:
        """The options."""
        return self.scorer.options

    def is_own(self, marker: int, event: Event) -> bool:
        """Check whether a drift is the marker's own.

        It must remain without all neighbours that are observed intermittently. Of each neighbour that deviates as well
        and may have dragged the marker along: the drift remains without it; or, as on a rigid segment where the residual
        of neither can be computed without the other, the marker's distances to the others change more than that
        neighbour's.

        Parameters
        ----------
        marker : int
            Index of the marker.
        event : Event
            The drift.

        Returns
        -------
        bool
            Whether it is.
        """
        intermittent = self.intermittent_neighbours(marker, event)
        deviating = np.setdiff1d(self.deviating_neighbours(marker, event), intermittent)
        if len(intermittent) and not self.remains_without(intermittent, marker, event):
            return False
        return all(
            self.remains_without(np.append(intermittent, neighbour), marker, event)
            or self.distances_change_more(marker, neighbour, event)
            for neighbour in deviating.tolist()
        )

    def nearest(self, marker: int) -> np.ndarray:
        """List the neighbours to which a drift of a marker may be attributed.

        Parameters
        ----------
        marker : int
            Index of the marker.

        Returns
        -------
        np.ndarray
            Their indices, the nearest first.
        """
        return np.asarray(self.scene.neighbours[marker], int)[: self.options.attribution_neighbours]

    def intermittent_neighbours(self, marker: int, event: Event) -> np.ndarray:
        """List the neighbours that are observed for a part of the time from before a drift to after it.

        A prediction from other neighbours deviates by other amounts, so that the residual changes where they come and go.
        Brief absences and brief presences do not count: they make no drift.

        Parameters
        ----------
        marker : int
            Index of the marker.
        event : Event
            The drift.

        Returns
        -------
        np.ndarray
            Their indices.
        """
        near, brief = self.nearest(marker), intervals.samples(self.options.bridged_gap_s, self.scene.rate)
        brief = min(brief, (event.stop - event.start) // BRIEF_SHARE)
        seen = self._observed(event, near)
        count = np.count_nonzero(seen, axis=0)
        changing: np.ndarray = near[(count < len(seen) - brief) & (count > brief)]
        return changing

    def deviating_neighbours(self, marker: int, event: Event) -> np.ndarray:
        """List the neighbours whose residuals deviate as well during a drift.

        Parameters
        ----------
        marker : int
            Index of the marker.
        event : Event
            The drift.

        Returns
        -------
        np.ndarray
            Their indices.
        """
        near, flank = self.nearest(marker), self.options.flank_fraction
        own, *heights = (
            drift_shape.height(self.scores.residual[:, m], event.start, event.stop, flank=flank)
            for m in (marker, *near)
        )
        high = np.nan_to_num(heights) > self.options.suspect_fraction * own
        deviating: np.ndarray = near[
            high | (self.scores.score[event.start : event.stop, near].max(axis=0, initial=0.0) > 1)
        ]
        return deviating

    def remains_without(self, hidden: np.ndarray, marker: int, event: Event) -> bool:
        """Check whether a drift of a marker remains when some neighbours are hidden.

        Parameters
        ----------
        hidden : np.ndarray
            Indices of the neighbours.
        marker : int
            Index of the marker.
        event : Event
            The drift.

        Returns
        -------
        bool
            Whether it does.
        """
        positions = self.scene.positions.copy()
        positions[:, hidden] = np.nan  # throughout: a looser prediction needs its own scale
        rest = replace(self.scene, positions=positions)
        residual, factors = self.predictor.scaled_residuals(
            rest, np.array([marker]), blocks=self.options.leverage_blocks
        )
        score = self.scorer.rescore(self.scores, residual[:, marker], factors[:, marker], marker=marker)
        required = self.scorer.required_score(score, event.start, event.stop)
        return bool(score[event.start : event.stop].max() > self.options.remaining_fraction * required)

    def distances_change_more(self, one: int, other: int, event: Event) -> bool:
        """Check whether a marker's distances to the neighbours of two change clearly more during a drift than the other's.

        Parameters
        ----------
        one, other : int
            Indices of the markers. The distance between the two does not count.
        event : Event
            The drift.

        Returns
        -------
        bool
            Whether they do.
        """
        around = np.setdiff1d(np.union1d(self.nearest(one), self.nearest(other)), [one, other])
        around = around[self._observed(event, around).all(axis=0)]
        own, others = self.distance_change(one, around, event), self.distance_change(other, around, event)
        return self.options.suspect_fraction * own > others

    def distance_change(self, marker: int, around: np.ndarray, event: Event) -> float:
        """Measure how much the distances of a marker to others change during a drift.

        Parameters
        ----------
        marker : int
            Index of the marker.
        around : np.ndarray
            Indices of the others.
        event : Event
            The drift.

        Returns
        -------
        float
            Root of the summed squares, each change in units of that distance's own deviation: a rigid segment decides.
        """
        positions = self.scene.positions
        distance = np.linalg.norm(positions[:, around] - positions[:, [marker]], axis=2)
        deviation = np.array([robust.mad_std(own) for own in distance.T]) + RIGID_MM
        change = drift_shape.displacement(distance, event.start, event.stop, flank=self.options.flank_fraction)
        return float(np.linalg.norm(change / deviation))

    def _observed(self, event: Event, markers: np.ndarray) -> np.ndarray:
        """Whether markers are observed, bool (frames, markers), from before a drift to after it."""
        margin = int(self.options.flank_fraction * (event.stop - event.start))
        return self.scene.present[max(event.start - margin, 0) : event.stop + margin, markers]
