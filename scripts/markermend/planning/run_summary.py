"""What a run came to, in a few lines for the terminal."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Any

from markermend.planning.counts import counted
from markermend.planning.partial_report import PARTIAL
from markermend.storage.folder_names import readable

STATUSES = ("cleaned", "unchanged", "static", "set aside")
"""The possible outcomes of a recording, in the order in which a summary counts them."""

LISTED = 10
"""Largest number of recordings set aside, of static ones, and of those not finished, that a terminal names; the report names all."""

TRACEBACK = "ERROR Traceback"
"""Beginning of such a line that says where; another says why."""

PLOTTING_SCRIPT = "plotly.min.js"
"""The script that pages load from the report's folder."""

ERROR = "ERROR "
"""Beginning of a line of a log that says why a stage failed."""


def summary(paths: Sequence[Path], report: Path | None, unfinished: Collection[Path] = ()) -> str:
    """Sum up a run: recordings by outcome, changed samples, what was set aside, is static or was not finished, and why.

    Parameters
    ----------
    paths : sequence of Path
        Quality files of the recordings; those that do not exist or cannot be read count as unfinished.
    report : Path or None
        First page of the report; the last line names it, or says that it was not written or is older than the results. None where the run
        is a part that comes before the report.
    unfinished : collection of Path, optional
        Those of the quality files that are not of the results as they are now.

    Returns
    -------
    str
        The lines.
    """
    found = [{} if path in unfinished else _read(path) for path in paths]
    counts = Counter(quality.get("status", "unfinished") for quality in found)
    lines = [", ".join(f"{counts[status]} {status}" for status in (*STATUSES, "unfinished") if counts[status])]
    samples = sum(quality.get("changed_samples") or 0 for quality in found)
    lines[0] = f"{counted(len(found), 'recording')}: {lines[0]}; {counted(samples, 'sample')} changed"
    for status in ("set aside", "static"):
        own = [quality for quality in found if quality.get("status") == status]
        lines += [f"  {status}: {q.get('subject')}/{q.get('recording')}: {q.get('reason')}" for q in own[:LISTED]]
        if len(own) > LISTED:
            lines.append(f"  and {len(own) - LISTED} more, all in the report")
    left = [path.parent for path, quality in zip(paths, found, strict=True) if not quality]
    lines += [
        f"  not finished: {readable(*folder.parts[-2:])}: {_last_error(folder / 'logs')}" for folder in left[:LISTED]
    ]
    if len(left) > LISTED:
        lines.append(f"  and {len(left) - LISTED} more that were not finished")
    return "\n".join(
        [*lines, _of_report(report, [path for path, quality in zip(paths, found, strict=True) if quality])]
    )


def _read(path: Path) -> dict[str, Any]:
    """A quality file; empty where there is none that can be read."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) and "status" in found else {}


def _last_error(logs: Path) -> str:
    """The last error in the logs of a recording; where they have none, the place to look at."""
    for path in sorted(logs.glob("*.log"), key=lambda path: path.stat().st_mtime, reverse=True):
        errors = [
            line
            for line in path.read_text(encoding="utf-8", errors="replace").splitlines()
            if line.startswith(ERROR) and not line.startswith(TRACEBACK)
        ]
        if errors:
            return errors[-1].removeprefix(ERROR)
    return f"see {logs}"


def _of_report(report: Path | None, judged: Sequence[Path]) -> str:
    """Where the report is, or that it was not written."""
    if report is None:
        return "This part of the run is closed; the last part writes the report."
    if not report.exists() and not judged:
        return "There is no report: no recording was finished"
    if not report.exists():
        return f"The report was not written: {report}: {_last_error(report.parent / 'logs')}"
    if report.stat().st_mtime == PARTIAL:
        return f"Report of what is finished: {report}"
    if any(path.stat().st_mtime_ns > report.stat().st_mtime_ns for path in judged):
        return f"The report was not written again: {report} is older than the results"
    if not report.with_name(PLOTTING_SCRIPT).exists():
        return f"Report, which has no plots: {report}: {_last_error(report.parent / 'logs')}"
    return f"Report: {report}"
