"""Everything that the stages left behind about one recording, gathered for its summary and its page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from markermend import __version__
from markermend.core.changes import Change, Outcome
from markermend.core.events import Event
from markermend.core.labels import follow
from markermend.core.mesh import Mesh
from markermend.core.recording import BadRecording, Recording, Restored, SetAside
from markermend.report import rendering, timeline
from markermend.report import summary as report_summary
from markermend.report.decision_outcomes import DecisionOutcome, drafts, outcomes
from markermend.report.methods_text import paragraph
from markermend.report.open_findings import left_open, reasons_for_blanking, worst_first
from markermend.report.plot_data import excerpt
from markermend.storage import change_file, stage_files
from markermend.storage.folder_names import decode
from markermend.storage.mesh_file import for_recording

TICKS = 8
"""About so many times along the map of what is missing."""


@dataclass(frozen=True)
class Evidence:
    """One recording before and after, what was found, changed and left in it, and how.

    found: events by detector, for those that ran. record: what repair and filling did to each stretch. changes, left:
    what came of it, worst first. stages: the options of every stage.
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

    @property
    def decided(self) -> list[DecisionOutcome]:
        """What came of a person's decisions."""
        return outcomes(self.stages.get("fill", {}).get("decisions", ()), self.after, self.record)

    @property
    def warnings(self) -> list[str]:
        """What ingest, the mesh and export warned of, and decisions that did nothing."""
        warnings = [*self.before.facts.get("warnings", ()), *self.mesh.warnings]
        if refused := self.certificate["refused"]:
            warnings.append(f"{len(refused)} changed samples do not fit the file's number format and were not written")
        return warnings + [outcome.warning for outcome in self.decided if outcome.warning]


def read(call: Any) -> Evidence:
    """Read what the stages wrote; call: a namespace with the paths that qc reads.

    Raises SetAside where a stage set the recording aside.
    """
    before, after = stage_files.read_recording(call.markers), stage_files.read_recording(call.filled)
    if not isinstance(after, Restored):
        raise BadRecording(f"{call.filled.name} does not say where its samples come from: run the fill stage again")
    certificate = stage_files.read_json(call.certificate)
    if "untouched" in certificate:
        raise SetAside(**certificate["untouched"])
    meshes = stage_files.read_json(call.mesh)
    told = [stage_files.read_facts(path) for path in call.events]
    found = {facts["stage"]: stage_files.read_events(path) for facts, path in zip(told, call.events, strict=True)}
    record = change_file.read(call.changes)
    found = _as_repaired(found, record)
    changes = worst_first(before, after, record)
    steps = [before.facts, meshes.get("facts", {}), *told, stage_files.read_facts(call.repaired), after.facts]
    return Evidence(
        before=before,
        after=after,
        mesh=for_recording(meshes, before.facts["recording"]),
        found=found,
        record=record,
        changes=changes,
        left=left_open(after, found, changes, record),
        certificate=certificate,
        stages={facts["stage"]: facts["options"] for facts in steps if "stage" in facts},
    )


def _as_repaired(found: dict[str, list[Event]], record: Sequence[Change]) -> dict[str, list[Event]]:
    """Findings under the labels that their samples have after repair, which may leave an exchange of labels undone."""
    exchanged = [change for change in record if change.outcome is Outcome.EXCHANGED]
    carried = [Event(one.marker, one.start, one.stop, 1.0, partner=one.partner) for one in exchanged]
    exchanges = found.get("labels", [])
    return {
        stage: events if stage == "labels" else follow(events, found_under=exchanges, stated_under=carried)
        for stage, events in found.items()
    }


def summarize(seen: Evidence, weights: Mapping[str, float]) -> dict[str, Any]:
    """Sum up the recording: see quality.summarize."""
    summary = report_summary.summarize(
        before=seen.before,
        after=seen.after,
        found=seen.found,
        changes=seen.changes,
        left=seen.left,
        warnings=seen.warnings,
        weights=weights,
    )
    methods = paragraph(seen.stages, summary["kind"], __version__)
    return {**summary, "decisions": len(seen.decided), "methods": methods}


def summarize_aside(markers: Path, page: Path, note: SetAside) -> dict[str, Any]:
    """Sum up a recording that was set aside, from what ingest wrote, if anything, and the names of its folders."""
    try:
        facts = stage_files.read_facts(markers)
    except SetAside:
        facts = {}
    recording, subject = name_of(page.absolute().parent), name_of(page.absolute().parent.parent)
    return {
        **report_summary.set_aside({"recording": recording, "subject": subject, **facts}, note.stage, note.reason),
        **place(page),
    }


def name_of(folder: Path) -> str:
    """The name behind a folder's name, or that one where it was cut."""
    try:
        return decode(folder.name)
    except ValueError:
        return folder.name


def place(page: Path) -> dict[str, str]:
    """Where a page lies, relative to the results."""
    return {"page": "/".join(page.absolute().parts[-3:])}


def page(seen: Evidence, summary: Mapping[str, Any], options: Mapping[str, Any]) -> str:
    """Write the recording's page. options: `plots`, `context_s`, `plot_frames`, see the qc stage."""
    artifacts = [finding for finding in seen.left if not finding.is_gap]
    chosen = [*seen.changes[: options["plots"]], *artifacts[: options["plots"]]]
    drawn = {
        finding: (f"finding-{number}", cut(seen, finding, options))
        for number, finding in enumerate(dict.fromkeys(chosen))
    }
    rows = report_summary.per_marker(seen.before, seen.after)
    marks = timeline.lines(seen.before, seen.after)
    busy = [{**row, **mark} for row, mark in zip(rows, marks, strict=True) if any(mark.values())]
    return rendering.page(
        summary=summary,
        facts=seen.before.facts,
        lines=sorted(busy, key=lambda row: (-row["missing_share_after"], -row["missing_share_before"], row["marker"])),
        complete=[row["marker"] for row, mark in zip(rows, marks, strict=True) if not any(mark.values())],
        ticks=timeline.ticks(seen.before, TICKS),
        changes=seen.changes,
        left=seen.left,
        blanked=reasons_for_blanking(seen.changes, seen.record),
        decided=seen.decided,
        drafts={"changed": drafts(seen.changes, seen.after), "open": drafts(seen.left, seen.after)},
        drawn=drawn,
        mesh=seen.mesh,
        certificate=seen.certificate,
        methods=summary["methods"],
        stages=seen.stages,
    )


def cut(seen: Evidence, finding: Change, options: Mapping[str, Any]) -> dict[str, Any]:
    """Cut out what a finding's plot shows."""
    context_s, frames = options["context_s"], options["plot_frames"]
    return excerpt(finding, seen.before, seen.after, context_s=context_s, frames=frames)
