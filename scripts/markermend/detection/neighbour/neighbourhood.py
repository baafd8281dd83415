"""Neighbourhoods: whose residuals may share an artifact, and which of the events that overlap in one is the strongest."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.core.events import Event
from markermend.detection.neighbour.hidden_samples import event_mask
from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class Neighbourhood:
    """Which markers may have an artifact in common, as it shows in their residuals.

    Attributes
    ----------
    markers : Sequence[str]
        Names of the markers.
    neighbours : Sequence[set[int]]
        For each marker those among whose nearest it is, or that are among its own nearest.
    """

    markers: Sequence[str]
    neighbours: Sequence[set[int]]

    @classmethod
    def of(cls, scene: Scene, markers: Sequence[str], count: int) -> Neighbourhood:
        """Take the nearest neighbours of each marker.

        Parameters
        ----------
        scene : Scene
            What is observed.
        markers : Sequence[str]
            Names of the markers.
        count : int
            How many neighbours are its nearest.

        Returns
        -------
        Neighbourhood
            The relation is symmetric.
        """
        near = [set(np.asarray(own, int)[:count].tolist()) for own in scene.neighbours]
        return cls(markers, [own | {n for n, others in enumerate(near) if m in others} for m, own in enumerate(near)])

    def index(self, event: Event) -> int:
        """Give the index of an event's marker.

        Parameters
        ----------
        event : Event
            The event.

        Returns
        -------
        int
            Its place among the markers.
        """
        return self.markers.index(event.marker)

    def contested(self, found: Sequence[Event], frames: int) -> list[Event]:
        """Select the events that an event of a neighbour overlaps.

        Parameters
        ----------
        found : Sequence[Event]
            The events.
        frames : int
            Length of the recording.

        Returns
        -------
        list[Event]
            Those of them, in order.
        """
        covered = event_mask(found, frames, self.markers)
        return [
            event
            for event in found
            if covered[event.start : event.stop, list(self.neighbours[self.index(event)])].any()
        ]

    def strongest(self, found: set[Event]) -> set[Event]:
        """Select the strongest events: non-maximum suppression among neighbours.

        Parameters
        ----------
        found : set[Event]
            The events.

        Returns
        -------
        set[Event]
            Those that no stronger one of a neighbour overlaps which is itself selected.
        """
        kept: set[Event] = set()
        for event in sorted(found, key=lambda event: (-event.score, event.order)):
            around = self.neighbours[self.index(event)]
            if not any(overlap(event, other) and self.index(other) in around for other in kept):
                kept.add(event)
        return kept

    def borders(self, found: set[Event]) -> dict[int, set[int]]:
        """List for each marker the frames at which events of its neighbours begin or end.

        Parameters
        ----------
        found : set[Event]
            The events.

        Returns
        -------
        dict[int, set[int]]
            Frames by the index of the marker; only markers with such a neighbour.
        """
        borders: dict[int, set[int]] = {}
        for event in found:
            for m in self.neighbours[self.index(event)]:
                borders.setdefault(m, set()).update((event.start, event.stop))
        return borders


def overlap(one: Event, other: Event) -> bool:
    """Check whether two events share a frame.

    Parameters
    ----------
    one, other : Event
        The events, of any markers.

    Returns
    -------
    bool
        Whether they do.
    """
    return one.start < other.stop and other.start < one.stop
