"""Apply a person's decisions to the findings: which of them remain to be repaired, and why the others are left."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend.core.artifacts import BY_NAME, BY_STAGE, DETECTORS, class_of
from markermend.core.changes import DECLARED_MISSING, Change, Outcome
from markermend.core.decisions import Decision
from markermend.core.events import Event, disjoint
from markermend.core.reasons import Cause, Reason
from markermend.core.recording import Recording
from markermend.core.rulings import Ruling, rule, texts_of
from markermend.numerics.intervals import runs
from markermend.repair.label_exchanges import concerned, linked_events

BY_REFERENCE = {
    "usual distances": "off its usual place, by the subject's usual distances",
    "longer part": "off where it is for longer",
    "undecided": "off where it was before, and nothing says which of the two places is right",
}
"""What decided which of two levels counts as right, in words."""


@dataclass(frozen=True)
class DecidedFindings:
    """What the decisions leave to be repaired.

    Attributes
    ----------
    recording : Recording
        The recording without the samples that were declared missing.
    found : dict of str to list of Event
        Findings by detector, each to be repaired as a whole.
    left : list of Change
        Stretches that are not repaired, and why.
    """

    recording: Recording
    found: dict[str, list[Event]]
    left: list[Change]


def apply_decisions(
    recording: Recording, found: Mapping[str, Sequence[Event]], decisions: Iterable[Decision]
) -> DecidedFindings:
    """Apply the decisions to the findings, and take away what was declared missing.

    Parameters
    ----------
    recording : Recording
        The recording as ingested; it is not modified.
    found : mapping of str to sequence of Event
        The findings by detector.
    decisions : iterable of Decision
        The decisions of persons and of the option `protect`.

    Returns
    -------
    DecidedFindings
        What remains. Findings that a person rejected are dropped as a whole, and so are those on which a person set a class;
        findings that reach into protected samples end there. A decision on one marker of a label exchange is about all of
        them, and so is one on a marker of a joint finding, but for `protect`. Findings of classes that are only reported are
        left unless a person accepts them.
    """
    decisions = [d for d in decisions if d.partner is None or d.partner in recording.markers]
    protected = _mask(recording, (d for d in decisions if d.verb == "protect"))
    declared = _mask(recording, (d for d in decisions if d.verb == "missing")) & ~protected & ~recording.missing
    remaining = recording
    if declared.any():
        remaining = replace(recording, positions=np.where(declared[..., None], np.nan, recording.positions))
    decided = DecidedFindings(
        remaining, {stage: [] for stage in DETECTORS}, _declared_missing(recording, declared, decisions)
    )
    admission = _Admission(decided, [d for d in decisions if d.verb == "protect"], protected, declared)
    linked = linked_events(found)
    for stage, event in ((stage, event) for stage, events in found.items() for event in events):
        markers = concerned(event, linked)
        against = _against(decisions, stage, event, markers)
        if against.left:
            decided.left.append(_left(stage, event, event.start, event.stop, against))
        else:
            admission.admit(stage, event, markers if event.partner else event.markers)
    for stage, events in _found_by_persons(remaining, decisions).items():
        for event in events:
            admission.admit(stage, event, event.markers)
    return decided


@dataclass(frozen=True)
class _Admission:
    """Where findings may be repaired; `protected` and `declared` missing are bool (frames, markers)."""

    decided: DecidedFindings
    protections: Sequence[Decision]
    protected: np.ndarray
    declared: np.ndarray

    def admit(self, stage: str, event: Event, markers: Sequence[str]) -> None:
        """Keep a finding on markers where it may be repaired, and record where it may not."""
        missing = self.decided.recording.missing
        columns = [self.decided.recording.markers.index(name) for name in markers]
        span = slice(event.start, event.stop)
        protected = np.asarray(self.protected[span, columns].any(axis=1))
        # An exchange of labels takes missing samples along; any other finding ends where samples were taken away.
        free = ~protected if event.partner else ~protected & ~self.declared[span, columns[0]]
        for start, stop in runs(free):
            if not missing[event.start + start : event.start + stop, columns].all():
                part = replace(event, start=event.start + start, stop=event.start + stop)
                self.decided.found[stage].append(part)
        for start, stop in runs(protected):
            place = event.start + start, event.start + stop
            self.decided.left.append(_left(stage, event, *place, rule(self.protections, (), markers, *place)))


def _against(decisions: Iterable[Decision], stage: str, event: Event, markers: Sequence[str]) -> Ruling:
    """Why a finding on markers is not repaired: rejected, replaced by a class that a person set, or only reported."""
    others = [decision for decision in decisions if decision.verb != "protect"]
    artifact = class_of(stage, event)
    ruling = rule(others, [artifact.name], markers, event.start, event.stop)
    classes = [d for d in others if d.verb == "class" and _replaces(d, markers, event)]
    if ruling.left or classes:
        return ruling if ruling.left else Ruling(classes[0].reason, texts=texts_of(classes))
    if artifact.reported and not ruling.confirmed:
        return replace(ruling, left=Reason(Cause.REPORTED, f"{_extent(event)}{artifact.reported}"))
    return ruling


def _extent(event: Event) -> str:
    """How far a finding is displaced, and by what that was decided, as far as its detector states it."""
    if event.amount_mm is None:
        return ""
    amount = f"{event.amount_mm:.1f} mm"
    return f"{amount} {BY_REFERENCE[event.reference]}: " if event.reference else f"displaced by {amount}: "


def _replaces(decision: Decision, markers: Sequence[str], event: Event) -> bool:
    """Whether a person set another class in the place of a finding on markers; an exchange of labels is about both."""
    both = (replace(decision, marker=decision.partner), decision) if decision.partner else (decision,)
    return any(one.on(markers, event.start, event.stop) for one in both)


def _found_by_persons(recording: Recording, decisions: Iterable[Decision]) -> dict[str, list[Event]]:
    """The findings that persons made, by detector, where anything was measured."""
    made: dict[str, list[Event]] = {}
    for decision in (decision for decision in decisions if decision.verb == "class"):
        start, stop = max(decision.start, 0), min(decision.stop, recording.frames)
        (kind,) = decision.kinds
        stage = BY_NAME[kind].stage
        stated = None if BY_STAGE[stage].name == kind else kind
        group = None if BY_NAME[kind].scope == "marker" else decision.marker
        for marker in filter(decision.matches, recording.markers):
            event = Event(marker, start, stop, 1.0, partner=decision.partner, kind=stated, group=group)
            both = [event] if event.partner is None else [event, replace(event, marker=event.partner, partner=marker)]
            columns = [recording.markers.index(name) for name in event.markers]
            if start < stop and not recording.missing[start:stop, columns].all():
                made.setdefault(stage, []).extend(both)
    return {stage: disjoint(events) for stage, events in made.items()}


def _declared_missing(recording: Recording, declared: np.ndarray, decisions: Iterable[Decision]) -> list[Change]:
    """The records of what persons declared missing, each sample once; declared: bool (frames, markers)."""
    records, pending = [], declared.copy()
    for decision in (decision for decision in decisions if decision.verb == "missing"):
        for m in (m for m, marker in enumerate(recording.markers) if decision.matches(marker)):
            own = pending[:, m] & _mask(recording, [decision])[:, m]
            pending[own, m] = False
            bare = Change(recording.markers[m], 0, 0, (DECLARED_MISSING,), Outcome.BLANKED, reason=decision.reason)
            for start, stop in runs(own):
                own_text = (decision.text,)
                records.append(replace(bare, start=start, stop=stop, samples=stop - start, decisions=own_text))
    return records


def _mask(recording: Recording, decisions: Iterable[Decision]) -> np.ndarray:
    """Bool (frames, markers): the samples that any of the decisions is about."""
    covered = np.zeros(recording.missing.shape, bool)
    for decision in decisions:
        for m, marker in enumerate(recording.markers):
            if decision.matches(marker):
                covered[max(decision.start, 0) : max(decision.stop, 0), m] = True
    return covered


def _left(stage: str, event: Event, start: int, stop: int, ruling: Ruling) -> Change:
    """The record of a finding, or of a part of one, that is left as it is."""
    return Change(
        event.marker,
        start,
        stop,
        (class_of(stage, event).name,),
        Outcome.LEFT,
        event.score,
        event.axes,
        event.partner,
        samples=stop - start,
        decisions=ruling.texts,
        reason=ruling.left,
        group=event.group,
    )
