"""The experiments of the papers as a user runs them: what is planned, and that they need no recordings."""

import csv
import subprocess
import sys
from pathlib import Path

import pytest

from markermend.evaluation.experiments import PAPERS
from support.workflow_runs import Project, write_recording

QUICK = ("--configfile", "config/evaluate/quick.yaml")


@pytest.fixture(scope="module")
def project(tmp_path_factory) -> Project:
    return Project(tmp_path_factory.mktemp("papers"))


def run(project, *arguments, config=()):
    command = [sys.executable, "-m", "snakemake", "--cores", "2", *arguments]
    given = ["--config", f"results={project.results}", *config]
    return subprocess.run(
        [*command, *given], cwd=project.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )


def test_without_recordings_the_papers_are_planned_and_the_cleaning_says_what_is_missing(project):
    done = run(project, "--dry-run", "papers", *QUICK)
    assert done.returncode == 0, done.stdout
    for paper in PAPERS:
        assert f"{paper}_tables" in done.stdout
    done = run(project, "--dry-run")
    assert done.returncode == 1
    assert "no such folder or table" in done.stdout and "Traceback" not in done.stdout


def test_given_recordings_take_the_place_of_synthetic_ones(project):
    for name in ("S01/a.c3d", "S02/a.c3d"):
        write_recording(project.recordings / name, seed=1)
    done = run(project, "--dry-run", "papers", *QUICK, config=[f"recordings={project.recordings}"])
    assert done.returncode == 0, done.stdout
    assert "Prepare S01_a" in done.stdout and "Prepare S02_a" in done.stdout
    assert "Prepare walk" not in done.stdout and "ingest" not in done.stdout


def test_options_that_cannot_be_used_are_named(project, tmp_path):
    (tmp_path / "wrong.yaml").write_text("evaluate: {artifacts2022: {run: 3}}\n", encoding="utf-8")
    done = run(project, "--dry-run", "papers", "--configfile", str(tmp_path / "wrong.yaml"))
    assert done.returncode == 1
    assert "evaluate.artifacts2022.run: there is no such key; did you mean runs?" in done.stdout


@pytest.mark.slow
def test_quick_makes_every_table_and_page(project):
    done = run(project, "papers", *QUICK)
    assert done.returncode == 0, done.stdout
    top = project.results / "papers"
    assert (top / "index.html").exists() and not (project.results / "report").exists()
    for paper, module in PAPERS.items():
        assert (top / paper / "index.html").exists()
        for name in module.TABLES:
            assert rows(top / paper / "tables" / f"{name}.tsv"), name
        claims = rows(top / paper / "tables/claims.tsv")
        assert {row["holds"] for row in claims} <= {"yes", "no", "not tested"}
        assert all(row["reason"] for row in claims if row["holds"] == "not tested")
    assert "Nothing to be done" in run(project, "papers", *QUICK).stdout


def rows(path: Path) -> list[dict[str, str]]:
    """The rows of a table."""
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file, delimiter="\t"))
