"""All that the stages wrote about one recording, collected for its summary and its page."""

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
from markermend.options.reporting import AttentionOptions, QcOptions
from markermend.report import rendering, sample_statistics, timeline
from markermend.report import summary as report_summary
from markermend.report.decision_outcomes import DecisionOutcome, drafts, outcomes
from markermend.report.methods_text import paragraph
from markermend.report.open_findings import left_open, reasons_for_blanking, worst_first
from markermend.report.plot_data import excerpt
from markermend.storage import change_file, stage_files
from markermend.storage.folder_names import decode
from markermend.storage.mesh_file import for_recording

TICKS = 8
"""About how many times are marked along the map of missing samples."""


@dataclass(frozen=True)
class Evidence:
    """One recording before and after cleaning, what was found, changed and left in it, and how.

    Attributes
    ----------
    before, after : Recording
        As ingested, and after repair and filling.
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
        """The outcomes of a person's decisions."""
        return outcomes(self.stages.get("fill", {}).get("decisions", ()), self.after, self.record)

    @property
    def warnings(self) -> list[str]:
        """Warnings of ingest, mesh and export, and of decisions that did nothing."""
        warnings = [*self.before.facts.get("warnings", ()), *self.mesh.warnings]
        if refused := self.certificate["refused"]:
            warnings.append(f"{len(refused)} changed samples do not fit the file's number format and were not written")
        return warnings + [outcome.warning for outcome in self.decided if outcome.warning]


def read(call: Any) -> Evidence:
    """Read what the stages wrote.

    Parameters
    ----------
    call : Any
        A namespace with the paths that the stage qc reads.

    Returns
    -------
    Evidence
        The recording and everything known about its cleaning.

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
    record = change_file.read(call.changes)
    found = _as_repaired(found, record)
    changes = worst_first(before, after, record)
    steps = [before.facts, meshes.get("facts", {}), *facts_found, stage_files.read_facts(call.repaired), after.facts]
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


def summarize(seen: Evidence, weights: AttentionOptions) -> dict[str, Any]:
    """Summarize a recording, see summary.summarize.

    Parameters
    ----------
    seen : Evidence
        What the stages wrote.
    weights : AttentionOptions
        Points of attention, see summary.attention.

    Returns
    -------
    dict of str to Any
        JSON values.
    """
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
    """Summarize a recording that was set aside.

    Parameters
    ----------
    markers : Path
        What ingest wrote, if it got that far.
    page : Path
        Where the page goes; its folders name subject and recording.
    note : SetAside
        The stage that set the recording aside, and why.

    Returns
    -------
    dict of str to Any
        JSON values.
    """
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
    """Give the name that the name of a folder encodes.

    Parameters
    ----------
    folder : Path
        Of a recording or a subject.

    Returns
    -------
    str
        The name; that of the folder where it was cut.
    """
    try:
        return decode(folder.name)
    except ValueError:
        return folder.name


def place(page: Path) -> dict[str, str]:
    """Give the place of a page relative to the results.

    Parameters
    ----------
    page : Path
        Its path.

    Returns
    -------
    dict of str to str
        Under the key `page`.
    """
    return {"page": "/".join(page.absolute().parts[-3:])}


def page(seen: Evidence, summary: Mapping[str, Any], options: QcOptions) -> str:
    """Write the page of a recording.

    Parameters
    ----------
    seen : Evidence
        What the stages wrote.
    summary : mapping of str to Any
        What summarize gives.
    options : QcOptions
        `plots`, `context_s` and `plot_frames` of the stage qc.

    Returns
    -------
    str
        HTML.
    """
    artifacts = [finding for finding in seen.left if not finding.is_gap]
    chosen = [*seen.changes[: options.plots], *artifacts[: options.plots]]
    drawn = {
        finding: (f"finding-{number}", cut(seen, finding, options))
        for number, finding in enumerate(dict.fromkeys(chosen))
    }
    rows = sample_statistics.per_marker(seen.before, seen.after)
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


def cut(seen: Evidence, finding: Change, options: QcOptions) -> dict[str, Any]:
    """Extract what the plot of a finding shows.

    Parameters
    ----------
    seen : Evidence
        What the stages wrote.
    finding : Change
        The finding.
    options : QcOptions
        `context_s` and `plot_frames` of the stage qc.

    Returns
    -------
    dict of str to Any
        See plot_data.excerpt.
    """
    context_s, frames = options.context_s, options.max_plot_frames
    return excerpt(finding, seen.before, seen.after, context_s=context_s, frames=frames)
