"""Label exchanges: over a stretch of frames the samples of a marker are recorded under the label of another one.

An exchange is an event with a `partner`: the samples of its marker are recorded under the partner's label. The events of
one stretch permute the labels among themselves: two that are each other's partners, or a cycle of three and more. They
are undone here, for the detectors that come after and for the repair. Findings made on trajectories with exchanges undone
name the marker under its right label, and `follow` restates them for other labels.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import groupby, pairwise

import numpy as np

from markermend.core.events import Event


def undo_exchanges(positions: np.ndarray, exchanges: Iterable[Event], markers: Sequence[str]) -> np.ndarray:
    """Give each marker the samples that were recorded under the label of its partner.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        Trajectories as recorded, mm; NaN = missing, and moves along. Not modified.
    exchanges : iterable of Event
        Events without a partner are passed over.
    markers : sequence of str
        Names of the markers of the second axis.

    Returns
    -------
    ndarray of float, shape (frames, markers, 3)
        A copy that differs in the exchanged stretches alone, whose samples are the recorded ones bit for bit; the positions
        themselves where there are none.
    """
    partners = [(event, event.partner) for event in exchanges if event.partner is not None]
    corrected = positions.copy() if partners else positions
    for event, partner in partners:
        span = slice(event.start, event.stop)
        corrected[span, markers.index(event.marker)] = positions[span, markers.index(partner)]
    return corrected


def follow(events: Iterable[Event], *, found_under: Sequence[Event], stated_under: Sequence[Event]) -> list[Event]:
    """Restate findings for other labels, so that each stays with the samples on which it was made.

    Parameters
    ----------
    events : iterable of Event
        Findings on trajectories on which the exchanges `found_under` were undone.
    found_under, stated_under : sequence of Event
        The exchanges that were undone when the findings were made, and those that are undone where they are used.

    Returns
    -------
    list of Event
        Sorted; a finding is split where its samples go to different labels, and stays whole where they do not.
    """
    followed: list[Event] = []
    borders = {border for event in (*found_under, *stated_under) for border in (event.start, event.stop)}
    for event in events:
        inside = sorted(border for border in borders if event.start < border < event.stop)
        pieces = [
            (_label(_recorded(event.marker, start, found_under), start, stated_under), start, stop)
            for start, stop in pairwise([event.start, *inside, event.stop])
        ]
        for marker, own in groupby(pieces, key=lambda piece: piece[0]):
            spans = list(own)
            followed.append(replace(event, marker=marker, start=spans[0][1], stop=spans[-1][2]))
    return sorted(followed, key=lambda event: event.order)


def _recorded(marker: str, frame: int, exchanges: Sequence[Event]) -> str:
    """The label under which the sample of a marker is recorded."""
    partners = (one.partner for one in exchanges if one.marker == marker and one.start <= frame < one.stop)
    return next((partner for partner in partners if partner is not None), marker)


def _label(recorded: str, frame: int, exchanges: Sequence[Event]) -> str:
    """The marker to which the sample recorded under a label belongs."""
    owners = (one.marker for one in exchanges if one.partner == recorded and one.start <= frame < one.stop)
    return next(owners, recorded)
