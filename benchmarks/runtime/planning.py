"""How long Snakemake plans a run, and how much memory it takes, by the number of recordings and subjects.

Writes: a table to stdout.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.runtime.planning --counts 100 1000 10000

The recordings are empty files, all of one subject or five of each. Seconds of a core and peak memory, the start of the program included:

- start: from the command to the first job of a run of which nothing is there yet (the run is stopped then);
- part: the same of the first of four parts, `--batch report=1/4`;
- dry_run: `snakemake --dry-run` of the same, which in addition writes out every job and its command;
- current: `snakemake --dry-run` where all results are there;
- one_more: the same with one recording more;
- run_current: a run where all results are there, which has nothing to do.
"""

from __future__ import annotations

import argparse
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Collection, Iterator
from pathlib import Path

from benchmarks.support import result_tables
from benchmarks.support.defaults import PROJECT
from benchmarks.support.fill_runs import WATCH

COUNTS = (100, 1_000)
FEW = 5
"""Recordings of each subject, where there are many subjects."""

FIRST = ("start", "part", "dry_run")
"""Cases in which nothing is there yet."""

CASES = (*FIRST, "current", "run_current", "one_more")
PART = ("--batch", "report=1/4")
POLL_S = 0.02


def arguments(folder: Path) -> list[str]:
    """Arguments of Snakemake for the recordings in a folder, all of them quiet."""
    config = [f"recordings={folder / 'recordings'}", f"results={folder / 'results'}"]
    given = ["--snakefile", str(PROJECT / "Snakefile"), "--directory", str(folder), "--workflow-profile"]
    return [*given, str(PROJECT / "profiles/default"), "--cores", "1", "--quiet", "all", "--config", *config]


def write_recordings(folder: Path, count: int, subjects: int) -> None:
    """Write recordings that are empty files."""
    for number in range(count):
        path = folder / f"recordings/S{number % subjects:05}/r{number:05}.c3d"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()


def whole(folder: Path, *more: str) -> tuple[float, float]:
    """Seconds of a core and MB of a run that ends by itself."""
    command = [sys.executable, "-c", WATCH, sys.executable, "-m", "snakemake", *more, *arguments(folder)]
    with tempfile.TemporaryFile() as errors, tempfile.TemporaryFile("w+", encoding="utf-8") as output:
        subprocess.run(command, stdout=output, stderr=errors, check=True)
        output.seek(0)
        seconds, megabytes = map(float, output.read().splitlines()[-1].split())
    return seconds, megabytes


def start(folder: Path, *more: str) -> tuple[float, float]:
    """Seconds of a core and MB of a run until its first job is about to begin."""
    listed = folder / "results/report/logs/recordings.txt"
    command = [sys.executable, "-m", "snakemake", *more, *arguments(folder)]
    run = subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True, cwd=folder
    )
    try:
        while not listed.exists() and run.poll() is None:
            time.sleep(POLL_S)
        if run.poll() is not None:
            raise RuntimeError(f"the run ended before its first job: {' '.join(command)}")
        process = Path(f"/proc/{run.pid}")
        ticks = (process / "stat").read_text().rpartition(")")[2].split()[11:13]
        peak = next(line for line in (process / "status").read_text().splitlines() if line.startswith("VmHWM"))
        return sum(map(int, ticks)) / os.sysconf("SC_CLK_TCK"), float(peak.split()[1]) / 1024
    finally:
        os.killpg(run.pid, signal.SIGKILL)
        run.wait()


def measure(case: str, folder: Path) -> tuple[float, float]:
    """Seconds of a core and MB of one case, on recordings in a folder, with results if there are any."""
    if case in ("start", "part"):
        return start(folder, *(PART if case == "part" else ()))
    if case == "one_more":
        (folder / "recordings/S00000/new.c3d").touch()
    return whole(folder, *([] if case == "run_current" else ["--dry-run"]))


def measure_all(cases: Collection[str], count: int, subjects: int) -> Iterator[tuple[str, float, float]]:
    """The cases, each with seconds of a core and MB; those in which results are there share them."""
    for case in (case for case in FIRST if case in cases):
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary).resolve()
            write_recordings(folder, count, subjects)
            yield case, *measure(case, folder)
    later = [case for case in CASES if case in cases and case not in FIRST]
    if not later:
        return
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary).resolve()
        write_recordings(folder, count, subjects)
        command = [sys.executable, "-m", "benchmarks.support.planned_results", "--dry-run", *arguments(folder)]
        quiet = subprocess.DEVNULL
        subprocess.run(command, check=True, cwd=PROJECT, stdout=quiet, stderr=quiet)
        for case in later:
            yield case, *measure(case, folder)


def main() -> None:
    """Parse the command line, measure, print a row for each number of recordings and subjects."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--counts", nargs="+", type=int, default=COUNTS, help="numbers of recordings")
    parser.add_argument("--cases", nargs="+", choices=CASES, default=CASES)
    parser.add_argument("--subjects", choices=("one", "many"), nargs="+", default=("one", "many"))
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    given = parser.parse_args()
    rows: list[dict[str, object]] = []
    for count in given.counts:
        for subjects in [1 if name == "one" else count // FEW for name in given.subjects]:
            row: dict[str, object] = {"recordings": count, "subjects": subjects}
            print(f"{count} recordings, {subjects} subjects:", end="", flush=True)
            for case, seconds, megabytes in measure_all(given.cases, count, subjects):
                row |= {f"{case}_seconds": round(seconds, 1), f"{case}_megabytes": round(megabytes)}
                print(f"  {case} {seconds:.1f} s {megabytes:.0f} MB", end="", flush=True)
            print()
            rows.append(row)
            if given.tsv:
                result_tables.write(given.tsv, rows)


if __name__ == "__main__":
    main()
