"""Which events stand or fall as one: exchanges of one stretch, which permute labels in cycles, and joint findings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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


def linked_events(found: Mapping[str, Sequence[Event]]) -> list[Event]:
    """List the events that stand or fall together with others.

    Parameters
    ----------
    found : mapping of str to sequence of Event
        The findings by detector.

    Returns
    -------
    list of Event
        The exchanges of labels, and the events of findings about several markers.
    """
    everything = (event for events in found.values() for event in events)
    return [event for event in everything if event.partner or event.group]


def concerned(event: Event, linked: Sequence[Event]) -> tuple[str, ...]:
    """The names of all markers that a finding is about.

    Parameters
    ----------
    event : Event
        A finding.
    linked : sequence of Event
        All label exchanges and joint findings as detected.

    Returns
    -------
    tuple of str
        The event's own marker first; for a label exchange all markers of its cycle, for a joint finding all of its markers.
    """
    if event.partner:
        return tuple(one.marker for one in cycle_of(event, linked))
    return tuple(dict.fromkeys([event.marker, *(one.marker for one in linked if one.joined_with(event))]))
