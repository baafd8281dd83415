"""A copy of the project to run as a user does, and a plan or a run of it taken apart."""

import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from markermend.formats.c3d.writer import Content, write_new
from support.paths import PROJECT

FOLDERS = ("workflow", "scripts", "config", "profiles", "envs")


def write_recording(
    path: Path,
    *,
    seed: int,
    markers: int = 6,
    frames: int = 120,
    rate: float = 100.0,
    body: int | None = None,
    prefix: str = "M",
) -> None:
    """Write a small C3D file: a rigid cluster of markers that turns and wanders, with one gap and one peak.

    Recordings of one `body` show the same cluster.
    """
    rng = np.random.default_rng(seed)
    time = np.arange(frames) / rate
    angle = 1.5 * np.sin(2 * time + seed)
    turn = np.moveaxis(np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]), 2, 0)
    cluster = (rng if body is None else np.random.default_rng(body)).uniform(-200, 200, (markers, 3))
    positions = np.repeat(cluster[None], frames, axis=0)
    positions[..., :2] = np.einsum("fij,mj->fmi", turn, cluster[:, :2])
    positions += 300 * np.stack([np.sin(time), np.cos(1.3 * time), 0.2 * np.sin(3 * time)], axis=1)[:, None]
    positions += rng.normal(0, 0.1, positions.shape)
    positions[..., 2] += 1000
    positions[40:50, 1] = np.nan
    positions[80, 2] += 60
    path.parent.mkdir(parents=True, exist_ok=True)
    write_new(path, Content(labels=[f"{prefix}{number}" for number in range(markers)], positions=positions, rate=rate))


@dataclass(frozen=True)
class Plan:
    """A dry run: number of jobs by rule, rules whose parameters changed, and the whole text."""

    jobs: dict[str, int]
    parameters_changed: set[str]
    text: str


class Project:
    """A copy of the project's code beside recordings and results."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder / "project"
        self.recordings = folder / "recordings"
        self.results = folder / "results"
        self.folder.mkdir()
        for name in FOLDERS:
            shutil.copytree(PROJECT / name, self.folder / name, ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy(PROJECT / "Snakefile", self.folder)

    def command(self, *arguments: str, results: Path | None = None, recordings: Path | None = None) -> list[str]:
        """The user's command, on two cores where no profile says on how many."""
        config = [f"recordings={recordings or self.recordings}", f"results={results or self.results}"]
        cores = [] if "--profile" in arguments else ["--cores", "2"]
        return [sys.executable, "-m", "snakemake", *cores, *arguments, "--config", *config]

    def run(self, *arguments: str, environment: dict[str, str] | None = None, status: int = 0, **places: Path) -> str:
        """Run the user's command in the project's folder; it must end with the given exit status."""
        done = subprocess.run(
            self.command(*arguments, **places),
            cwd=self.folder,
            env={**os.environ, **(environment or {})},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            encoding="utf-8",
        )
        assert done.returncode == status, done.stdout
        return done.stdout

    def plan(self, *arguments: str, **places: Path) -> Plan:
        """What the user's command would do."""
        text = self.run("--dry-run", *arguments, **places)
        stats = text.partition("Job stats:")[2].partition("total")[0]
        jobs = {name: int(count) for name, count in re.findall(r"^(\w+) +(\d+)$", stats, re.MULTILINE)}
        changed = re.search(r"params have changed since last execution:\n\s+(.*)", text)
        return Plan(jobs, set(changed[1].split(", ")) if changed else set(), text)

    def outputs(self, results: Path | None = None) -> dict[str, bytes]:
        """Every result, by its path; not logs, Snakemake's records and the facts of the run, which have clocks, nor counts of failures."""
        top = results or self.results
        files = (
            path
            for path in top.rglob("*")
            if path.is_file() and not {"logs", "provenance.json", ".snakemake", "failures.tsv"} & set(path.parts)
        )
        return {path.relative_to(top).as_posix(): path.read_bytes() for path in files}
