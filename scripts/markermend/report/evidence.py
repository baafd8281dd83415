"""All that the stages wrote about one recording: it before and after, what was found, changed and left, and how."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from markermend.core.changes import Change, Outcome
from markermend.core.decisions import read as read_decisions
from markermend.core.events import Event
from markermend.core.labels import follow
from markermend.core.mesh import Mesh
from markermend.core.recording import BadRecording, Recording, Restored, SetAside
from markermend.core.remarks import with_remarks
from markermend.core.unjudged import neighbours_judge, unjudged_markers, unjudged_warnings
from markermend.core.written import written_changes
from markermend.report.decision_outcomes import DecisionOutcome, outcomes
from markermend.report.open_findings import left_open, worst_first
from markermend.report.smallest_drifts import SmallestDrifts
from markermend.storage import change_file, stage_files
from markermend.storage.mesh_file import for_recording


class QcCall(Protocol):
    """The files that the stage qc reads.

    Attributes
    ----------
    markers, repaired, filled : Path
        Trajectories as ingested, after repair and after filling.
    mesh : Path
        Meshes of the subject.
    events : sequence of Path
        Events of the detectors, in their order.
    changes : Path
        What repair and filling did to each stretch.
    certificate : Path
        What export states about the cleaned file.
    decisions : sequence of mapping
        What persons decided about the recording, as JSON values.
    """

    markers: Path
    repaired: Path
    filled: Path
    mesh: Path
    events: Sequence[Path]
    changes: Path
    certificate: Path
    decisions: Sequence[Mapping[str, Any]]


@dataclass(frozen=True)
class Evidence:
    """One recording before and after cleaning, what was found, changed and left in it, and how.

    Attributes
    ----------
    before, after : Recording
        As ingested, and after repair and filling as the file holds it.
    mesh : Mesh
        The subject's mesh, for this recording.
    found : dict[str, list[Event]]
        Events by detector, for those that ran.
    record : tuple of Change
        What repair and filling did to each stretch.
    changes, left : list of Change
        What was changed and what was left as it is, worst first.
    certificate : dict of str to Any
        What export states about the cleaned file.
    stages : dict[str, dict[str, Any]]
        The options of every stage.
    decisions : sequence of mapping
        What persons decided about the recording, as JSON values.
    noted : tuple of str
        What the detectors warn of.
    smallest_drifts : SmallestDrifts or None
        Which drifts would have been found; None where that is not stated.
    """

    before: Recording
    after: Restored
    mesh: Mesh
    found: dict[str, list[Event]]
    record: tuple[Change, ...]
    changes: list[Change]
    left: list[Change]
    certificate: dict[str, Any]
    stages: dict[str, dict[str, Any]]
    decisions: Sequence[Mapping[str, Any]] = ()
    noted: tuple[str, ...] = ()
    smallest_drifts: SmallestDrifts | None = None

    @property
    def decided(self) -> list[DecisionOutcome]:
        """The outcomes of a person's decisions."""
        return outcomes(self.decisions, self.after, self.record)

    @property
    def learned_from(self) -> list[str]:
        """The names of the subject's other recordings from which filling learned."""
        return list(self.after.facts.get("learned_from", ()))

    @cached_property
    def unjudged(self) -> dict[str, str]:
        """The markers that no detector could judge by their neighbours, and why; none where no detector was to do so."""
        detectors = [self.stages.get(name, {}) for name in self.found if name != "labels"]
        if not neighbours_judge(options.get("preset") for options in detectors):
            return {}
        mesh = self.stages["mesh"]
        shape: dict[str, Any] = next((options["shape"] for options in detectors if "shape" in options), {})
        return unjudged_markers(
            self.before,
            self.mesh,
            min_frames=mesh["min_frames"],
            min_neighbours=mesh["min_predictors"],
            steady_mates=shape.get("steady_mates", 1),
            max_mate_spread_mm=shape.get("max_mate_spread_mm", np.inf),
        )

    @property
    def warnings(self) -> list[str]:
        """Warnings of ingest, mesh, detectors and export, of markers not judged, and of decisions that did nothing."""
        warnings = [
            *self.before.facts.get("warnings", ()),
            *self.mesh.warnings,
            *self.noted,
            *unjudged_warnings(self.unjudged),
        ]
        if refused := self.certificate["refused"]:
            warnings.append(f"{len(refused)} changed samples do not fit the file's number format and were not written")
        return warnings + [outcome.warning for outcome in self.decided if outcome.warning]


def read_evidence(call: QcCall) -> Evidence:
    """Read what the stages wrote.

    Parameters
    ----------
    call : QcCall
        The files that the stage qc reads.

    Returns
    -------
    Evidence
        The recording before and after, and the record of its cleaning.

    Raises
    ------
    SetAside
        If a stage set the recording aside.
    BadRecording
        If the filled recording does not state the origins of its samples.
    """
    before, after = stage_files.read_recording(call.markers), stage_files.read_recording(call.filled)
    if not isinstance(after, Restored):
        raise BadRecording(f"{call.filled.name} does not state where its samples come from: run the fill stage again")
    certificate = stage_files.read_json(call.certificate)
    if "untouched" in certificate:
        raise SetAside(**certificate["untouched"])
    meshes = stage_files.read_json(call.mesh)
    facts_found = [stage_files.read_facts(path) for path in call.events]
    found = {
        facts["stage"]: stage_files.read_events(path) for facts, path in zip(facts_found, call.events, strict=True)
    }
    record = with_remarks(change_file.read(call.changes), read_decisions(call.decisions, before.first_frame))
    found = _as_repaired(found, record)
    written = written_changes(before, after, record, certificate["refused"])
    after, record = written.recording, (*record, *written.refused)
    changes = worst_first(written.applied)
    steps = [before.facts, meshes.get("facts", {}), *facts_found, stage_files.read_facts(call.repaired), after.facts]
    return Evidence(
        before=before,
        after=after,
        mesh=for_recording(meshes, before.facts["recording"], before.markers),
        found=found,
        record=record,
        changes=changes,
        left=left_open(after, found, changes, record),
        certificate=certificate,
        decisions=call.decisions,
        noted=tuple(warning for facts in facts_found for warning in facts.get("warnings", ())),
        stages={facts["stage"]: facts["options"] for facts in steps if "stage" in facts},
        smallest_drifts=next((SmallestDrifts.of(facts) for facts in facts_found if facts["stage"] == "slow"), None),
    )


def _as_repaired(found: dict[str, list[Event]], record: Sequence[Change]) -> dict[str, list[Event]]:
    """Findings under the labels that their samples have after repair, which may leave an exchange of labels undone."""
    exchanged = [change for change in record if change.outcome is Outcome.EXCHANGED]
    carried = [Event(one.marker, one.start, one.stop, 1.0, partner=one.partner) for one in exchanged]
    exchanges = [event for event in found.get("labels", []) if event.partner]

    def followed(events: list[Event]) -> list[Event]:
        others = [event for event in events if not event.partner]
        return follow(others, found_under=exchanges, stated_under=carried)

    return {
        stage: [*(event for event in events if event.partner), *followed(events)] for stage, events in found.items()
    }
