"""The workflow as others find and deploy it: the workflow catalog, its small test set, and a module of another workflow."""

import csv
import os
import re
import shutil
import subprocess
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

import pytest
import yaml

from support.paths import PROJECT
from support.workflow_runs import FOLDERS

TEST_SET = PROJECT / ".test"

DEPLOYED = """
from snakemake.utils import min_version
min_version("6.10.0")

configfile: "config/config.yaml"

module markermend:
    snakefile:
        {snakefile}
    config:
        config

use rule * from markermend
"""
"""What `snakedeploy deploy-workflow` writes into workflow/Snakefile."""

HOOKS = """
onstart:
    print("Ours begins")
    markermend.onstart()

onsuccess:
    markermend.onsuccess()
"""
"""What a person adds to it who has hooks."""


def snakemake(*arguments: str | Path, cwd: Path, environment: dict[str, str] | None = None) -> str:
    """Run Snakemake, which must succeed, and return what it printed."""
    done = subprocess.run(
        [sys.executable, "-m", "snakemake", *arguments],
        cwd=cwd,
        env={**os.environ, **(environment or {})},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert done.returncode == 0, done.stdout
    return done.stdout


def results(folder: Path) -> dict[str, bytes]:
    """The results in a folder, without logs, records and the facts of the run."""
    found = (path.relative_to(folder) for path in folder.rglob("*") if path.is_file())
    apart = {"logs", ".snakemake", "provenance.json"}
    return {path.as_posix(): (folder / path).read_bytes() for path in found if apart.isdisjoint(path.parts)}


@pytest.fixture(scope="module")
def tested(tmp_path_factory) -> Path:
    """The test set after its run, by the catalog's convention."""
    folder = tmp_path_factory.mktemp("tested") / ".test"
    shutil.copytree(TEST_SET, folder, ignore=shutil.ignore_patterns("results", ".snakemake"))
    snakemake("--directory", folder, "--cores", "2", cwd=PROJECT)
    return folder


def test_the_test_set_runs_to_its_report_and_finds_what_is_in_it(tested):
    assert (tested / "results/report/index.html").exists()
    for name in ("first", "second"):
        with (tested / f"results/S01/{name}/changes.tsv").open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file, delimiter="\t"))
        assert [(row["marker"], row["first_frame"], row["last_frame"], row["class"]) for row in rows] == [
            ("M1", "41", "50", "filled"),
            ("M2", "81", "81", "peak"),
        ]


@dataclass(frozen=True)
class Source:
    """Where a deployed workflow comes from: what its Snakefile says, and what Git needs to find it."""

    snakefile: str
    environment: dict[str, str]
    hooks: str = ""


def local(folder: Path) -> Source:
    """The checkout, in a workflow that has hooks."""
    return Source(f'"{PROJECT / "workflow/Snakefile"}"', {}, HOOKS)


def hosted(folder: Path) -> Source:
    """A release on a forge, which stands in a folder here."""
    work, home = folder / "work", folder / "someone/markermend.git"
    for name in FOLDERS:
        shutil.copytree(PROJECT / name, work / name, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(PROJECT / "Snakefile", work)
    git = ["git", "-C", work, "-c", "user.name=Ada", "-c", "user.email=ada@example.org"]
    for words in (["init", "--quiet"], ["add", "."], ["commit", "--quiet", "-m", "First"], ["tag", "v0.1.0"]):
        subprocess.run([*git, *words], check=True)
    subprocess.run(["git", "clone", "--quiet", "--bare", work, home], check=True)
    redirected = {"KEY_0": f"url.file://{folder}/.insteadOf", "VALUE_0": "https://github.com/", "COUNT": "1"}
    return Source(
        'github("someone/markermend", path="workflow/Snakefile", tag="v0.1.0")',
        {f"GIT_CONFIG_{key}": value for key, value in redirected.items()},
    )


@pytest.mark.parametrize("source", [local, hosted])
def test_deployed_as_a_module_it_gives_the_same_results(tested, tmp_path, source):
    found = source(tmp_path)
    folder = tmp_path / "study"
    for name in ("config", "profiles"):
        shutil.copytree(PROJECT / name, folder / name)
    (folder / "workflow").mkdir()
    text = DEPLOYED.format(snakefile=found.snakefile) + found.hooks
    (folder / "workflow/Snakefile").write_text(text, encoding="utf-8")
    config = (folder / "config/config.yaml").read_text(encoding="utf-8")
    own = re.sub("^recordings: .*$", f"recordings: {tested / 'recordings'}", config, flags=re.MULTILINE)
    (folder / "config/config.yaml").write_text(own, encoding="utf-8")
    environment = {"XDG_CACHE_HOME": str(tmp_path / "cache"), **found.environment}

    said = snakemake("--cores", "2", cwd=folder, environment=environment)
    assert "2 recordings: 2 cleaned" in said and f"Report: {folder}/results/report/index.html" in said
    assert results(folder / "results") == results(tested / "results")
    assert (folder / "results/report/provenance.json").exists() and ("Ours begins" in said) == bool(found.hooks)
    assert "Nothing to be done" in snakemake("--dry-run", "--cores", "2", cwd=folder, environment=environment)


def test_the_catalog_finds_what_it_asks_for():
    usage = yaml.safe_load((PROJECT / ".snakemake-workflow-catalog.yml").read_text(encoding="utf-8"))["usage"]
    assert usage == {"software-stack-deployment": {"conda": True}, "report": False}
    assert {"snakemake", "workflow"} <= set((PROJECT / "README.md").read_text(encoding="utf-8").lower().split())
    assert (PROJECT / "config/README.md").exists() and (PROJECT / "workflow/Snakefile").exists()


def test_its_linter_objects_to_what_is_decided_and_to_nothing_else(tmp_path):
    command = [sys.executable, "-m", "snakemake", "--lint", "--snakefile", PROJECT / "Snakefile"]
    said = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True).stderr
    assert set(re.findall(r"^    \* (.*):$", said, re.MULTILINE)) == {
        "Mixed rules and functions in same snakefile.",
        "Shell command directly uses variable MARKERMEND from outside of the rule",
        "Param tables is a prefix of input or output file but hardcoded",
    }


def test_the_forge_runs_targets_of_the_makefile_with_every_python_that_the_package_names():
    jobs = yaml.safe_load((PROJECT / ".github/workflows/tests.yml").read_text(encoding="utf-8"))["jobs"]
    commands = [step["run"].split() for job in jobs.values() for step in job["steps"] if "run" in step]
    targets = re.findall(r"^([a-z-]+):", (PROJECT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
    assert {make for make, *_ in commands} == {"make"}
    assert (
        {target for _, target, *_ in commands} == {"test", "test-library", "test-set", "wheel", "docs"} <= set(targets)
    )
    package = tomllib.loads((PROJECT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    named = [text.rpartition(" :: ")[2] for text in package["classifiers"] if "Python :: 3." in text]
    assert jobs["all"]["strategy"]["matrix"]["python"] == named
    assert set(jobs["library"]["strategy"]["matrix"]["python"]) <= set(named)


def test_the_library_that_is_tested_elsewhere_is_all_that_knows_no_workflow():
    (listed,) = re.findall(r"^LIBRARY := (.*)$", (PROJECT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
    packages = {path.name for path in (PROJECT / "scripts/markermend").iterdir() if (path / "__init__.py").exists()}
    of_workflow = {"command", "evaluation", "planning", "report", "terminal"}
    assert {name for name in listed.split() if not name.endswith(".py")} == packages - of_workflow
