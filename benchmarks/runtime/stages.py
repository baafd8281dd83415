"""CPU time and memory of each stage's command on recordings, beside the last table and another version of the project.

Reads: recordings; a checkout of another version.
Writes: for each recording a line to stdout for each stage, for all jobs and for Snakemake.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.runtime.stages ../shared/data/clean/85_12.c3d --other ../markermend-before

The workflow cleans each recording, then the commands of its jobs run again in processes of their own with one thread: medians of several
runs, in which the versions take turns. Detectors that run in one job (`detect`) run by themselves, too; all jobs together are without these. `start_s` is what a command needs to print its help: Python, imports and flags. `last` is the CPU
time in the table that `--tsv` replaces.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import shlex
import shutil
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from benchmarks.support import result_tables
from markermend.core.artifacts import DETECTORS
from markermend.options.general import FINISHING
from markermend.storage import output_checksums

PROJECT = Path(__file__).resolve().parents[2]
"""The folder of the project."""

ENVIRONMENT = {
    **{name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"},
    **{name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")},
}
"""Of the commands: one thread, and modules that are compiled once."""


@dataclass(frozen=True)
class Cost:
    """What a command needed: CPU time, s, and peak memory, MB, both with its child processes."""

    seconds: float
    megabytes: float

    @classmethod
    def of(cls, command: Sequence[str | Path] | str, folder: Path) -> Cost:
        """Run a command (one of a shell if it is a string) in a folder."""
        shell = isinstance(command, str)
        with open(os.devnull, "w", encoding="utf-8") as nowhere:
            process = subprocess.Popen(
                command, cwd=folder, shell=shell, env=ENVIRONMENT, stdout=nowhere, stderr=nowhere
            )
            _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            raise subprocess.CalledProcessError(process.returncode, command)
        return cls(usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)


@dataclass
class Job:
    """The job of a stage: its command, its outputs, and what it needed in each run."""

    command: str
    outputs: list[Path] = field(default_factory=list)
    starts: list[Cost] = field(default_factory=list)
    runs: list[Cost] = field(default_factory=list)

    def run(self, project: Path) -> None:
        """Run the command once without its outputs, and once for its help."""
        self.starts.append(Cost.of([*shlex.split(self.command)[:2], "--help"], project))
        for path in self.outputs:
            path.unlink(missing_ok=True)
        self.runs.append(Cost.of(self.command, project))

    def cost(self) -> dict[str, float]:
        """Medians over the runs, and the largest memory."""
        return {
            "start_s": statistics.median(cost.seconds for cost in self.starts),
            "cpu_s": statistics.median(cost.seconds for cost in self.runs),
            "megabytes": max(cost.megabytes for cost in self.runs),
        }


class Version:
    """A version of the project that cleaned a recording.

    Parameters
    ----------
    project : Path
        Its checkout.
    recordings : Path
        A folder with the recording.
    results : Path
        Where the results go.
    """

    def __init__(self, project: Path, recordings: Path, results: Path) -> None:
        self.project = project
        snakemake = [str(Path(sys.executable).with_name("snakemake")), "--cores", "1"]
        config = ["--config", f"recordings={recordings}", f"results={results}"]
        # Compiling takes as long as some stages.
        for command in ([sys.executable, "-m", "compileall", "-q", "scripts"], [*snakemake, "--dry-run", *config]):
            Cost.of(command, project)
        self.workflow = Cost.of([*snakemake, *config], project).seconds
        for path in results.glob("*/*/08_qc.json"):
            quality = json.loads(path.read_text(encoding="utf-8"))
            if quality["status"] == "set aside":
                raise SystemExit(f"{project} sets the recording aside: {quality['reason']}")
        summary = [*snakemake, "--detailed-summary", *config]
        printed = subprocess.run(summary, cwd=project, check=True, capture_output=True, text=True).stdout
        self.jobs: dict[str, Job] = {}
        for row in reversed(list(csv.DictReader(printed.splitlines(), delimiter="\t"))):
            if row["shellcmd"] != "-":
                self.jobs.setdefault(row["rule"], Job(row["shellcmd"])).outputs.append(Path(row["output_file"]))
        self.parts = {
            record.stage: Job(shlex.join(record.command), [folder.parent / name for name in record.outputs])
            for folder in results.glob("*/*/logs")
            for record in output_checksums.records(folder.parent)
            if record.stage in (*DETECTORS, *FINISHING) and record.stage not in self.jobs
        }

    def run(self) -> None:
        """Run the command of each stage once."""
        for job in (*self.jobs.values(), *self.parts.values()):
            job.run(self.project)

    def costs(self) -> dict[str, dict[str, float]]:
        """Medians over the runs by stage, their sums, and what Snakemake needed in addition."""
        rows = {stage: job.cost() for stage, job in self.jobs.items()}
        starts, seconds = (sum(row[name] for row in rows.values()) for name in ("start_s", "cpu_s"))
        rows["all"] = {"start_s": starts, "cpu_s": seconds, "megabytes": max(row["megabytes"] for row in rows.values())}
        rows["snakemake"] = {"cpu_s": self.workflow - seconds}
        return {**{stage: job.cost() for stage, job in self.parts.items()}, **rows}


def measure(recording: Path, projects: Sequence[Path], runs: int) -> list[dict[str, dict[str, float]]]:
    """The costs of each version on a recording."""
    with tempfile.TemporaryDirectory() as temporary:
        ENVIRONMENT["PYTHONPYCACHEPREFIX"] = str(Path(temporary) / "compiled")
        folder = Path(temporary) / "recordings" / recording.parent.name
        folder.mkdir(parents=True)
        shutil.copyfile(recording, folder / recording.name)
        versions = [
            Version(project, folder.parent, Path(temporary) / f"results{number}")
            for number, project in enumerate(projects)
        ]
        for _ in range(runs):
            for version in versions:
                version.run()
        return [version.costs() for version in versions]


def main() -> None:
    """Parse the command line, measure in turns, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recordings", type=Path, nargs="+")
    parser.add_argument("--other", type=Path, help="a checkout of another version")
    parser.add_argument("--runs", type=int, default=3, help="runs of each version")
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    arguments = parser.parse_args()
    last: dict[tuple[str, str], str] = {}
    if arguments.tsv and arguments.tsv.exists():
        last = {(row["recording"], row["stage"]): row["cpu_s"] for row in result_tables.read(arguments.tsv)}
    rows: list[dict[str, object]] = []
    for path in arguments.recordings:
        own, *others = measure(
            path, [PROJECT, *([arguments.other.resolve()] if arguments.other else [])], arguments.runs
        )
        names = ("start_s", "cpu_s", "megabytes", "other_start_s", "other_cpu_s", "other_megabytes")
        print(f"\n{path.stem:20}", *(f"{name:>16}" for name in (*names, "ratio", "last")))
        for stage in dict.fromkeys([*own, *(stage for other in others for stage in other)]):
            other = others[0].get(stage, {}) if others else {}
            costs = {**own.get(stage, {}), **{f"other_{name}": value for name, value in other.items()}}
            ratio = costs.get("cpu_s", 0.0) / other["cpu_s"] if other else float("nan")
            row = {name: costs.get(name, float("nan")) for name in names} | {"ratio": ratio}
            print(
                f"{stage:20}", *(f"{value:16.2f}" for value in row.values()), f"{last.get((path.stem, stage), ''):>16}"
            )
            rows.append({"recording": path.stem, "stage": stage, **row})
    if arguments.tsv:
        result_tables.write(arguments.tsv, rows)


if __name__ == "__main__":
    main()
