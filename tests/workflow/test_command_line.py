"""The command `markermend` as people use it: a folder cleaned, looked at, and what went wrong said in a line."""

import os
import subprocess
import sys

import pytest

from support.paths import PROJECT
from support.workflow_runs import write_recording

COMMAND = "import sys; from markermend.terminal.command_line import main; sys.exit(main())"


def markermend(*words, status=0):
    """Run the command; gives what it shows."""
    environment = {**os.environ, "PYTHONPATH": str(PROJECT / "scripts"), "COLUMNS": "200"}
    done = subprocess.run(
        [sys.executable, "-c", COMMAND, *map(str, words)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env=environment,
    )
    assert done.returncode == status, done.stdout
    return done.stdout.splitlines()


@pytest.fixture(scope="module")
def recordings(tmp_path_factory):
    """Two recordings, and a file that is none."""
    folder = tmp_path_factory.mktemp("data") / "recordings"
    for seed, name in enumerate("ab", start=1):
        write_recording(folder / f"S01/{name}.c3d", seed=seed)
    (folder / "S01/c.c3d").write_text("a,b\n1,2\n")
    return folder


def test_a_folder_is_cleaned_with_a_line_for_each_recording(recordings, tmp_path):
    results = tmp_path / "out"
    *lines, summary, aside, report = markermend("clean", recordings, "--results", results, "--cores", "2")
    assert sorted(line.partition(":")[0] for line in lines) == ["S01/a", "S01/b", "S01/c"]
    assert summary.startswith("3 recordings: 2 cleaned, 1 set aside; ")
    assert "S01/c" in aside
    assert report == f"Report: {results}/report/index.html"
    assert "Detect artifacts in S01/a" in (results / "report/logs/run.log").read_text()
    again = markermend("clean", recordings, "--results", results, "--cores", "2")
    assert again == ["Nothing to be done: all results are up to date."]
    assert markermend("report", results)[0] == summary
    assert markermend("verify", results)[-1].endswith(" files are as they were, 0 differ")


def test_a_look_leaves_every_byte(recordings, tmp_path):
    markermend("look", recordings, "--results", tmp_path / "out", "--cores", "2")
    for name in "ab":
        cleaned = tmp_path / f"out/S01/{name}/cleaned.c3d"
        assert cleaned.read_bytes() == (recordings / f"S01/{name}.c3d").read_bytes()


def test_a_mistake_is_said_in_a_line(recordings, tmp_path):
    (tmp_path / "typo.yaml").write_text("fill:\n  max_gap: 1\n")
    lines = markermend(
        "clean", recordings, "--results", tmp_path / "out", "--options", tmp_path / "typo.yaml", status=1
    )
    assert "max_gap" in " ".join(lines) and "Traceback" not in " ".join(lines)
    (tmp_path / "empty").mkdir()
    lines = markermend("clean", tmp_path / "empty", "--results", tmp_path / "out", status=1)
    assert lines[0].startswith("recordings: no recording") and len(lines) == 2
