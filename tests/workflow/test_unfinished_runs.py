"""Runs in which something fails: the others are finished, report and summary come, and nobody takes what is missing for done."""

import json

import pytest

from support.workflow_runs import Project, write_recording

PEAKS = ("--configfile", "peaks.yaml")

FAULTS = """
import os, sys
script = os.path.basename(sys.orig_argv[1]) if len(sys.orig_argv) > 1 else ""
if script == "ingest.py" and os.path.exists({vanishing!r}):
    os.unlink({vanishing!r})
if script == "finish.py" and "S01/full/" in " ".join(sys.orig_argv):
    def fail(source, target):
        raise OSError(28, "No space left on device")
    os.replace = fail
if script == "repair.py" and "S02/killed/" in " ".join(sys.orig_argv):
    os.kill(os.getpid(), 9)
"""

NO_REPORT = """
import os, sys
if os.path.basename(sys.orig_argv[1]) == "report.py":
    replace = os.replace
    def fail(source, target):
        if str(target).endswith(".html"):
            raise OSError(28, "No space left on device")
        replace(source, target)
    os.replace = fail
"""


@pytest.fixture(scope="module")
def ended(tmp_path_factory):
    """A run in which a recording vanishes after planning, one finds no room to write, and the process of one is killed."""
    folder = tmp_path_factory.mktemp("unfinished")
    project = Project(folder)
    (project.folder / "peaks.yaml").write_text("detect: [peaks]")
    for seed, name in enumerate(["S01/full", "S02/killed", "S03/vanishing", "S04/fine"]):
        write_recording(project.recordings / f"{name}.c3d", seed=seed)
    vanishing = project.recordings / "S03/vanishing.c3d"
    content = vanishing.read_bytes()
    (folder / "sitecustomize.py").write_text(FAULTS.format(vanishing=str(vanishing)))
    text = project.run(*PEAKS, environment={"PYTHONPATH": str(folder)}, status=1)
    vanishing.write_bytes(content)
    return project, text


def test_the_others_are_finished_and_the_summary_says_what_is_not(ended):
    project, text = ended
    assert "4 recordings: 1 cleaned, 1 set aside, 2 unfinished" in text
    assert "set aside: S03/vanishing: vanishing.c3d is gone since the run began" in text.replace("ingest failed: ", "")
    assert "not finished: S01/full: fill: " in text and "07_filled.parquet was not written: there is no room" in text
    assert f"not finished: S02/killed: see {project.results}/S02/killed/logs" in text
    assert json.loads((project.results / "S04/fine/08_qc.json").read_text())["status"] == "cleaned"
    assert (project.results / "cleaned/S04/fine.c3d").exists()


def test_the_report_comes_with_what_is_finished_and_names_the_rest(ended):
    project, text = ended
    assert text.strip().splitlines()[-1] == f"Report of what is finished: {project.results}/report/index.html"
    page = (project.results / "report/index.html").read_text()
    assert "Not finished: 2" in page and "<li>S01/full</li><li>S02/killed</li>" in page
    assert (project.results / "report/summary.tsv").read_text().count("\n") == 3


def test_a_report_that_lacks_recordings_is_made_again_even_without_them(ended):
    project, _ = ended
    left = [project.recordings / name for name in ("S01/full.c3d", "S02/killed.c3d")]
    contents = [path.read_bytes() for path in left]
    for path in left:
        path.unlink()
    assert "2 recordings: 2 cleaned;" in project.run(*PEAKS)
    assert "Not finished" not in (project.results / "report/index.html").read_text()
    for path, content in zip(left, contents, strict=True):
        path.write_bytes(content)


def test_the_same_command_finishes_the_run_and_a_report_that_fails_is_no_success(ended, tmp_path):
    project, _ = ended
    (tmp_path / "sitecustomize.py").write_text(NO_REPORT)
    text = project.run(*PEAKS, environment={"PYTHONPATH": str(tmp_path)}, status=1)
    assert "4 recordings: 4 cleaned;" in text and "set aside" not in text.partition("4 recordings:")[2]
    line = text.strip().splitlines()[-1]
    assert line.startswith(f"The report was not written: {project.results}/report/index.html: report: ")
    assert "there is no room" in line and not (project.results / "report/index.html").exists()
    assert "Report: " in project.run(*PEAKS).strip().splitlines()[-1]
    assert "Not finished" not in (project.results / "report/index.html").read_text()
