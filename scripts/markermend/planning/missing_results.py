"""Results that were written and are gone: Snakemake makes none anew as long as the report, in the end, is there."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from types import SimpleNamespace

from markermend.planning.discovery import Folders
from markermend.planning.plan import Plan
from markermend.planning.result_files import QUALITY, ResultFiles
from markermend.storage.failure_counts import count_failure

Missing = tuple[str, str, str]
"""Folder of the subject, or `report`; folder of the recording, or nothing; the stage of which a result is gone."""


def find_missing(plan: Plan) -> list[Missing]:
    """Find the stages of which a result is gone; the folder of each recording is listed once.

    Parameters
    ----------
    plan : Plan
        The recordings, and what is written for each.

    Returns
    -------
    list of Missing
        The stages of recordings that were judged, those of their subjects, and the report where it was made of a recording that is no
        longer judged; what has not been made yet is not gone.
    """
    stages = _stages(plan)
    missing: list[Missing] = []
    judged: list[Folders] = []
    for subject, recording in plan.data.entries:
        there = _names(plan.files.recording.format(subject=subject, recording=recording))
        if QUALITY not in there:
            continue
        judged.append((subject, recording))
        missing += [(subject, recording, stage) for stage, own in stages.items() if not there.issuperset(own)]
        about = SimpleNamespace(subject=subject, recording=recording)
        if not all(map(os.path.exists, [plan.cleaned(about), *plan.trc(about)])):
            missing.append((subject, recording, "export"))
    for subject in dict(judged):
        shared = {"mesh": plan.files.mesh, **({"poses": plan.files.poses} if plan.pools(subject) else {})}
        missing += [
            (subject, "", stage) for stage, path in shared.items() if not os.path.exists(path.format(subject=subject))
        ]
    if len(judged) < len(plan.data.entries) and os.path.exists(f"{plan.files.report}/index.html"):
        missing += [("report", "", stage) for stage in ("collect", "report")]
    return list(dict.fromkeys(missing))


def _stages(plan: Plan) -> dict[str, set[str]]:
    """Names of the files that each stage writes into the folder of a recording."""
    files = plan.files
    written = {
        "ingest": [files.markers],
        **{stage: [files.events[stage]] for stage in plan.detectors},
        "repair": [files.repaired, files.repairs],
        "fill": [files.filled, files.changes],
        "export": [files.change_table, files.originals, files.certificate],
        "qc": [files.quality, files.page],
    }
    return {stage: set(map(os.path.basename, own)) for stage, own in written.items()}


def _names(folder: str) -> set[str]:
    """The names in a folder; none where it is not there."""
    try:
        return set(os.listdir(folder))
    except OSError:
        return set()


def count_missing(files: ResultFiles, missing: Iterable[Missing]) -> None:
    """Count a failure of each stage of which a result is gone, so that it is made anew.

    Parameters
    ----------
    files : ResultFiles
        Names of the result files.
    missing : iterable of Missing
        What `find_missing` found.

    Raises
    ------
    NotWritten
        Where a failure cannot be counted.
    """
    for subject, recording, stage in missing:
        count_failure(Path(files.results, subject, recording), stage, "a result is gone")
