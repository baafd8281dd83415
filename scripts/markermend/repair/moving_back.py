"""Stretches over which all markers are displaced together: they are moved back as the rigid body that they are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from markermend.core.artifacts import class_of
from markermend.core.events import Event
from markermend.core.reasons import Cause, Reason
from markermend.numerics import displaced_scene
from markermend.repair.findings import Rulings
from markermend.repair.result import Restoration

METHOD = "move_back"
"""Name of the method."""

RETURNS = {"jump": True, "shift": False}
"""Whether the markers are back in their places after a stretch, by the classes of which all markers are displaced."""


def move_back(
    found: Mapping[str, Sequence[Event]],
    rulings: Rulings,
    *,
    methods: Sequence[str],
    refusal: Reason | None,
    result: Restoration,
) -> list[Event]:
    """Move markers back to where they were before they were displaced together.

    Parameters
    ----------
    found : mapping of str to sequence of Event
        The findings that remain to be repaired, by detector.
    rulings : Rulings
        The decisions.
    methods : sequence of str
        The methods of the stage; without `move_back` only what a person confirmed is moved.
    refusal : Reason, optional
        Why nothing in the recording is repaired that no person confirmed.
    result : Restoration
        The result so far, which is changed.

    Returns
    -------
    list of Event
        The events of these stretches that are settled: moved, or left with a reason.
    """
    displaced = [event for event in found["frames"] if class_of("frames", event).name in RETURNS]
    settled: list[Event] = []
    for group in _joint_findings(displaced):
        ruling = rulings.on([("frames", group[0])])
        wanted = ruling.method == METHOD if ruling.method else METHOD in methods or ruling.confirmed
        if not wanted:
            continue
        settled += group
        kind = class_of("frames", group[0]).name
        start, stop = min(event.start for event in group), max(event.stop for event in group)
        moved = displaced_scene.move_back(result.positions, start, stop, returns=RETURNS[kind])
        reason = None if ruling.confirmed else refusal
        if moved is None:
            reason = Reason(Cause.NO_METHOD, "too few markers are seen before and after to move them back")
        for event in group:
            if reason is None and moved is not None:
                m, span = result.markers.index(event.marker), slice(event.start - start, event.stop - start)
                result.move_back(event, moved[0][span, m], moved[1][span, m], ruling)
            elif reason is not None:
                result.leave(event, (kind,), reason, ruling, blank=False)
    return settled


def _joint_findings(events: Sequence[Event]) -> list[list[Event]]:
    """The events of each finding, those first that return: what lies inside a longer stretch is moved before it."""
    groups: list[list[Event]] = []
    for event in sorted(events, key=lambda event: (not RETURNS[class_of("frames", event).name], event.start)):
        own = next((group for group in groups if any(event.joined_with(other) for other in group)), None)
        if own is None:
            groups.append([event])
        else:
            own.append(event)
    return groups
