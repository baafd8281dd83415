"""Findings of the detectors: half-open intervals of one marker with a score, and the masks derived from them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend.numerics.intervals import runs

REFERENCES = ("usual distances", "longer part", "undecided")
"""What decides which of two levels of a marker counts as right: the subject's usual distances over several recordings, else
where the marker is for longer, else nothing, and the earlier counts as right."""


FRAMES_APART = {"repeat": 5}
"""Frames between parts of one finding about several markers, at most, by its kind: every second or third frame may repeat."""


@dataclass(frozen=True)
class Event:
    """One finding on one marker over [start, stop).

    Attributes
    ----------
    marker : str
        Name of the marker.
    start, stop : int
        First frame, and the frame after the last, as rows counted from 0.
    score : float
        The evidence in units of the detector's threshold, at least 1.
    axes : str
        The axes on which the detector fired, such as "xz".
    partner : str, optional
        The marker under whose label the samples are recorded, where labels are exchanged.
    kind : str, optional
        Name of its class, where its detector finds several; None for the first of them.
    group : str, optional
        What a finding about several markers is about as a whole, such as the name of a segment. Its events, one for each
        marker, have the same kind and group, and share frames.
    amount_mm : float, optional
        How far the samples are displaced, mm, where the detector states it.
    reference : str, optional
        What decided that the other level of the marker counts as right, one of REFERENCES, where there are two levels.
    source : str, optional
        The unlabelled trajectory under which the samples of the marker are recorded.
    """

    marker: str
    start: int
    stop: int
    score: float
    axes: str = "xyz"
    partner: str | None = None
    kind: str | None = None
    group: str | None = None
    amount_mm: float | None = None
    reference: str | None = None
    source: str | None = None

    @property
    def markers(self) -> tuple[str, ...]:
        """Names of its marker and, where labels are exchanged, of the partner."""
        return (self.marker, self.partner) if self.partner else (self.marker,)

    @property
    def order(self) -> tuple[str, int, int, str, str]:
        """What events are sorted by."""
        return self.marker, self.start, self.stop, self.partner or "", self.kind or ""

    @property
    def identity(self) -> tuple[str, str | None, str | None, str | None]:
        """What events have in common that may be merged where they overlap."""
        return self.marker, self.partner, self.kind, self.group

    def joined_with(self, other: Event) -> bool:
        """Check whether another event belongs to the same finding about several markers.

        Parameters
        ----------
        other : Event
            An event of any marker.

        Returns
        -------
        bool
            Whether both state the same kind and group, and share a frame; frames that repeat may be some frames apart.
        """
        same = self.group is not None and (self.kind, self.group) == (other.kind, other.group)
        reach = FRAMES_APART.get(self.kind or "", 0)
        return same and self.start < other.stop + reach and other.start < self.stop + reach


def from_mask(mask: np.ndarray, score: np.ndarray, fired: np.ndarray, markers: Sequence[str]) -> list[Event]:
    """Turn a mask into events.

    Parameters
    ----------
    mask : ndarray of bool, shape (frames, markers)
        The samples that were found.
    score : ndarray of float, shape (frames, markers)
        The evidence in units of the threshold; NaN = none. Its maximum over the interval is the event's, at least 1.
    fired : ndarray of bool, shape (frames, markers, 3)
        The axes on which the detector fired.
    markers : sequence of str
        Names of the markers of the second axis.

    Returns
    -------
    list of Event
        One event for each stretch of the mask, sorted.
    """
    found = []
    for m, marker in enumerate(markers):
        for start, stop in runs(mask[:, m]):
            hits: list[bool] = np.any(fired[start:stop, m], axis=0).tolist()
            axes = "".join(axis for axis, hit in zip("xyz", hits, strict=True) if hit)
            best = float(max(1.0, np.nanmax(score[start:stop, m], initial=1.0)))
            found.append(Event(marker, start, stop, best, axes or "xyz"))
    return disjoint(found)


def disjoint(events: Iterable[Event]) -> list[Event]:
    """Sort events, and make those of each marker disjoint.

    Parameters
    ----------
    events : iterable of Event
        The events in any order.

    Returns
    -------
    list of Event
        Events of one marker, partner, kind and group that overlap or touch are merged; of others that overlap the first
        stands.
    """
    merged: list[Event] = []
    for event in sorted(events, key=lambda event: event.order):
        last = merged[-1] if merged else None
        if last and last.identity == event.identity and event.start <= last.stop:
            axes = "".join(axis for axis in "xyz" if axis in last.axes + event.axes)
            stop, score = max(last.stop, event.stop), max(last.score, event.score)
            merged[-1] = replace(last, stop=stop, score=score, axes=axes)
        elif last and last.marker == event.marker and event.start < last.stop:
            if event.stop > last.stop:
                merged.append(replace(event, start=last.stop))
        else:
            merged.append(event)
    return merged


def count_findings(events: Iterable[Event]) -> int:
    """Count findings: one that is about several markers counts once.

    Parameters
    ----------
    events : iterable of Event
        The events in any order.

    Returns
    -------
    int
        How many findings they make.
    """
    found = list(events)
    joint = sorted(
        (event for event in found if event.group), key=lambda event: (event.kind or "", event.group, event.start)
    )
    count = len(found) - len(joint)
    last: Event | None = None
    for event in joint:
        if last is not None and last.joined_with(event):
            last = replace(last, stop=max(last.stop, event.stop))
        else:
            count, last = count + 1, event
    return count


def mask(events: Iterable[Event], frames: int, markers: Sequence[str]) -> np.ndarray:
    """Mark the samples of events.

    Parameters
    ----------
    events : iterable of Event
        The events.
    frames : int
        Number of frames.
    markers : sequence of str
        Names of the markers of the second axis.

    Returns
    -------
    ndarray of bool, shape (frames, markers)
        True where any of the events is.

    Raises
    ------
    KeyError
        For an event on an unknown marker.
    """
    index = {marker: m for m, marker in enumerate(markers)}
    covered = np.zeros((frames, len(markers)), bool)
    for event in events:
        covered[event.start : event.stop, index[event.marker]] = True
    return covered


def coordinates(events: Iterable[Event], frames: int, markers: Sequence[str]) -> np.ndarray:
    """Mark the coordinates of events.

    Parameters
    ----------
    events : iterable of Event
        The events.
    frames : int
        Number of frames.
    markers : sequence of str
        Names of the markers of the second axis.

    Returns
    -------
    ndarray of bool, shape (frames, markers, 3)
        True where any of the events is, on the axes on which the detector fired.
    """
    found = list(events)
    own = [[event for event in found if axis in event.axes] for axis in "xyz"]
    return np.stack([mask(some, frames, markers) for some in own], axis=2)


def main_axes(vectors: np.ndarray) -> str:
    """Name the axes along which a deviation is large.

    Parameters
    ----------
    vectors : ndarray of float, shape (n, 3)
        The deviation over the frames of a finding.

    Returns
    -------
    str
        The axes whose largest component is at least half of the largest of all, such as "xz".
    """
    size = np.abs(vectors).max(axis=0)
    return "".join(axis for axis, part in zip("xyz", size, strict=True) if part >= 0.5 * size.max())


@dataclass(frozen=True)
class OpenStep:
    """A jump without a counterpart.

    Attributes
    ----------
    marker : str
        Name of the marker.
    frame : int
        The frame that the jump leads to.
    size_mm : float
        Its length, mm.
    """

    marker: str
    frame: int
    size_mm: float
