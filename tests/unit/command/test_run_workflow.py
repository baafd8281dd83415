"""Snakemake with the Snakefile of the workflow."""

import subprocess
import sys

import pytest

from markermend.command import run_workflow
from support.paths import PROJECT


def test_arguments_go_to_snakemake_with_the_snakefile_of_the_workflow(monkeypatch):
    called = []
    monkeypatch.setattr(subprocess, "call", lambda command: called.append(command) or 3)
    assert run_workflow.run(["--cores", "1"]) == 3
    assert called == [[sys.executable, "-m", "snakemake", "--snakefile", f"{PROJECT}/Snakefile", "--cores", "1"]]


def test_a_config_file_of_the_workflow_is_found_from_any_folder(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    name = "config/evaluate/quick.yaml"
    assert run_workflow.command(["--configfile", name])[-1] == str(PROJECT / name)
    assert run_workflow.command(["--profile", "profiles/slurm"])[-1] == str(PROJECT / "profiles/slurm")
    (tmp_path / "config/evaluate").mkdir(parents=True)
    (tmp_path / name).touch()
    assert run_workflow.command(["--configfile", name, "config/mine.yaml"])[-2:] == [name, "config/mine.yaml"]


@pytest.mark.parametrize(
    "words", [["--configfile", "none.yaml"], ["--configfile=none.yaml"], ["--configfile", "a.yaml", "none.yaml"]]
)
def test_a_config_file_that_is_not_there_is_named_in_one_line(monkeypatch, tmp_path, capsys, words):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.yaml").write_text("fill: {max_gap_s: 1}")
    monkeypatch.setattr(subprocess, "call", lambda command: pytest.fail("Snakemake was called"))
    assert run_workflow.run(["--cores", "1", *words, "--config", "recordings=none"]) == 1
    assert capsys.readouterr().err == (
        "none.yaml cannot be read as a file of options (No such file or directory): name one by its path, such as study.yaml\n"
    )


@pytest.mark.parametrize("text", ["", "\n", "# fill:\n#   max_gap_s: 1\n"])
def test_a_config_file_without_options_is_named_in_one_line(monkeypatch, tmp_path, capsys, text):
    (tmp_path / "study.yaml").write_text(text)
    monkeypatch.setattr(subprocess, "call", lambda command: pytest.fail("Snakemake was called"))
    assert run_workflow.run(["--configfile", str(tmp_path / "study.yaml")]) == 1
    assert capsys.readouterr().err == f"{tmp_path}/study.yaml holds no options: write some into it, or leave it out\n"
