"""Attribution of events to markers: an artifact of one marker is in the residuals of its neighbours too.

Candidate events are hidden from the predictions of the other markers before the residuals are searched. Where events of
neighbours overlap nevertheless, the one of the highest score is accepted (non-maximum suppression), and the other markers
are searched again without its samples.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Generic, Protocol, TypeVar

import numpy as np

from markermend.core.events import Event
from markermend.detection.neighbour.hidden_samples import event_mask, hide_candidates, residuals_without
from markermend.detection.neighbour.neighbourhood import Neighbourhood, overlap
from markermend.prediction.interface import ResidualSource
from markermend.prediction.scene import Scene

Statistics = TypeVar("Statistics")


class Detector(Protocol[Statistics]):
    """A detector of one class of artifacts in the residuals of all markers."""

    @property
    def scene(self) -> Scene:
        """What is observed, without what earlier detectors claimed."""
        ...

    @property
    def markers(self) -> Sequence[str]:
        """Names of the markers."""
        ...

    @property
    def border(self) -> int:
        """Samples on either side of an event over which it disturbs the residuals of neighbours."""
        ...

    def measure(self, residual: np.ndarray) -> Statistics:
        """Compute the statistics of residuals in which events are found.

        Parameters
        ----------
        residual : np.ndarray
            Residuals (frames, markers, 3), mm, NaN = missing.

        Returns
        -------
        Statistics
            Statistics of the residuals.
        """
        ...

    def update(self, statistics: Statistics, residual: np.ndarray, markers: Sequence[int]) -> Statistics:
        """Compute the statistics of some markers anew; what belongs to the whole recording stays.

        Parameters
        ----------
        statistics : Statistics
            Statistics of the residuals.
        residual : np.ndarray
            The new residuals (frames, markers, 3), mm, NaN = missing.
        markers : Sequence[int]
            Indices of the markers whose residuals are new.

        Returns
        -------
        Statistics
            Statistics of the residuals.
        """
        ...

    def find_events(self, statistics: Statistics, marker: int) -> list[Event]:
        """Find the events of one marker.

        Parameters
        ----------
        statistics : Statistics
            Statistics of the residuals.
        marker : int
            Index of the marker.

        Returns
        -------
        list[Event]
            The events.
        """
        ...

    def find_candidates(self, statistics: Statistics, marker: int) -> list[Event]:
        """Find where one marker may have an event.

        Parameters
        ----------
        statistics : Statistics
            Those of the trajectories in place of the residuals.
        marker : int
            Index of the marker.

        Returns
        -------
        list[Event]
            The candidate events.
        """
        ...

    def unexplained(self, statistics: Statistics, marker: int) -> Sequence[int]:
        """Find frames of one marker at which something begins or ends that belongs to no event.

        Parameters
        ----------
        statistics : Statistics
            Statistics of the residuals.
        marker : int
            Index of the marker.

        Returns
        -------
        Sequence[int]
            The frames.
        """
        ...


def attribute(
    detector: Detector[Statistics], *, predictor: ResidualSource, rounds: int, neighbours: int
) -> tuple[list[Event], Statistics]:
    """Find the events of all markers, each on the marker to which it belongs.

    Parameters
    ----------
    detector : Detector
        Finds the events of one marker.
    predictor : ResidualSource
        Predicts each marker from the others.
    rounds : int
        Largest number of rounds in which markers are searched again without the samples of events that were accepted.
    neighbours : int
        Number of nearest neighbours that may share an artifact.

    Returns
    -------
    found : list[Event]
        The events, by marker.
    statistics : Statistics
        The statistics by which they were found.
    """
    around = Neighbourhood.of(detector.scene, detector.markers, neighbours)
    contested = around.contested(_candidates(detector), len(detector.scene.positions))
    hidden, residual = hide_candidates(
        predictor, detector.scene, contested, markers=detector.markers, border=detector.border
    )
    attribution = _Attribution(detector, predictor, around, hidden, residual)
    for _ in range(rounds):
        if not attribution.advance():
            break
    return attribution.events, attribution.statistics


def _candidates(detector: Detector[Statistics]) -> list[Event]:
    """Where the trajectories themselves have events, by marker."""
    trajectories = detector.measure(detector.scene.positions)
    return [event for m in range(len(detector.markers)) for event in detector.find_candidates(trajectories, m)]


@dataclass
class _Attribution(Generic[Statistics]):
    """The state of an attribution: which samples are hidden, the residuals without them, and the events found in these."""

    detector: Detector[Statistics]
    predictor: ResidualSource
    around: Neighbourhood
    hidden: np.ndarray
    residual: np.ndarray
    rejudged: set[int] = field(default_factory=set)

    def __post_init__(self) -> None:
        self.statistics = self.detector.measure(self.residual)
        self.found = {m: self.detector.find_events(self.statistics, m) for m in range(len(self.detector.markers))}
        # A candidate that was hidden while its neighbours were searched competes with none of them.
        self.accepted = {
            event for m, own in self.found.items() for event in own if self.hidden[event.start : event.stop, m].all()
        }

    @property
    def events(self) -> list[Event]:
        """What is found, by marker."""
        return [event for own in self.found.values() for event in own]

    def advance(self) -> bool:
        """Accept the strongest of the events that compete, and search the other markers again; False where there are none."""
        competing = set(self.events) - self.accepted
        strongest = self.around.strongest(competing)
        again = self._markers_to_search(competing - strongest, strongest)
        self.accepted |= strongest
        self.rejudged.update(again)
        if again:
            self._search_again(again, strongest)
        return bool(again)

    def _markers_to_search(self, weaker: set[Event], strongest: set[Event]) -> list[int]:
        """The markers of weaker events, and those with something unexplained where one of the strongest begins or ends."""
        borders = self.around.borders(strongest)
        for m, frames in borders.items():
            if frames.intersection(self.detector.unexplained(self.statistics, m)):
                self.rejudged.add(m)
        return sorted({self.around.index(event) for event in weaker} | (self.rejudged & borders.keys()))

    def _search_again(self, again: list[int], strongest: set[Event]) -> None:
        """Judge markers without the samples of the strongest events of their neighbours; accepted events stay."""
        scene, markers = self.detector.scene, self.detector.markers
        self.hidden |= event_mask(strongest, len(scene.positions), markers, border=self.detector.border)
        self.residual = self.residual.copy()
        self.residual[:, again] = residuals_without(self.predictor, scene, self.hidden, again)
        self.statistics = self.detector.update(self.statistics, self.residual, again)
        for m in again:
            kept = [event for event in self.found[m] if event in self.accepted]
            renewed = self.detector.find_events(self.statistics, m)
            self.found[m] = kept + [event for event in renewed if not any(overlap(event, own) for own in kept)]
