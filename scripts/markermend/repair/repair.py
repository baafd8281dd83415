"""Repair what the detectors found, by class, always from the original samples (skurowski2022 section 4.2.3; own defaults).

Markers are given their samples that lie under unlabelled trajectories; then labels are exchanged, then stretches over which
all markers are displaced are moved back, then, on request, markers that were displaced for good. All other findings were
made on trajectories with the exchanges undone; where an exchange is not carried out, they follow their samples. Every
method of a class proposes samples and states their expected error. The proposal with the least expected error is taken if
it changes more than it may err by, if a method that leaves the neighbours aside brings the samples nearer to where these
predict them, and if the distances to other markers come nearer to what they should be. Where no proposal is accurate enough,
samples that their distances contradict become missing; so do samples that were not measured. Samples outside the findings
are returned bit for bit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from markermend.core.artifacts import class_of
from markermend.core.changes import TreatedRecording
from markermend.core.decisions import Decision, accepting, protecting
from markermend.core.events import Event, mask
from markermend.core.labels import follow
from markermend.core.mesh import Mesh
from markermend.core.reasons import Cause, Limit, Reason
from markermend.core.recording import Recording
from markermend.options.repair import RepairOptions
from markermend.prediction.interface import Predictor
from markermend.prediction.scene import Scene
from markermend.repair.adoptions import adopt_samples
from markermend.repair.apply_decisions import DecidedFindings, apply_decisions
from markermend.repair.candidates import CandidateMaker
from markermend.repair.exchange_plan import PlannedExchange, not_planned, plan_exchanges
from markermend.repair.finding_repair import repair_finding
from markermend.repair.findings import Rulings, group_findings
from markermend.repair.label_exchanges import linked_events
from markermend.repair.lasting_displacements import KINDS, move_markers_back
from markermend.repair.moving_back import move_back
from markermend.repair.predictors import needed_predictors
from markermend.repair.result import Restoration
from markermend.repair.shape_guard import ShapeGuard


def repair(
    recording: Recording,
    mesh: Mesh,
    *,
    found: Mapping[str, Sequence[Event]],
    options: RepairOptions,
    decisions: Sequence[Decision] = (),
) -> TreatedRecording:
    """Repair the findings of each class with the predictors that the options describe.

    Parameters
    ----------
    recording : Recording
        The recording as ingested; it is not modified.
    mesh : Mesh
        The functional body mesh of the subject: it ranks the neighbours of each marker.
    found : mapping of str to sequence of Event
        The findings by detector.
    options : RepairOptions
        The methods of each class, the limits, and the options of the predictors.
    decisions : sequence of Decision
        What a person decided about the recording; no limit holds against a decision.

    Returns
    -------
    TreatedRecording
        The recording after repair; what was repaired, then what was not and why. Missing samples stay missing; static
        recordings are left as they are.
    """
    scene = Scene.of(recording, mesh)
    predictors = needed_predictors(options, decisions)
    return repair_scene(recording, scene, found=found, predictors=predictors, options=options, decisions=decisions)


def repair_scene(
    recording: Recording,
    scene: Scene,
    *,
    found: Mapping[str, Sequence[Event]],
    predictors: Mapping[str, Predictor],
    options: RepairOptions,
    decisions: Sequence[Decision] = (),
) -> TreatedRecording:
    """Repair the findings of each class with given predictors: see `repair`.

    Parameters
    ----------
    recording : Recording
        The recording as ingested; it is not modified.
    scene : Scene
        The same recording as predictors see it, findings included.
    found : mapping of str to sequence of Event
        The findings by detector.
    predictors : mapping of str to Predictor
        The predictors by name: those that the methods of the options and the decisions mention.
    options : RepairOptions
        The methods of each class and the limits.
    decisions : sequence of Decision
        What a person decided about the recording.

    Returns
    -------
    TreatedRecording
        The recording and what was done to each finding.
    """
    static = recording.facts.get("kind") == "static"
    exchanges = [event for event in found.get("labels", ()) if event.partner]
    by_options = [*protecting(options.protect), *(accepting(KINDS) if options.move_back_lasting else ())]
    rulings = Rulings([] if static else [*by_options, *decisions], linked_events(found))
    adoption = adopt_samples(recording, found, rulings)
    recording, found = adoption.recording, adoption.found
    decided = apply_decisions(recording, found, rulings.decisions)
    refusal = (
        Reason(Cause.STATIC, "static recording: never repaired") if static else _too_much(decided, rulings, options)
    )
    maker = _candidate_maker(decided.recording, decided.found, scene, predictors, options)
    methods = options.methods.get("labels", ())
    planned = plan_exchanges(decided, rulings, maker, detected=exchanges, methods=methods, usual=refusal is None)
    carried = [event for exchange in planned if exchange.reason is None for event in exchange.cycle]
    if set(carried) != set(exchanges):
        decided = apply_decisions(recording, _follow_samples(found, exchanges, carried), rulings.decisions)
    result = Restoration(decided.recording, [*decided.left, *adoption.left], options.radius, adopted=adoption.adopted)
    _exchange_labels(result, planned)
    methods = options.methods.get("frames", ())
    settled = move_back(decided.found, rulings, methods=methods, refusal=refusal, result=result)
    settled += move_markers_back(decided.found, scene, rulings, options=options, result=result)
    exchanged = replace(decided.recording, positions=result.positions.copy())
    remaining = {**decided.found, "labels": not_planned(decided.found["labels"], planned)}
    remaining = {stage: [event for event in events if event not in settled] for stage, events in remaining.items()}
    maker = _candidate_maker(exchanged, remaining, scene, predictors, options)
    for finding in group_findings(remaining):
        repair_finding(finding, rulings.on(finding.members), refusal, maker, result)
    restored, changes = result.finished()
    return TreatedRecording(restored, (*adoption.carried_under(exchanges, carried), *changes))


def _candidate_maker(
    recording: Recording,
    found: Mapping[str, Sequence[Event]],
    scene: Scene,
    predictors: Mapping[str, Predictor],
    options: RepairOptions,
) -> CandidateMaker:
    """What proposes repairs: it sees all samples of the recording that were not found."""
    flagged = _covered(recording, [event for events in found.values() for event in events])
    unflagged = replace(scene, positions=np.where(flagged[..., None], np.nan, recording.positions))
    guard = ShapeGuard(unflagged, options.guard, options.predictors.local_ridge, recording.markers)
    return CandidateMaker(recording.positions, flagged, unflagged, predictors, options, guard)


def _covered(recording: Recording, events: Sequence[Event]) -> np.ndarray:
    """Bool (frames, markers): the seen samples that the findings cover."""
    found: np.ndarray = mask(events, recording.frames, recording.markers) & ~recording.missing
    return found


def _too_much(decided: DecidedFindings, rulings: Rulings, options: RepairOptions) -> Reason | None:
    """Why nothing is repaired that no person confirmed; None where it may be."""
    members = [(stage, event) for stage, events in decided.found.items() for event in events]
    # Faults of the whole recording say nothing about how much of it is doubtful.
    members = [(stage, event) for stage, event in members if class_of(stage, event).scope != "recording"]
    # Samples under another label are measured, and stay as they are.
    doubtful = [(stage, event) for stage, event in members if not event.partner]
    unconfirmed = [event for stage, event in doubtful if not rulings.on([(stage, event)]).confirmed]
    seen = int((~decided.recording.missing).sum())
    share = _covered(decided.recording, unconfirmed).sum() / max(1, seen)
    if share <= options.max_altered_share:
        return None
    limit = Limit("repair.max_altered_share", options.max_altered_share, float(share))
    return Reason(Cause.TOO_MUCH, f"findings cover {share:.1%} of the recording ({limit.text})", limit)


def _follow_samples(
    found: Mapping[str, Sequence[Event]], exchanges: Sequence[Event], carried: Sequence[Event]
) -> dict[str, Sequence[Event]]:
    """Findings under the labels that their samples have once the exchanges are carried out."""
    others = {stage: events for stage, events in found.items() if stage != "labels"}
    foreign = [event for event in found.get("labels", ()) if event.partner is None]
    return {
        "labels": [*exchanges, *follow(foreign, found_under=exchanges, stated_under=carried)],
        **{stage: follow(events, found_under=exchanges, stated_under=carried) for stage, events in others.items()},
    }


def _exchange_labels(result: Restoration, planned: Sequence[PlannedExchange]) -> None:
    """Give the markers their own samples, or record why not."""
    for exchange in planned:
        if exchange.reason is None:
            result.exchange(exchange.cycle, exchange.ruling)
            continue
        for event in exchange.cycle:
            result.leave(event, ("swap",), exchange.reason, exchange.ruling, blank=False)
