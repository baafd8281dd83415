"""The report of a run that ended before all recordings were finished."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterable, Sequence
from contextlib import suppress
from pathlib import Path

from markermend.planning.result_files import ResultFiles
from markermend.storage.atomic import write_list, write_text
from markermend.storage.failure_counts import count_failure

PARTIAL = 315532800
"""The time of the last change of such a report, that of 1 January 1980: older than all that the next run makes it of."""

STALE = PARTIAL + 86400
"""The time given to the report of an earlier run while another is made, which it keeps where that fails: it is older than the results."""


REPORT_FILES = {
    "index": "index.html",
    "summary": "summary.tsv",
    "script": "plotly.min.js",
    "data-set": "data_set.js",
}
"""The files that the command of the report writes, by its flags."""


def write(
    files: ResultFiles, finished: Sequence[str], unfinished: Sequence[str], *, decisions: str, script: Path
) -> None:
    """Make the report of the recordings that are finished; it names the others.

    The next run makes it again, since its files are older than what it is made of, and a failure of the report is counted. Its log says
    what goes wrong.

    Parameters
    ----------
    files : ResultFiles
        Names of the result files.
    finished, unfinished : sequence of str
        The quality files of the recordings.
    decisions : str
        The table of decisions.
    script : Path
        The command of the rule `report`.
    """
    inputs = {"qc": files.quality_list, "unfinished": files.unfinished_list}
    outputs = {name: Path(files.report, file) for name, file in REPORT_FILES.items()}
    command = [sys.executable, str(script)]
    command += [word for name, path in inputs.items() for word in (f"--{name}", f"@{path}")]
    command += ["--decisions", files.decision_table]
    command += [word for name, path in outputs.items() for word in (f"--{name}", str(path))]
    with suppress(OSError):
        _date(outputs.values(), STALE)
        count_failure(Path(files.report), "report", "not all recordings were finished")
        write_list(files.quality_list, finished)
        write_list(files.unfinished_list, unfinished)
        write_text(Path(files.decision_table), decisions)
        with open(f"{files.report}/logs/report.log", "w", encoding="utf-8") as log:
            subprocess.run(command, stderr=log, check=False)
        _date((path for path in outputs.values() if path.exists() and path.stat().st_mtime != STALE), PARTIAL)


def _date(paths: Iterable[Path], seconds: int) -> None:
    """Set the times of files, as far as they are there."""
    for path in paths:
        if path.exists():
            os.utime(path, (seconds, seconds))
