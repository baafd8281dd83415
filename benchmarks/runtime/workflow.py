"""Run the workflow over a folder of recordings and print the outcome of each, and the cost of each stage.

Reads: the recordings named on the command line, as snakemake takes them.
Writes: results in the folder given (a temporary one without --results); three tables to stdout.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.runtime.workflow ../shared/data/clean --cores 1

Times are those of Snakemake's own benchmark files: seconds from start to end of a stage's process, imports included,
and the share of a core that it used. `overhead` is the wall time of the whole run without those seconds.
"""

from __future__ import annotations

import argparse
import csv
import json
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from pathlib import Path

from benchmarks.support.defaults import PROJECT


def run(recordings: str, results: Path, cores: int) -> float:
    """Run the workflow; returns the wall time, s."""
    command: list[str | Path] = [Path(sys.executable).with_name("snakemake"), "--cores", str(cores), "--quiet", "all"]
    command += ["--config", f"recordings={Path(recordings).resolve()}", f"results={results}"]
    started = time.perf_counter()
    subprocess.run(command, cwd=PROJECT, check=True)
    return time.perf_counter() - started


def costs(results: Path) -> dict[tuple[str, str], dict[str, float]]:
    """Figures of every job, by stage and what it was about: s, cpu_time (s), max_rss (MB)."""
    jobs = {}
    for path in sorted(results.glob("**/logs/*.tsv")):
        with open(path, encoding="utf-8") as file:
            row = next(csv.DictReader(file, delimiter="\t"), {})
        if "max_rss" not in row:
            continue  # a table of something else, such as the decisions
        figures = {key: float(row[key]) for key in ("s", "cpu_time", "max_rss") if row[key] not in ("NA", "-")}
        jobs[path.stem, str(path.parent.parent.relative_to(results))] = figures
    return jobs


def print_recordings(results: Path, jobs: dict[tuple[str, str], dict[str, float]]) -> None:
    """One row per recording: its outcome, and the time it took against the time it lasts."""
    print(
        f"{'recording':44} {'status':10} {'altered %':>9} {'repaired':>8} {'filled':>7} {'open':>5} {'s':>6} {'s/s':>6}"
    )
    for path in sorted(results.glob("*/*/08_qc.json")):
        quality = json.loads(path.read_text(encoding="utf-8"))
        about = str(path.parent.relative_to(results))
        spent = sum(figures["s"] for (_, other), figures in jobs.items() if other == about)
        if quality["status"] == "set aside":
            print(f"{about:44} {'set aside':10} {quality['reason']}")
            continue
        repaired, filled, still = (quality[key]["events"] for key in ("repaired", "filled", "gaps_open"))
        print(
            f"{about:44} {quality['status']:10} {100 * quality['changed_share']:9.3f} {repaired:8} {filled:7} {still:5} "
            f"{spent:6.1f} {spent / quality['duration_s']:6.2f}"
        )


def print_stages(jobs: dict[tuple[str, str], dict[str, float]], wall: float, cores: int) -> None:
    """One row per stage: its jobs, their seconds and memory; and what the workflow added."""
    stages = defaultdict(list)
    for (stage, _), figures in jobs.items():
        stages[stage].append(figures)
    print(f"\n{'stage':8} {'jobs':>5} {'s':>8} {'s/job':>7} {'cpu s':>8} {'MB, most':>9}")
    for stage, rows in stages.items():
        total, cpu = (sum(row.get(key, 0.0) for row in rows) for key in ("s", "cpu_time"))
        memory = max(row.get("max_rss", 0.0) for row in rows)
        print(f"{stage:8} {len(rows):5} {total:8.1f} {total / len(rows):7.2f} {cpu:8.1f} {memory:9.0f}")
    spent = sum(figures["s"] for figures in jobs.values())
    overhead = wall - spent / cores
    print(
        f"\nwall {wall:.1f} s on {cores} cores; in stages {spent:.1f} s; overhead {overhead:.1f} s ({len(jobs)} jobs)"
    )


def print_changes(results: Path) -> None:
    """Every repair: where, what, how large."""
    print("\nrepairs")
    for path in sorted(results.glob("*/*/changes.tsv")):
        with open(path, encoding="utf-8") as file:
            for row in csv.DictReader(file, delimiter="\t"):
                if row["class"] != "filled":
                    print("  ", path.parent.relative_to(results), *list(row.values())[1:])


def main() -> None:
    """Parse the command line, run, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recordings", help="a folder or table of recordings")
    parser.add_argument("--results", type=Path, help="where results go and stay")
    parser.add_argument("--cores", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scrap:
        results = (arguments.results or Path(scrap)).resolve()
        wall = run(arguments.recordings, results, arguments.cores)
        jobs = costs(results)
        print_recordings(results, jobs)
        print_stages(jobs, wall, arguments.cores)
        print_changes(results)


if __name__ == "__main__":
    main()
