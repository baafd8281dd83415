"""The outcome of everything that was found: the changes, and the stretches that were left as they are.

Frames are rows counted from 0, half-open.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import groupby

from markermend.core.artifacts import class_of
from markermend.core.changes import GAP, Change, Outcome
from markermend.core.events import FRAMES_APART, Event
from markermend.core.reasons import UNSTATED
from markermend.core.recording import Recording, gaps


def worst_first(applied: Iterable[Change]) -> list[Change]:
    """Sort the changes that are found in the result, worst first.

    Parameters
    ----------
    applied : iterable of Change
        The changes as applied.

    Returns
    -------
    list of Change
        The changes by the larger of change and expected error; those of a joint finding are one.
    """
    return sorted(joined(applied), key=lambda change: (-change.concern_mm, *_place(change)))


def joined(changes: Iterable[Change]) -> list[Change]:
    """Make one change of those that a finding about several markers led to.

    Parameters
    ----------
    changes : iterable of Change
        Changes, one for each marker.

    Returns
    -------
    list of Change
        The changes of single markers, then for each joint finding and outcome the change of largest concern, with the whole
        stretch and the number of all samples.
    """
    each = list(changes)
    single = [change for change in each if change.group is None]
    together = sorted(
        (c for c in each if c.group), key=lambda c: (c.group or "", c.classes, c.outcome, *_place(c)[::-1])
    )
    for _, own in groupby(together, key=lambda c: (c.group, c.classes, c.outcome)):
        parts: list[list[Change]] = []
        for change in own:
            reach = max(FRAMES_APART.get(name, 0) for name in change.classes)
            if parts and change.start < max(other.stop for other in parts[-1]) + reach:
                parts[-1].append(change)
            else:
                parts.append([change])
        single += [_joint(part) for part in parts]
    return single


def _joint(parts: Sequence[Change]) -> Change:
    """One change for those of a finding about several markers."""
    worst = max(parts, key=lambda change: change.concern_mm)
    methods = dict.fromkeys(change.method for change in parts if change.method)
    return replace(
        worst,
        start=min(change.start for change in parts),
        stop=max(change.stop for change in parts),
        method=", ".join(methods) or None,
        samples=sum(change.samples for change in parts),
        decisions=tuple(dict.fromkeys(text for change in parts for text in change.decisions)),
    )


def markers_of(finding: Change, changes: Iterable[Change]) -> list[str]:
    """List the markers of a finding.

    Parameters
    ----------
    finding : Change
        The finding; of one about several markers the change that stands for all.
    changes : iterable of Change
        What repair and filling did to each stretch.

    Returns
    -------
    list of str
        The markers by name.
    """
    joint = finding.group is not None
    same = [c for c in changes if joint and (c.group, c.classes) == (finding.group, finding.classes)]
    return sorted({finding.marker, *(change.marker for change in same if overlap(change, finding))})


def reasons_for_blanking(applied: Iterable[Change], changes: Iterable[Change]) -> dict[Change, str]:
    """Say why samples were taken away where there is a change now.

    Parameters
    ----------
    applied : sequence of Change
        The changes as applied.
    changes : sequence of Change
        What repair and filling did to each stretch.

    Returns
    -------
    dict of Change to str
        For each applied change that shares a frame with what was taken away the classes and reasons.
    """
    blanked = [change for change in changes if change.outcome is Outcome.BLANKED and change.reason]
    reasons = {}
    for change in applied:
        own = [old for old in blanked if old.marker == change.marker and overlap(old, change)]
        if own:
            texts = [f"{old.kind}: {old.reason.text}" for old in own if old.reason]
            reasons[change] = "; ".join(dict.fromkeys(texts))
    return reasons


def left_open(
    restored: Recording, found: Mapping[str, Sequence[Event]], applied: Sequence[Change], changes: Sequence[Change]
) -> list[Change]:
    """List what was left as it is: artifacts that were not repaired, then gaps that were not filled, worst first.

    Parameters
    ----------
    restored : Restored
        The recording after repair and filling.
    found : mapping of str to sequence of Event
        The events by detector. A finding that no stage accounts for is listed too.
    applied : sequence of Change
        The changes as applied.
    changes : sequence of Change
        What repair and filling did to each stretch. What was taken away is a change, and a gap if it was not filled.

    Returns
    -------
    list of Change
        What was left, each with its reason.
    """
    artifacts = [change for change in changes if not change.is_gap]
    left = [change for change in artifacts if change.outcome is Outcome.LEFT]
    known = _by_marker([*applied, *artifacts])
    for stage, events in found.items():
        for event in events:
            if not any(overlap(other, event) for other in known.get(event.marker, ())):
                left.append(_unaccounted(stage, event))
    left = sorted(joined(left), key=lambda change: (-(change.score or 0.0), *_place(change)))
    return left + open_gaps(restored, changes)


def open_gaps(restored: Recording, changes: Iterable[Change]) -> list[Change]:
    """List the gaps that are left.

    Parameters
    ----------
    restored : Restored
        The recording after repair and filling.
    changes : sequence of Change
        What repair and filling did to each stretch.

    Returns
    -------
    list of Change
        The gaps, longest first, each with the reason that the stages gave.
    """
    stated = _by_marker(change for change in changes if change.is_gap and change.outcome is Outcome.LEFT)
    found = []
    for m, start, stop in gaps(restored):
        gap = Change(restored.markers[m], start, stop, (GAP,), Outcome.LEFT, samples=stop - start, reason=UNSTATED)
        own = next((change for change in stated.get(gap.marker, ()) if overlap(change, gap)), gap)
        found.append(replace(gap, reason=own.reason, decisions=own.decisions))
    return sorted(found, key=lambda change: (-change.samples, *_place(change)))


def overlap(one: Change, other: Change | Event) -> bool:
    """Check whether two stretches share a frame.

    Parameters
    ----------
    one, other : Change or Event
        The stretches.

    Returns
    -------
    bool
        Whether there is a frame that lies in both.
    """
    return one.start < other.stop and other.start < one.stop


def _by_marker(changes: Iterable[Change]) -> dict[str, list[Change]]:
    """Sort changes into lists by marker."""
    lists: dict[str, list[Change]] = {}
    for change in changes:
        lists.setdefault(change.marker, []).append(change)
    return lists


def _unaccounted(stage: str, event: Event) -> Change:
    """A finding of which no stage stated the outcome."""
    return Change(
        event.marker,
        event.start,
        event.stop,
        (class_of(stage, event).name,),
        Outcome.LEFT,
        event.score,
        event.axes,
        event.partner,
        samples=event.stop - event.start,
        reason=UNSTATED,
        group=event.group,
    )


def _place(change: Change) -> tuple[str, int]:
    """Where a change is: what ties are broken by."""
    return change.marker, change.start
