"""Results as if the workflow had run: empty files, and the records that Snakemake keeps of its jobs.

Reads: the arguments of Snakemake, with `--dry-run`.
Writes: every output of the jobs that are planned and the cleaned files, as empty files, and their records below `.snakemake` in the working folder.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.support.planned_results --dry-run --config recordings=FOLDER results=FOLDER

Planning reads names, times and records, and of the files of a finished run nothing else. Running 130,000 jobs to measure it would take a day.
"""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path
from typing import Any

import snakemake.cli
from snakemake.workflow import Workflow

build = Workflow._build_dag


def build_and_write(workflow: Any) -> None:
    """Plan the jobs, write what they would, and end."""
    build(workflow)
    old = time.time() - 3600
    for number, level in enumerate(workflow.dag.toposorted()):
        for job in level:
            params = job.params if job.rule.name == "finish" else {}
            for output in [*job.output, *filter(None, [params.get("cleaned")]), *params.get("trc", [])]:
                Path(output).parent.mkdir(parents=True, exist_ok=True)
                Path(output).touch()
                os.utime(output, (old + number, old + number))
            if job.output:
                workflow.async_run(workflow.persistence.finished(job))
    sys.exit(0)


if __name__ == "__main__":
    Workflow._build_dag = build_and_write
    snakemake.cli.main(sys.argv[1:])
