"""Decisions against findings: what is left to be repaired once a person has had a say, and what is not and why."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend.core.artifacts import BY_NAME, BY_STAGE, CLASSES
from markermend.core.changes import DECLARED_MISSING, Change, Outcome
from markermend.core.decisions import Decision, Ruling, kind_of, names, rule, texts_of
from markermend.core.events import Event, tidy
from markermend.core.recording import Recording
from markermend.numerics.intervals import runs
from markermend.repair.label_exchanges import concerned


@dataclass(frozen=True)
class Judgement:
    """What the decisions leave to be repaired.

    recording: without the samples that were declared missing. found: findings by detector, each to be repaired as a
    whole. left: stretches that are not.
    """

    recording: Recording
    found: dict[str, list[Event]]
    left: list[Change]


def judge(recording: Recording, found: Mapping[str, Sequence[Event]], decisions: Iterable[Decision]) -> Judgement:
    """Apply the decisions to the findings of each detector, and take away what was declared missing.

    Rejected findings are dropped whole, and so are those on which a person set a class; findings that reach into
    protected samples end there. A decision on one marker of a label exchange is about all of them.
    """
    decisions = [d for d in decisions if d.partner is None or d.partner in recording.markers]
    protected = _mask(recording, (d for d in decisions if d.verb == "protect"))
    away = _mask(recording, (d for d in decisions if d.verb == "missing")) & ~protected & ~recording.missing
    remaining = replace(recording, positions=np.where(away[..., None], np.nan, recording.positions))
    judged = Judgement(remaining, {stage: [] for stage in CLASSES}, _declared(recording, away, decisions))
    exchanges = found.get("labels", ())
    for stage, event in ((stage, event) for stage, events in found.items() for event in events):
        markers = concerned(event, exchanges)
        against = _against(decisions, stage, event, markers)
        if against.left:
            judged.left.append(_entry(stage, event, event.start, event.stop, against))
        else:
            _admit(judged, stage, event, markers, protected, away, decisions)
    for stage, events in _set(remaining, decisions).items():
        for event in events:
            _admit(judged, stage, event, names(event), protected, away, decisions)
    return judged


def _admit(
    judged: Judgement,
    stage: str,
    event: Event,
    markers: Sequence[str],
    protected: np.ndarray,
    away: np.ndarray,
    decisions: Iterable[Decision],
) -> None:
    """Keep a finding on markers where it may be repaired, and note where not. protected, away: bool (frames, markers)."""
    columns = [judged.recording.markers.index(name) for name in markers]
    span = slice(event.start, event.stop)
    shut = np.asarray(protected[span, columns].any(axis=1))
    # A label swap takes missing samples along; any other finding ends where samples were taken away.
    free = ~shut if event.partner else ~shut & ~away[span, columns[0]]
    for start, stop in runs(free):
        if judged.recording.missing[event.start + start : event.start + stop, columns].all():
            continue
        judged.found[stage].append(replace(event, start=event.start + start, stop=event.start + stop))
    for start, stop in runs(shut):
        place = event.start + start, event.start + stop
        ruling = rule((d for d in decisions if d.verb == "protect"), (), markers, *place)
        judged.left.append(_entry(stage, event, *place, ruling))


def _against(decisions: Iterable[Decision], stage: str, event: Event, markers: Sequence[str]) -> Ruling:
    """Why a finding on markers is dropped: rejected, left, or in the place of what a person says is of another class."""
    rest = [decision for decision in decisions if decision.verb != "protect"]
    ruling = rule(rest, [kind_of(stage, event)], markers, event.start, event.stop)
    classes = [d for d in rest if d.verb == "class" and _replaces(d, markers, event)]
    return ruling if ruling.left or not classes else Ruling(classes[0].reason, texts=texts_of(classes))


def _replaces(decision: Decision, markers: Sequence[str], event: Event) -> bool:
    """Whether a person set another class in the place of a finding on markers; an exchange of labels is about both."""
    both = (replace(decision, marker=decision.partner), decision) if decision.partner else (decision,)
    return any(one.on(markers, event.start, event.stop) for one in both)


def _set(recording: Recording, decisions: Iterable[Decision]) -> dict[str, list[Event]]:
    """The findings that a person made, by detector, where anything was measured."""
    made: dict[str, list[Event]] = {}
    for decision in decisions:
        if decision.verb != "class":
            continue
        start, stop = max(decision.start, 0), min(decision.stop, recording.frames)
        for marker in filter(decision.matches, recording.markers):
            event = Event(marker, start, stop, 1.0, partner=decision.partner)
            both = [event] if event.partner is None else [event, replace(event, marker=event.partner, partner=marker)]
            concerned = [recording.markers.index(name) for name in names(event)]
            if start < stop and not recording.missing[start:stop, concerned].all():
                (kind,) = decision.kinds
                made.setdefault(BY_NAME[kind].stage, []).extend(both)
    return {stage: tidy(events) for stage, events in made.items()}


def _declared(recording: Recording, away: np.ndarray, decisions: Iterable[Decision]) -> list[Change]:
    """What was taken away because a person declared it missing, each sample once."""
    left, pending = [], away.copy()
    for decision in decisions:
        if decision.verb != "missing":
            continue
        for m in (m for m, marker in enumerate(recording.markers) if decision.matches(marker)):
            own = pending[:, m] & _mask(recording, [decision])[:, m]
            pending[own, m] = False
            for start, stop in runs(own):
                left.append(
                    Change(
                        recording.markers[m],
                        start,
                        stop,
                        (DECLARED_MISSING,),
                        Outcome.BLANKED,
                        samples=stop - start,
                        decisions=(decision.text,),
                        reason=decision.reason,
                    )
                )
    return left


def _mask(recording: Recording, decisions: Iterable[Decision]) -> np.ndarray:
    """Bool (frames, markers): the samples that any of the decisions is about."""
    covered = np.zeros(recording.missing.shape, bool)
    for decision in decisions:
        for m, marker in enumerate(recording.markers):
            if decision.matches(marker):
                covered[max(decision.start, 0) : max(decision.stop, 0), m] = True
    return covered


def _entry(stage: str, event: Event, start: int, stop: int, ruling: Ruling) -> Change:
    """A finding, or a part of one, that is left as it is."""
    return Change(
        event.marker,
        start,
        stop,
        (BY_STAGE[stage].name,),
        Outcome.LEFT,
        event.score,
        event.axes,
        event.partner,
        samples=stop - start,
        decisions=ruling.texts,
        reason=ruling.left,
    )
