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
