"""The command `markermend`."""

import subprocess
import sys

from markermend.command import run_workflow
from support.paths import PROJECT


def test_arguments_go_to_snakemake_with_the_snakefile_of_the_workflow(monkeypatch):
    called = []
    monkeypatch.setattr(sys, "argv", ["markermend", "--cores", "1"])
    monkeypatch.setattr(subprocess, "call", lambda command: called.append(command) or 3)
    assert run_workflow.main() == 3
    assert called == [[sys.executable, "-m", "snakemake", "--snakefile", f"{PROJECT}/Snakefile", "--cores", "1"]]


def test_a_config_file_of_the_workflow_is_found_from_any_folder(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    name = "config/evaluate/quick.yaml"
    assert run_workflow.command(["--configfile", name])[-1] == str(PROJECT / name)
    (tmp_path / "config/evaluate").mkdir(parents=True)
    (tmp_path / name).touch()
    assert run_workflow.command(["--configfile", name, "config/mine.yaml"])[-2:] == [name, "config/mine.yaml"]


def test_results_are_checked_without_snakemake(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(sys, "argv", ["markermend", "verify", str(tmp_path)])
    assert run_workflow.main() == 2
    assert capsys.readouterr().err == f"{tmp_path} holds no results\n"
