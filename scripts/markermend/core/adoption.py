"""Adopted samples: those of a marker that the file holds under an unlabelled trajectory while the marker is missing.

A finding of them is an event with a `source`. Findings of the class `adopted` are carried out here, for the detectors that come
after and for the repair; those of the class `unlabelled` are only reported. The trajectory itself keeps its samples in the file.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from markermend.core.events import Event, mask
from markermend.numerics.intervals import runs

FOREIGN = "foreign"
"""The class of samples that are not on the marker, in whose place others may be adopted."""

ADOPTABLE = ("unlabelled", "adopted")
"""The classes of samples under unlabelled trajectories: reported, and adopted without asking anybody."""


def is_adopted(event: Event) -> bool:
    """Check whether a finding is of samples that are adopted without asking anybody.

    Parameters
    ----------
    event : Event
        The finding.

    Returns
    -------
    bool
        Whether it is.
    """
    return event.kind == "adopted" and event.source is not None


def adopt(
    positions: np.ndarray, adopted: Iterable[Event], tracks: Mapping[str, np.ndarray], markers: Sequence[str]
) -> np.ndarray:
    """Give markers their samples that are recorded under unlabelled trajectories.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        Trajectories of the markers, mm; NaN = missing. Not modified.
    adopted : iterable of Event
        The findings, under the labels of these trajectories.
    tracks : mapping of str to ndarray of float, shape (frames, 3)
        The unlabelled trajectories by name, mm; NaN = missing.
    markers : sequence of str
        Names of the markers of the second axis.

    Returns
    -------
    ndarray of float, shape (frames, markers, 3)
        A copy that differs in the findings alone, whose samples are those of the trajectories bit for bit; the positions themselves
        where there are no findings.
    """
    findings = list(adopted)
    given = positions.copy() if findings else positions
    for event in findings:
        span = slice(event.start, event.stop)
        given[span, markers.index(event.marker)] = tracks[str(event.source)][span]
    return given


def without_adopted(events: Iterable[Event], adopted: Sequence[Event]) -> list[Event]:
    """Take the frames in which samples are adopted out of the findings that a label is on something else.

    Parameters
    ----------
    events : iterable of Event
        Findings of any class.
    adopted : sequence of Event
        Findings of adopted samples.

    Returns
    -------
    list of Event
        The findings in their order, without the adopted ones; those of the class `foreign` are split or left out.
    """
    remaining: list[Event] = []
    for event in (event for event in events if event not in adopted):
        own = [other for other in adopted if other.marker == event.marker]
        if event.kind != FOREIGN or not own:
            remaining.append(event)
            continue
        free = ~mask(own, max(event.stop, *(other.stop for other in own)), [event.marker])[event.start : event.stop, 0]
        remaining += [replace(event, start=event.start + start, stop=event.start + stop) for start, stop in runs(free)]
    return remaining
