"""Which label exchanges belong together: the events of one stretch permute labels in cycles, and stand or fall as one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from markermend.core.events import Event


def cycle_of(event: Event, exchanges: Sequence[Event]) -> list[Event]:
    """The exchanges of one cycle, from partner to partner and back to the first.

    Parameters
    ----------
    event : Event
        One of them, with a partner.
    exchanges : sequence of Event
        All label exchanges; those of a cycle have the same stretch.

    Returns
    -------
    list of Event
        The given one first. Where the partner's own exchange is not among them, as for a label under which nothing was
        recorded, it is made up: the two are each other's partners.
    """
    stretch = (event.start, event.stop)
    along = {one.marker: one for one in exchanges if one.partner and (one.start, one.stop) == stretch}
    cycle = [event]
    while len(cycle) <= len(along) and (onward := along.get(str(cycle[-1].partner))) and onward.marker != event.marker:
        cycle.append(onward)
    closed = cycle[-1].partner == event.marker
    return cycle if closed else [event, replace(event, marker=str(event.partner), partner=event.marker)]


def concerned(event: Event, exchanges: Sequence[Event]) -> tuple[str, ...]:
    """The names of all markers that a finding is about.

    Parameters
    ----------
    event : Event
        A finding.
    exchanges : sequence of Event
        All label exchanges as detected.

    Returns
    -------
    tuple of str
        The event's own marker first; for a label exchange all markers of its cycle.
    """
    return tuple(one.marker for one in cycle_of(event, exchanges)) if event.partner else event.markers
