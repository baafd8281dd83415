"""Samples that markers are given from unlabelled trajectories, before anything else is repaired."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend.core.adoption import ADOPTABLE, FOREIGN, adopt, is_adopted, without_adopted
from markermend.core.artifacts import class_of
from markermend.core.changes import Change, Outcome
from markermend.core.events import Event, mask
from markermend.core.labels import follow
from markermend.core.reasons import Cause, Reason
from markermend.core.recording import Recording
from markermend.core.rulings import Ruling
from markermend.repair.findings import Rulings

METHOD = "adopt"
"""What the record names as the method."""


@dataclass(frozen=True)
class Adoption:
    """A recording with the samples that its markers are given.

    Attributes
    ----------
    recording : Recording
        The recording, under the labels as recorded.
    adopted : np.ndarray
        Which of its samples these are, bool (frames, markers).
    found : dict of str to sequence of Event
        The findings by detector, without those that are settled here.
    carried, left : list of Change
        The findings of samples under unlabelled trajectories that were carried out, and the others, with the reason.
    """

    recording: Recording
    adopted: np.ndarray
    found: dict[str, Sequence[Event]]
    carried: list[Change]
    left: list[Change]

    def carried_under(self, exchanges: Sequence[Event], undone: Sequence[Event]) -> list[Change]:
        """State what was carried out under the labels that the samples have in the end.

        Parameters
        ----------
        exchanges : sequence of Event
            The exchanges of labels as detected.
        undone : sequence of Event
            Those of them that are undone.

        Returns
        -------
        list of Change
            The records; one is split where its samples go to different labels.
        """
        return [
            replace(change, marker=part.marker, start=part.start, stop=part.stop, samples=part.stop - part.start)
            for change in self.carried
            for part in follow(
                [Event(change.marker, change.start, change.stop, 1.0)], found_under=exchanges, stated_under=undone
            )
        ]


def adopt_samples(recording: Recording, found: Mapping[str, Sequence[Event]], rulings: Rulings) -> Adoption:
    """Give markers their samples that are recorded under unlabelled trajectories.

    Parameters
    ----------
    recording : Recording
        The recording as ingested; it is not modified.
    found : mapping of str to sequence of Event
        The findings by detector.
    rulings : Rulings
        The decisions.

    Returns
    -------
    Adoption
        The recording with them. Findings that are only reported are left unless a person accepts them; no measured sample is
        replaced that is not found to be on something else.
    """
    labels = found.get("labels", ())
    exchanges = [event for event in labels if event.partner]
    carried: list[Event] = []
    changes = []
    for event in (event for event in labels if event.source is not None):
        ruling = _ruling_on(event, rulings, exchanges)
        reason = _reason_against(event, ruling, recording)
        if reason is None:
            carried.append(event)
        changes.append(_change(event, ruling, reason))
    foreign = [event for event in labels if event.kind == FOREIGN and rulings.on([("labels", event)]).left is None]
    as_recorded = {
        name: follow(events, found_under=exchanges, stated_under=())
        for name, events in (("adopted", carried), ("foreign", foreign))
    }
    free = recording.missing | mask(as_recorded["foreign"], recording.frames, recording.markers)
    positions = adopt(recording.positions, as_recorded["adopted"], recording.unlabelled, recording.markers)
    given = free & mask(as_recorded["adopted"], recording.frames, recording.markers) & ~np.isnan(positions).any(axis=2)
    positions = np.where(given[..., None], positions, recording.positions) if given.any() else recording.positions
    remaining = [event for event in labels if event.source is None]
    others = {stage: events for stage, events in found.items() if stage != "labels"}
    return Adoption(
        replace(recording, positions=positions),
        given,
        {"labels": without_adopted(remaining, carried), **others} if "labels" in found else others,
        [change for change in changes if change.reason is None],
        [change for change in changes if change.reason is not None],
    )


def _ruling_on(event: Event, rulings: Rulings, exchanges: Sequence[Event]) -> Ruling:
    """The ruling on a finding, whichever of the two classes a decision names, and whether an exchange around it is undone or not."""
    under = [event, *follow([event], found_under=exchanges, stated_under=())]
    each = [rulings.on([("labels", replace(part, kind=kind)) for kind in ADOPTABLE]) for part in under]
    return next((ruling for ruling in each if ruling.left), each[0])


def _reason_against(event: Event, ruling: Ruling, recording: Recording) -> Reason | None:
    """Why samples are not adopted; None where they are."""
    if recording.facts.get("kind") == "static":
        return Reason(Cause.STATIC, "static recording: never repaired")
    if ruling.left is not None:
        return ruling.left
    if is_adopted(event) or ruling.confirmed:
        return None
    reported = class_of("labels", event).reported
    return Reason(Cause.REPORTED, f"{event.stop - event.start} samples may lie under {event.source}: {reported}")


def _change(event: Event, ruling: Ruling, reason: Reason | None) -> Change:
    """The record of a finding."""
    return Change(
        event.marker,
        event.start,
        event.stop,
        (class_of("labels", event).name,),
        Outcome.LEFT if reason else Outcome.ADOPTED,
        event.score,
        event.axes,
        event.source,
        method=None if reason else METHOD,
        samples=event.stop - event.start,
        expected_error_mm=None if reason else 0.0,
        expected_error95_mm=None if reason else 0.0,
        decisions=ruling.texts,
        reason=reason,
    )
