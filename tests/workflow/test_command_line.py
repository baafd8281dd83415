"""The command `markermend` as people use it: a folder cleaned, looked at, and what went wrong said in a line."""

import os
import shutil
import subprocess
import sys

import pytest

from support.paths import PROJECT
from support.workflow_runs import Project, write_recording

COMMAND = "import sys; from markermend.terminal.command_line import main; sys.exit(main())"


def markermend(*words, status=0, cwd=None):
    """Run the command; gives what it shows."""
    environment = {**os.environ, "PYTHONPATH": str(PROJECT / "scripts"), "COLUMNS": "200"}
    done = subprocess.run(
        [sys.executable, "-c", COMMAND, *map(str, words)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env=environment,
        cwd=cwd,
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
    estimate, *lines, summary, aside, report = markermend("clean", recordings, "--results", results, "--cores", "2")
    assert estimate.startswith("3 recordings of 1 subject, 2 s of data: about ")
    assert sorted(line.partition(":")[0] for line in lines) == ["S01/a", "S01/b", "S01/c"]
    assert summary.startswith("3 recordings: 2 cleaned, 1 set aside; ")
    assert "S01/c" in aside
    assert report == f"Report: {results}/report/index.html"
    assert "Detect artifacts in S01/a" in (results / "report/logs/run.log").read_text()
    again = markermend("clean", recordings, "--results", results, "--cores", "2")
    assert again[0].endswith("; 3 of them have results, which are kept where nothing has changed")
    assert again[1:] == ["Nothing to be done: all results are up to date.", report]
    assert markermend("report", results)[0] == summary
    assert markermend("verify", results)[-1].endswith(" files are as they were, 0 differ")


def test_a_look_leaves_every_byte(recordings, tmp_path):
    markermend("look", recordings, "--results", tmp_path / "out", "--cores", "2")
    for name in "ab":
        cleaned = tmp_path / f"out/cleaned/S01/{name}.c3d"
        assert cleaned.read_bytes() == (recordings / f"S01/{name}.c3d").read_bytes()


def test_a_mistake_is_said_in_a_line(recordings, tmp_path):
    (tmp_path / "typo.yaml").write_text("fill:\n  max_gap: 1\n")
    lines = markermend(
        "clean", recordings, "--results", tmp_path / "out", "--options", tmp_path / "typo.yaml", status=1
    )
    assert "max_gap" in " ".join(lines) and "Traceback" not in " ".join(lines)
    (tmp_path / "empty").mkdir()
    lines = markermend("clean", tmp_path / "empty", "--results", tmp_path / "out", status=1)
    assert len(lines) == 1 and lines[0].startswith("recordings: no recording")


def test_originals_come_back_when_they_are_gone_and_results_have_moved(recordings, tmp_path):
    shutil.copytree(recordings, tmp_path / "data")
    markermend("clean", tmp_path / "data", "--results", tmp_path / "out", "--cores", "2")
    shutil.rmtree(tmp_path / "data")
    os.rename(tmp_path / "out", tmp_path / "mövd out")
    assert all(
        "the original, bit for bit" in line
        for line in markermend("undo", tmp_path / "mövd out", "--to", tmp_path / "back")
    )
    for name in "abc":
        [back] = (tmp_path / "back").rglob(f"{name}.c3d")
        assert back.read_bytes() == (recordings / f"S01/{name}.c3d").read_bytes()
    [line] = markermend("undo", tmp_path / "mövd out", "S01/a", "--to", tmp_path / "parts", "--markers", "M1")
    assert "10 samples restored (M1 41 to 50), " in line and " 1 stays cleaned: " in line


def test_a_table_is_made_corrected_and_cleaned(recordings, tmp_path):
    table = tmp_path / "recordings.tsv"
    markermend("table", recordings, "--to", table)
    rows = [row for row in table.read_text().splitlines() if not row.startswith("c\t")]
    table.write_text("\n".join(row.replace("S01\t", "Anna\t", 1) for row in rows), encoding="utf-8-sig")
    lines = markermend("clean", table, "--results", tmp_path / "out", "--cores", "2")
    assert lines[0].startswith("2 recordings of 1 subject") and (tmp_path / "out/Anna/a/08_qc.json").exists()


def test_the_module_is_the_command(tmp_path):
    environment = {**os.environ, "PYTHONPATH": str(PROJECT / "scripts")}
    shown = [
        subprocess.run(
            [sys.executable, *words, "presets"], capture_output=True, text=True, env=environment, check=True
        ).stdout
        for words in (["-m", "markermend"], ["-c", COMMAND])
    ]
    assert shown[0] == shown[1] != ""


@pytest.mark.parametrize(
    ("config", "said"),
    [
        ([], "recordings: which recordings? There is no such folder or table: {here}/config/recordings.tsv. Name the folder"),
        (["recordings=nowhere"], "recordings: there is no such folder or table: {here}/nowhere. Name the folder"),
        (["recordings=empty"], "recordings: no recording (.c3d, .trc, .csv, .tsv) in {here}/empty or below"),
        (["recordings=Snakefile"], "recordings: {here}/Snakefile has no column recording, subject, file"),
        (["recordings=empty", "protcet=[A]"], "protcet: there is no such key; did you mean protect?"),
        (["recordings=empty", "fill=3"], "fill: "),
    ],
)  # fmt: skip
def test_snakemake_by_itself_says_a_mistake_without_a_traceback(tmp_path, config, said):
    project = Project(tmp_path)
    (project.folder / "empty").mkdir()
    words = ["-m", "snakemake", "--dry-run", "--cores", "1", "--config", "results=out", *config]
    done = subprocess.run(
        [sys.executable, *words], cwd=project.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    assert done.returncode == 1 and said.format(here=project.folder) in done.stdout and "Traceback" not in done.stdout


def test_names_that_no_marker_has_are_said_before_and_after_a_run(recordings, tmp_path):
    (tmp_path / "own.yaml").write_text("protect: [m2, M3]\ndecisions: decisions.tsv\n")
    (tmp_path / "decisions.tsv").write_text("recording\tmarker\tdecision\na\tM33\tprotect\n")
    options = ["--options", tmp_path / "own.yaml", "--results", tmp_path / "out"]
    lines = markermend("look", recordings, *options, "--cores", "2", cwd=tmp_path)
    said = [line for line in lines if line.startswith(("protect", "decisions"))]
    assert said == 2 * [
        "protect: no recording has a marker m2; did you mean M2?",
        "decisions: S01/a has no marker M33; did you mean M3?",
    ]
