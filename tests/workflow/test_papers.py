"""The experiments of the papers as a user runs them: what is planned, and that they need no recordings."""

import subprocess
import sys
from pathlib import Path

import pytest

from markermend.evaluation.classification import CLASSES
from markermend.evaluation.experiments import PAPERS
from markermend.evaluation.table_files import read_table
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


CONDITION = ["recording", "preset", "amplitude_mm", "share_percent", "runs"]
RATES = ["class", "TPR", "FNR", "PPV", "FDR", "FPR", "F", "MCC", "TPR_published", "FDR_published", "F_published"]
PMA = [
    "recording",
    "sequence",
    "gaps",
    "length_s",
    "duration_s",
    "method",
    "runs",
    "unfilled",
    "error_mm",
    "standard_error_mm",
    "median_mm",
    "published",
]
COLUMNS = {
    "artifacts2022/measures": [*CONDITION, *RATES],
    "artifacts2022/confusion": [*CONDITION, "true", *CLASSES],
    "gaps2021/descriptors": ["recording", "sequence", "descriptor", "value", "published"],
    "gaps2021/parameters": ["method", "parameters", "least_of_runs", "largest_of_runs", "published"],
    "pma2018/lengths": PMA,
    "pma2018/durations": PMA,
    "pma2018/gap_counts": PMA,
}  # fmt: skip
"""Columns of tables that users' scripts may read."""


@pytest.fixture(scope="module")
def quick(project) -> Path:
    """The folder of the papers after a quick run of all of them."""
    done = run(project, "papers", *QUICK)
    assert done.returncode == 0, done.stdout
    return project.results / "papers"


def table(folder, name):
    paper, _, file = name.partition("/")
    return read_table(folder / paper / "tables" / f"{file}.tsv")


@pytest.mark.slow
def test_quick_makes_every_table_and_page_and_nothing_twice(project, quick):
    assert (quick / "index.html").exists() and not (project.results / "report").exists()
    for paper, module in PAPERS.items():
        assert (quick / paper / "index.html").exists()
        assert all(len(table(quick, f"{paper}/{name}")) for name in module.TABLES)
        claims = table(quick, f"{paper}/claims")
        assert set(claims["holds"]) <= {"yes", "no", "not tested"}
        assert (claims["reason"] != "")[claims["holds"] == "not tested"].all()
    for name, columns in COLUMNS.items():
        assert list(table(quick, name)) == columns
    assert "Nothing to be done" in run(project, "papers", *QUICK).stdout


@pytest.mark.slow
def test_every_number_of_a_paper_comes_from_a_run(quick):
    measures, confusion = table(quick, "artifacts2022/measures"), table(quick, "artifacts2022/confusion")
    own = confusion[confusion["true"] == "noise"].set_index(CONDITION)
    found = 100 * own["noise"] / own[list(CLASSES)].sum(axis=1)
    stated = measures[measures["class"] == "noise"].set_index(CONDITION)["TPR"]
    assert stated.to_dict() == pytest.approx(found.to_dict(), abs=0.01)


@pytest.mark.slow
def test_artifacts_are_classified_as_in_the_paper(quick):
    measures = table(quick, "artifacts2022/measures").set_index(["preset", "class"]).sort_index()
    noise, peaks = (measures.loc[[("paper", name)]] for name in ("noise", "peaks"))
    assert noise["TPR"].min() > 88 and noise["FDR"].max() < 20
    assert peaks["TPR"].between(60, 95).all()
    assert measures.loc[[("default", "all")], "F"].min() > 0.997


@pytest.mark.slow
def test_gaps_are_filled_in_the_order_of_the_paper(quick):
    errors = table(quick, "gaps2021/errors")
    short = errors[errors["length"] == 10].pivot(index="recording", columns="method", values="rmse")
    networks = [name for name in short if name.startswith("network_")]
    assert len(networks) == 5
    assert (short["spline"] < short[["linear", "makima", "pchip", *networks]].min(axis=1)).all()
    parameters = table(quick, "gaps2021/parameters").set_index("method")
    same = parameters["parameters"] == parameters["published"]
    assert same[same.index != "network_bilstm"].all()  # of which a figure is misprinted


@pytest.mark.slow
def test_averages_fill_all_gaps(quick):
    for name in ("lengths", "durations", "gap_counts"):
        errors = table(quick, f"pma2018/{name}")
        assert (errors["unfilled"] == 0).all() and (errors["error_mm"] > 0).all()
        wide = errors.pivot_table(
            index=["gaps", "length_s", "duration_s"], columns="method", values="error_mm", dropna=False
        )
        assert (wide["default"] < wide["pma_1_2_3_4"]).mean() > 0.8
    counts = table(quick, "pma2018/gap_counts").pivot(index="method", columns="gaps", values="error_mm")
    assert (counts.iloc[:, -1] > counts.iloc[:, 0]).all()
