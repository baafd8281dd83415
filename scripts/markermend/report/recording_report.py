"""The summary and the page of one recording, made of what the stages wrote about it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from markermend import __version__
from markermend.core.changes import Change, Outcome
from markermend.core.recording import SetAside
from markermend.options.reporting import AttentionOptions, QcOptions
from markermend.report import rendering, sample_statistics, timeline
from markermend.report import summary as report_summary
from markermend.report.attention import with_attention
from markermend.report.decision_outcomes import drafts, judged
from markermend.report.evidence import Evidence
from markermend.report.finding_lines import decidable, finding_lines
from markermend.report.methods_counts import DONE, sentence
from markermend.report.methods_text import paragraph
from markermend.report.open_findings import reasons_for_blanking
from markermend.report.plot_data import excerpt
from markermend.report.stick_figure import stick_figure
from markermend.storage import stage_files
from markermend.storage.folder_names import name_of

TICKS = 8
"""About how many times are marked along the map of missing samples."""


def summarize(seen: Evidence, weights: AttentionOptions) -> dict[str, Any]:
    """Summarize a recording, see summary.summarize.

    Parameters
    ----------
    seen : Evidence
        What the stages wrote.
    weights : AttentionOptions
        Points of attention, see `attention.attention`.

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
        unjudged=list(seen.unjudged),
    )
    summary = with_attention(summary, weights)
    done = {key: bool(summary[key]["events"]) for key in DONE}
    methods = paragraph(
        seen.stages,
        summary["kind"],
        __version__,
        pooled=bool(seen.learned_from),
        filled=done["filled"],
        repaired=done["repaired"] or done["blanked"],
    )
    return {
        **summary,
        **checksums(seen.certificate),
        "refused_samples": len(seen.certificate["refused"]),
        "motion_lacks": list(seen.mesh.lacks),
        "decisions": len(seen.decided),
        "judged": judged(seen.decided, (*seen.changes, *seen.left)),
        "learned_from": seen.learned_from,
        "methods": methods,
    }


def checksums(certificate: Mapping[str, Any]) -> dict[str, str | None]:
    """State the checksums of a file before and after.

    Parameters
    ----------
    certificate : mapping of str to Any
        Of the recording.

    Returns
    -------
    dict of str to str or None
        The sha256 of the original, None where it was not read, and of the cleaned file.
    """
    return {name: certificate[name] for name in ("original_sha256", "cleaned_sha256")}


def summarize_aside(markers: Path, certificate: Path, page: Path, note: SetAside) -> dict[str, Any]:
    """Summarize a recording that was set aside.

    Parameters
    ----------
    markers : Path
        What ingest wrote, if it got that far.
    certificate : Path
        The certificate of the copy of the original.
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
    except (SetAside, OSError):
        facts = {}
    try:
        stated = checksums(stage_files.read_json(certificate))
    except (SetAside, OSError, ValueError, KeyError, TypeError):
        stated = {}
    recording, subject = name_of(page.absolute().parent.name), name_of(page.absolute().parent.parent.name)
    return {
        **report_summary.set_aside({"recording": recording, "subject": subject, **facts}, note.stage, note.reason),
        **stated,
        **place(page),
    }


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
        `plots`, `context_s`, `max_plot_frames` and `notable_drift_mm` of the stage qc.

    Returns
    -------
    str
        HTML.
    """
    changed, left = finding_lines(seen.changes, seen.left, seen.before, seen.after, plots=options.plots)
    artifacts = [finding for finding in seen.left if not finding.is_gap]
    plotted = [line for line in (*changed, *left) if line.plotted]
    rows = sample_statistics.per_marker(seen.before, seen.after)
    marks = timeline.lines(seen.before, seen.after, [*_each_left(seen.record), *artifacts])
    busy = [{**row, **mark} for row, mark in zip(rows, marks, strict=True) if any(mark.values())]
    return rendering.page(
        summary=summary,
        facts=seen.before.facts,
        lines=sorted(busy, key=lambda row: (-row["missing_share_after"], -row["missing_share_before"], row["marker"])),
        complete=[row["marker"] for row, mark in zip(rows, marks, strict=True) if not any(mark.values())],
        ticks=timeline.ticks(seen.before, TICKS),
        changes=changed,
        left=left,
        blanked=reasons_for_blanking(seen.changes, seen.record),
        decided=seen.decided,
        drafts={"changed": drafts(seen.changes, seen.after), "open": drafts(seen.left, seen.after)},
        plots={line.name: plot_of(seen, line.change, options) for line in plotted},
        figure=stick_figure(
            seen.before, seen.after, seen.mesh, [line.change for line in plotted], context_s=options.context_s
        ),
        decidable={
            **decidable((*changed, *left), seen.before, seen.record, seen.stages),
            "decided": list(seen.decisions),
            "recording": summary["recording"],
            "subject": summary["subject"],
        },
        mesh=seen.mesh,
        certificate=seen.certificate,
        methods={**summary["methods"], "counts": sentence([summary])},
        stages=seen.stages,
        found=sample_statistics.per_class(seen.found, seen.before),
        smallest_drifts=seen.smallest_drifts,
        notable_drift_mm=options.notable_drift_mm,
    )


def _each_left(record: Sequence[Change]) -> list[Change]:
    """The artifacts that were left, one for each marker."""
    return [change for change in record if change.outcome is Outcome.LEFT and not change.is_gap]


def plot_of(seen: Evidence, finding: Change, options: QcOptions) -> dict[str, Any]:
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
