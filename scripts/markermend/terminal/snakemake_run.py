"""A run of the workflow behind one line of progress: Snakemake's own output goes to a log.

Reads: the events that the logger plug-in writes. Writes: RESULTS/report/logs/run.log.
"""

from __future__ import annotations

import json
import re
import subprocess
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TextIO

from rich.console import Console
from rich.status import Status

from markermend.command.run_workflow import command
from markermend.planning.result_files import ResultFiles
from markermend.terminal.progress import Progress

LOG = Path("report/logs/run.log")
"""Where Snakemake's own output goes, within the results."""

WHERE = re.compile(r'\s*(\w+ in file|File) ".*", line \d+')
"""A line of an error's message that says where in the workflow's own files it was met."""

INTERVAL_S = 0.2
"""Time between two looks at the events, s."""

LAST_LINES = 3
"""Lines of the log that are shown where a run ends with an error that Snakemake did not name."""


def run(arguments: Sequence[str], results: Path, console: Console) -> int:
    """Run the workflow, print a line for each recording that is finished, and how far the run is.

    Parameters
    ----------
    arguments : sequence of str
        Arguments of Snakemake.
    results : Path
        The folder of results.
    console : Console
        Where lines go; the one that changes is shown on a terminal only.

    Returns
    -------
    int
        Snakemake's exit status.
    """
    log, summary = results / LOG, Path(ResultFiles(str(results)).summary)
    log.parent.mkdir(parents=True, exist_ok=True)
    summary.unlink(missing_ok=True)
    progress = Progress(results)
    with tempfile.TemporaryDirectory() as folder, log.open("w", encoding="utf-8") as output:
        events = Path(folder) / "events"
        events.touch()
        told = ["--logger", "markermend", "--logger-markermend-events", str(events)]
        process = subprocess.Popen(command([*arguments, *told]), stdout=output, stderr=subprocess.STDOUT)
        try:
            with console.status("Looking at the recordings") as status, events.open(encoding="utf-8") as file:
                _watch(process, file, progress, console, status)
        except KeyboardInterrupt:
            # Snakemake gets the same signal, and ends its jobs.
            process.wait()
    for line in _conclusion(process.returncode, log, summary, progress):
        console.print(line, markup=False, highlight=False, soft_wrap=True)
    return process.returncode


def _watch(
    process: subprocess.Popen[bytes], events: TextIO, progress: Progress, console: Console, status: Status
) -> None:
    """Show events until the process ends."""
    while True:
        ended = process.poll() is not None
        for line in _lines(events):
            finished = progress.tell(json.loads(line))
            if finished:
                console.print(finished, markup=False, highlight=False, soft_wrap=True)
            if progress.total:
                status.update(progress.line())
        if ended:
            return
        time.sleep(INTERVAL_S)


def _lines(events: TextIO) -> Iterator[str]:
    """The whole lines that were written since the last time."""
    while True:
        start = events.tell()
        line = events.readline()
        if not line.endswith("\n"):
            events.seek(start)
            return
        yield line


def _conclusion(status: int, log: Path, summary: Path, progress: Progress) -> list[str]:
    """The summary of the run, or why there is none."""
    if summary.exists():
        lines = summary.read_text(encoding="utf-8").splitlines()
    elif status:
        text = log.read_text(encoding="utf-8", errors="replace").splitlines()
        told = [line for message in progress.errors for line in message.splitlines() if not WHERE.match(line)]
        lines = told or [line for line in text if line.strip()][-LAST_LINES:]
    else:
        index = log.parent.parent / "index.html"
        lines = ["Nothing to be done: all results are up to date.", *[f"Report: {index}"] * index.exists()]
    return [*lines, f"What Snakemake said: {log}"] if status else lines
