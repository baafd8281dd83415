"""The end of a run: its facts, the summary in the terminal, and the report of what was finished where not all was.

Reads: the quality files of the recordings.
Writes: provenance.json, and where the run ended early a report. Takes away a description of the results as a crate, which is outdated.
"""

from __future__ import annotations

import sys
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Any

from markermend.options.config import write_config
from markermend.planning import partial_report, run_facts, run_summary
from markermend.planning.discovery import Folders
from markermend.planning.plan import Plan
from markermend.storage.atomic import NotWritten, check_writable, write_json, write_text
from markermend.storage.crate_file import METADATA

CRATE_TAKEN_AWAY = (
    f"{METADATA} described earlier results and was taken away: to publish these, run markermend crate again"
)
"""What is said where the results had been described as a crate."""


def write_facts(plan: Plan, *, finished: bool) -> None:
    """Write the facts of the run.

    Parameters
    ----------
    plan : Plan
        The run.
    finished : bool
        Whether all results are of this run. Else the facts of an earlier run are left: the code in them is that which the next run
        compares with.
    """
    if not finished and Path(plan.files.provenance).exists():
        return
    facts = run_facts.run_facts(
        plan.project, config=write_config(plan.options), recordings=len(plan.data.entries), started=plan.started
    )
    write_json(Path(plan.files.provenance), facts)


def close(plan: Plan, pending: Sequence[Any], part: Collection[Folders] | None = None) -> None:
    """Print the summary of the run, whatever became of it; warnings again, which a long run has hidden.

    Parameters
    ----------
    plan : Plan
        The run.
    pending : sequence of Wildcards
        The wildcards of the jobs that were not finished; where there are any, the report is made of what was finished.
    part : collection of Folders, optional
        The recordings of the run, where it is a part that comes before the report.
    """
    places = {(getattr(job, "subject", None), getattr(job, "recording", None)) for job in pending}
    quality_files = dict(zip(plan.data.entries, map(Path, plan.quality_files), strict=True))
    unfinished = {path for entry, path in quality_files.items() if entry in places or not path.exists()}
    finished = [str(path) for path in quality_files.values() if path not in unfinished]
    index = Path(plan.files.report) / "index.html" if part is None else None
    # Of nothing no report is made: it would be older than nothing, and the next run would have nothing to do.
    if pending and index and (finished or index.exists()):
        partial_report.write(
            plan.files,
            finished,
            sorted(map(str, unfinished)),
            decisions=plan.data.decision_table,
            script=plan.project / "scripts/report.py",
        )
    about = [path for entry, path in quality_files.items() if part is None or entry in part]
    lines = [*plan.warnings, run_summary.summary(about, index, unfinished)]
    try:
        check_writable(Path(plan.files.results))
        crate = Path(plan.files.results, METADATA)
        if crate.exists():
            crate.unlink()
            lines.append(CRATE_TAKEN_AWAY)
        write_text(Path(plan.files.summary), "".join(f"{line}\n" for line in lines))
    except NotWritten as error:
        lines.append(str(error))
    print(*lines, sep="\n", file=sys.stderr)
