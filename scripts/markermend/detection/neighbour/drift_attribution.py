"""What the neighbours of a marker tell about a slow change: do they agree, whoever is seen, and is it one of them?"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from markermend.core.events import Event
from markermend.detection.neighbour import drift_shape
from markermend.detection.neighbour.drift_candidates import Matches, bar
from markermend.numerics import intervals, robust
from markermend.options.detection import SlowOptions
from markermend.prediction.scene import ScaledResidualSource, Scene

RIGID_MM = 0.1
"""Deviation of distances that is taken for granted: rounded positions of a rigid body have that much."""


BRIEF = 8
"""A part in so many of an event is brief next to it."""


@dataclass(frozen=True, eq=False)
class Company:
    """The nearest neighbours of each marker, and what is known of them.

    scene: nothing that earlier detectors claimed. matches: how clearly bumps stand out in it. predictor: as for the matches.
    """

    scene: Scene
    matches: Matches
    options: SlowOptions
    predictor: ScaledResidualSource

    def near(self, marker: int) -> np.ndarray:
        """The neighbours that are asked about a marker, the nearest first."""
        return np.asarray(self.scene.neighbours[marker], int)[: self.options.attribution_neighbours]

    def seen(self, event: Event, markers: np.ndarray) -> np.ndarray:
        """Whether markers are seen (frames, markers), from before an event to after it."""
        margin = int(self.options.flank_fraction * (event.stop - event.start))
        return self.scene.present[max(event.start - margin, 0) : event.stop + margin, markers]

    def transient(self, marker: int, event: Event) -> np.ndarray:
        """The neighbours that are seen for a part of the time only, from before an event of a marker to after it.

        A prediction from other neighbours is off by other amounts: where they come and go, the level says nothing. What
        is brief, next to the event too, does not count: it makes no slow change.
        """
        near, brief = self.near(marker), intervals.samples(self.options.bridged_gap_s, self.scene.rate)
        brief = min(brief, (event.stop - event.start) // BRIEF)
        seen = self.seen(event, near)
        count = np.count_nonzero(seen, axis=0)
        return near[(count < len(seen) - brief) & (count > brief)]

    def upholds(self, marker: int, event: Event) -> bool:
        """Whether an event is the marker's own: neither made by neighbours that come and go, nor by one that is off as well.

        The marker must still be off without all of the first. Of each of the second, which may have dragged it along:
        the marker is still off without it; or, as on a rigid segment, where nothing tells without either, the marker's
        distances to the others are disturbed more than that neighbour's.
        """
        transient, suspects = self.transient(marker, event), self.suspects(marker, event)
        if len(transient) and not self.off_without(transient, marker, event):
            return False
        return all(
            self.off_without(np.append(transient, suspect), marker, event)
            or self.more_disturbed(marker, suspect, event)
            for suspect in np.setdiff1d(suspects, transient).tolist()
        )

    def suspects(self, marker: int, event: Event) -> np.ndarray:
        """The neighbours that are off as well during an event of a marker."""
        near, flank = self.near(marker), self.options.flank_fraction
        own, *heights = (
            drift_shape.height(self.matches.residual[:, m], event.start, event.stop, flank=flank)
            for m in (marker, *near)
        )
        off = np.nan_to_num(heights) > self.options.suspect_fraction * own
        return near[off | (self.matches.score[event.start : event.stop, near].max(axis=0, initial=0.0) > 1)]

    def off_without(self, hidden: np.ndarray, marker: int, event: Event) -> bool:
        """Whether a bump stands out on a marker during an event though some neighbours are hidden."""
        positions = self.scene.positions.copy()
        positions[:, hidden] = np.nan  # throughout: a looser prediction needs its own scale
        rest = replace(self.scene, positions=positions)
        residual, wider = self.predictor.scaled_residuals(rest, np.array([marker]), blocks=self.options.leverage_blocks)
        score = self.matches.judge_anew(
            residual[:, marker], wider[:, marker], marker=marker, rate=rest.rate, options=self.options
        )
        needed = bar(score, event.start, event.stop, rate=rest.rate, options=self.options)
        return bool(score[event.start : event.stop].max() > self.options.remaining_fraction * needed)

    def more_disturbed(self, one: int, other: int, event: Event) -> bool:
        """Whether a marker's distances to the neighbours of two rise or fall clearly more during an event than the other's do.

        Each counts in units of its own usual deviation, so that a rigid segment decides. That between the two tells
        nothing.
        """
        company = np.setdiff1d(np.union1d(self.near(one), self.near(other)), [one, other])
        company = company[self.seen(event, company).all(axis=0)]
        return self.options.suspect_fraction * self.disturbance(one, company, event) > self.disturbance(
            other, company, event
        )

    def disturbance(self, marker: int, company: np.ndarray, event: Event) -> float:
        """How much the distances of a marker to others change during an event: root of the sum of squares, in usual deviations."""
        positions = self.scene.positions
        distance = np.linalg.norm(positions[:, company] - positions[:, [marker]], axis=2)
        usual = np.array([robust.mad_std(own) for own in distance.T]) + RIGID_MM
        change = drift_shape.risen(distance, event.start, event.stop, flank=self.options.flank_fraction)
        return float(np.linalg.norm(change / usual))
