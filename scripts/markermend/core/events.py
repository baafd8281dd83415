"""Findings of the detectors: half-open intervals of one marker with a score, and the masks derived from them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.numerics.intervals import runs


@dataclass(frozen=True)
class Event:
    """One finding on one marker over [start, stop).

    score: >= 1, in units of the threshold. axes: those that fired, such as "xz". partner: the other marker of a swap.
    """

    marker: str
    start: int
    stop: int
    score: float
    axes: str = "xyz"
    partner: str | None = None

    @property
    def order(self) -> tuple[str, int, int, str]:
        """What events are sorted by."""
        return self.marker, self.start, self.stop, self.partner or ""


def from_mask(mask: np.ndarray, score: np.ndarray, fired: np.ndarray, markers: Sequence[str]) -> list[Event]:
    """Turn a mask (frames, markers) into events.

    score: (frames, markers), evidence in units of the threshold, its maximum over the interval is the event's (at
    least 1). fired: bool (frames, markers, 3), the axes that fired.
    """
    found = []
    for m, marker in enumerate(markers):
        for start, stop in runs(mask[:, m]):
            hits: list[bool] = np.any(fired[start:stop, m], axis=0).tolist()
            axes = "".join(axis for axis, hit in zip("xyz", hits, strict=True) if hit)
            best = float(max(1.0, np.nanmax(score[start:stop, m], initial=1.0)))
            found.append(Event(marker, start, stop, best, axes or "xyz"))
    return tidy(found)


def tidy(events: Iterable[Event]) -> list[Event]:
    """Sort events and merge those of one marker and partner that overlap or touch, so that they are disjoint per marker."""
    merged: list[Event] = []
    for event in sorted(events, key=lambda event: event.order):
        last = merged[-1] if merged else None
        if last and last.marker == event.marker and event.start <= last.stop and last.partner == event.partner:
            axes = "".join(axis for axis in "xyz" if axis in last.axes + event.axes)
            merged[-1] = Event(
                last.marker, last.start, max(last.stop, event.stop), max(last.score, event.score), axes, last.partner
            )
        elif last and last.marker == event.marker and event.start < last.stop:
            if event.stop > last.stop:
                merged.append(Event(event.marker, last.stop, event.stop, event.score, event.axes, event.partner))
        else:
            merged.append(event)
    return merged


def mask(events: Iterable[Event], frames: int, markers: Sequence[str]) -> np.ndarray:
    """Bool (frames, markers): True where any of the events stands. Events on unknown markers raise KeyError."""
    index = {marker: m for m, marker in enumerate(markers)}
    covered = np.zeros((frames, len(markers)), bool)
    for event in events:
        covered[event.start : event.stop, index[event.marker]] = True
    return covered


def coordinates(events: Iterable[Event], frames: int, markers: Sequence[str]) -> np.ndarray:
    """Bool (frames, markers, 3): True where any of the events stands, on the axes that fired. See mask."""
    found = list(events)
    own = [[event for event in found if axis in event.axes] for axis in "xyz"]
    return np.stack([mask(some, frames, markers) for some in own], axis=2)


def carrying(vectors: np.ndarray) -> str:
    """The axes that carry a finding (n, 3): those whose largest component is at least half of the largest of all."""
    size = np.abs(vectors).max(axis=0)
    return "".join(axis for axis, part in zip("xyz", size, strict=True) if part >= 0.5 * size.max())


@dataclass(frozen=True)
class OpenStep:
    """A jump without a counterpart: the frame that it leads to, and its size in mm."""

    marker: str
    frame: int
    size_mm: float
