"""Attribution of drifts: whether one belongs to the marker in whose residual it is, or to one of its neighbours."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from markermend.core.events import Event
from markermend.detection.neighbour.drifts import shape as drift_shape
from markermend.detection.neighbour.drifts.evidence import DriftEvidence
from markermend.numerics import intervals, robust
from markermend.options.detection.slow import SlowOptions
from markermend.prediction.scene import Scene

RIGID_MM = 0.1
"""Deviation of distances that every segment is granted, mm: rounded positions of a rigid body have as much."""

MIN_DEVIATION_MM = 0.02
"""Smallest deviation of a distance, mm: positions are stored no more precisely."""

BRIEF_SHARE = 8
"""A time is brief next to a drift if it is at most one part in this many of it."""


@dataclass(frozen=True, eq=False)
class DriftAttribution:
    """Decides whether drifts are the marker's own.

    Attributes
    ----------
    scene : Scene
        What is observed, without what earlier detectors claimed.
    evidence : DriftEvidence
        How drifts stand out in it.
    options : SlowOptions
        Neighbours that are looked at, and how much must remain without them.
    """

    scene: Scene
    evidence: DriftEvidence
    options: SlowOptions

    def is_own(self, marker: int, event: Event) -> bool:
        """Check whether a drift is the marker's own.

        The distances to its neighbours must show it. It must remain without all neighbours that are observed intermittently.
        Of each neighbour that deviates as well and may have dragged the marker along: the drift remains without it; or, as on
        a rigid segment where the residual of neither can be computed without the other, the marker's distances to the others
        change more than that neighbour's.

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
        if not self.shows_in_distances(marker, event):
            return False
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
        near = self.nearest(marker)
        own, *heights = (float(np.linalg.norm(self.evidence.displacement(m, event))) for m in (marker, *near))
        high = np.nan_to_num(heights) > self.options.suspect_fraction * own
        deviating: np.ndarray = near[high | [self.evidence.stands_out(m, event) for m in near]]
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
        return self.evidence.remaining_score(rest, marker, event) > self.options.remaining_fraction

    def shows_in_distances(self, marker: int, event: Event) -> bool:
        """Check whether the distances of a marker change as a drift would change them, beyond their usual range.

        A marker that keeps its distances to rigid segment mates cannot have drifted alone: where it has such mates, they decide.
        Elsewhere a drift that is estimated precisely may leave the distances in their usual range, unless those that would show it
        do not change. Any other drift must show in them. The part of a drift that they show is estimated by least squares, each
        weighed by how steady it usually is: from those that would show the drift by themselves, if there are any. Where even
        the steadiest varies much, the pose may be rare: more is required of a drift that templates find, and one that is
        estimated together with the regression cannot be distinguished from the pose.

        Parameters
        ----------
        marker : int
            Index of the marker.
        event : Event
            The drift.

        Returns
        -------
        bool
            Whether they show enough of it.
        """
        displaced, options = self.evidence.displacement(marker, event), self.options
        if np.isnan(displaced).any():
            return False
        expected, change, deviation = self._distance_changes(marker, event, displaced)
        rigid = deviation <= options.rigid_distance_fraction * np.linalg.norm(displaced)
        if rigid.any():
            return self._shown(expected[rigid], change[rigid])
        if self.evidence.is_precise(marker, event):
            decisive = np.abs(expected) >= options.estimated_drifts.contradicting_distance_sigmas
            return not decisive.any() or self._shown(expected[decisive], change[decisive])
        least = float(deviation.min(initial=np.inf))
        if least > self.evidence.max_distance_deviation_mm:
            return False
        required = options.min_distance_sigmas * (options.high_scale_factor if least > options.high_scale_mm else 1)
        steady = np.abs(expected) >= required
        some = steady if steady.any() else np.ones(len(expected), bool)
        clear = float(expected[some] @ expected[some]) >= required**2
        return clear and self._shown(expected[some], change[some])

    def _shown(self, expected: np.ndarray, change: np.ndarray) -> bool:
        """Whether distances change by enough of what they would be expected to, by least squares."""
        return float(change @ expected) >= self.options.min_distance_fraction * float(expected @ expected)

    def _distance_changes(
        self, marker: int, event: Event, displaced: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Changes (k,) of distances that a displacement would make, and those observed, in deviations; the deviations, mm."""
        near = self.nearest(marker)
        near = near[self._observed(event, near).all(axis=0)]
        apart = self.scene.positions[:, [marker]] - self.scene.positions[:, near]
        distance = np.linalg.norm(apart, axis=2)
        third = (event.stop - event.start) // 3
        middle = slice(event.start + third, event.stop - third)
        margin = int(np.ceil(self.options.flank_fraction * (event.stop - event.start)))
        around = np.r_[max(event.start - margin, 0) : event.start, event.stop : min(event.stop + margin, len(distance))]
        before = np.linalg.norm(apart[middle] - displaced, axis=2)
        deviation = np.hypot(self._deviations(marker, near, distance), MIN_DEVIATION_MM)
        expected = np.nanmedian(distance[middle] - before, axis=0)
        change = np.nanmedian(distance[middle], axis=0) - np.nanmedian(distance[around], axis=0)
        return expected / deviation, change / deviation, deviation

    def _deviations(self, marker: int, others: np.ndarray, distance: np.ndarray) -> np.ndarray:
        """Usual standard deviations of a marker's distances to others (k,), mm, given these distances (frames, k)."""
        if self.scene.shape is not None:
            usual: np.ndarray = self.scene.shape.spread[marker, others]
            return np.where(np.isnan(usual), np.inf, usual)
        low, high = np.nanpercentile(distance, [5, 95], axis=0)
        spread: np.ndarray = (high - low) / 3.29
        return spread

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
