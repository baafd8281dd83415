"""The workflow as a whole: config, schema and flags in step; what is planned; recordings with any name and any content."""

import csv
import importlib.util
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from markermend.core.artifacts import DETECTORS
from markermend.options.config import SECTIONS
from markermend.options.flags import stage_options
from markermend.options.general import FINISHING
from support.workflow_runs import PROJECT, Project, write_recording

RULES = ("ingest", "mesh", "detect", "repair", "poses", "finish", "report")
TOGETHER = {"detect": DETECTORS, "finish": FINISHING}
STAGES = tuple(stage for rule in RULES for stage in TOGETHER.get(rule, [rule]))


def stage_of(name):
    spec = importlib.util.spec_from_file_location(f"script_{name}", PROJECT / "scripts" / f"{name}.py")
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    return script.STAGE


@pytest.mark.parametrize("name", STAGES)
def test_a_command_has_the_options_of_its_section(name):
    required = {action.dest for action in stage_of(name).parser._actions if action.required}
    files = {*stage_of(name).inputs, *stage_of(name).outputs}
    own = {option.name for option in stage_options(SECTIONS[name])}
    assert own <= required - files
    given = {
        **{stage: {"code"} for stage in DETECTORS},
        "ingest": {"recording", "subject", "kind", "rate", "unit", "sha256", "within"},
        "repair": {"decisions"},
        "fill": {"decisions", "code"},
        "export": {"decisions", "within", "code"},
        "qc": {"decisions", "code"},
    }
    assert required - files - own == given.get(name, set())


@pytest.fixture(scope="module")
def project(tmp_path_factory) -> Project:
    return Project(tmp_path_factory.mktemp("workflow"))


def test_a_folder_of_every_format_is_planned_whole(project):
    for name in ("S01/a.c3d", "S01/b.trc", "S02/day/c.csv", "S02/day/d.tsv", "S02/notes.txt"):
        (project.recordings / name).parent.mkdir(parents=True, exist_ok=True)
        (project.recordings / name).touch()
    plan = project.plan()
    every = dict.fromkeys(("ingest", "detect", "repair", "finish"), 4)
    assert plan.jobs == {**every, "mesh": 2, "poses": 2, "report": 1, "all": 1}
    assert "OMP_NUM_THREADS" not in plan.text


def test_on_a_cluster_every_stage_but_the_report_travels_in_a_group():
    profile = yaml.safe_load((PROJECT / "profiles/slurm/profile.yaml").read_text())
    groups = dict(entry.split("=") for entry in profile["groups"])
    assert set(groups) == {*RULES} - {"report"}
    assert {entry.split("=")[0] for entry in profile["group-components"]} == set(groups.values())


@pytest.mark.parametrize("missing", ["recordings", "table", "row"])
def test_recordings_that_are_not_there_are_named(project, tmp_path, missing):
    place = {"recordings": tmp_path / "none", "table": tmp_path / "none.tsv", "row": tmp_path / "recordings.tsv"}[
        missing
    ]
    (tmp_path / "recordings.tsv").write_text("recording\tsubject\tfile\tkind\nwalk\tBob\twalk.c3d\tdynamo\n")
    done = subprocess.run(
        project.command("-n", recordings=place),
        cwd=project.folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert done.returncode == 1
    if missing == "row":
        assert "line 2, column kind: 'dynamo' is none of auto, dynamic, static" in done.stdout
    else:
        assert f"no such folder or table: {place}" in done.stdout
    assert "Traceback" not in done.stdout


def test_results_that_cannot_be_written_are_named_in_one_line(project, tmp_path):
    (tmp_path / "file").touch()
    text = project.run("-n", status=1, results=tmp_path / "file/out")
    line = f"{tmp_path}/file/out was not written: a file stands where a folder must be"
    assert line in text and "Traceback" not in text


HOSTILE = [
    ("../{recording}", "$(touch pwned)`touch pwned`'\"<b>\nx", "it's {subject} $x.c3d"),
    ("../{recording}", "-n * ; touch pwned", "sub dir/b\n.c3d"),
    ("report", "mesh.json", "bad.c3d"),
]


@pytest.fixture(scope="module")
def hostile(project, tmp_path_factory):
    """A run without detectors, from another folder, over recordings with names and content that mean harm."""
    folder = tmp_path_factory.mktemp("it's a $(place)")
    for seed, (_, _, file) in enumerate(HOSTILE):
        write_recording(folder / file, seed=seed)
    (folder / "bad.c3d").write_text("not a recording")
    with open(folder / "recordings.tsv", "w", newline="", encoding="utf-8") as file:
        csv.writer(file, delimiter="\t").writerows([("subject", "recording", "file"), *HOSTILE])
    arguments = project.command("--snakefile", str(project.folder / "Snakefile"), "--printshellcmds", "--keep-going")
    arguments = [*arguments[: arguments.index("--config")], "--config", f"recordings={folder}/recordings.tsv"]
    done = subprocess.run(
        [*arguments, "results=out", "detect=[]"],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert done.returncode == 0, done.stdout
    return folder, done.stdout


def quality_of(folder):
    found = [json.loads(path.read_text()) for path in folder.glob("out/*/*/08_qc.json")]
    return {(quality["subject"], quality["recording"]): quality for quality in found}


def test_hostile_names_reach_the_results_and_nothing_else(hostile):
    folder, _ = hostile
    assert {path.name for path in (folder / "out").iterdir()} == {
        "%2E.%2F%7Brecording%7D",
        "%72eport",
        "cleaned",
        "report",
        ".snakemake",
    }
    quality = quality_of(folder)
    assert set(quality) == {(subject, recording) for subject, recording, _ in HOSTILE}
    assert [quality[subject, name]["status"] == "set aside" for subject, name, _ in HOSTILE] == [False, False, True]
    assert not list(folder.rglob("pwned"))
    # Each under its own name, and the one that is no recording as it is.
    cleaned = {str(path.relative_to(folder / "out/cleaned")) for path in (folder / "out/cleaned").rglob("*.c3d")}
    assert cleaned == {file for _, _, file in HOSTILE}


def test_a_bad_file_is_set_aside_with_its_reason_and_the_run_ends_well(hostile):
    folder, text = hostile
    lines = text.strip().splitlines()
    assert lines[-1] == f"Report: {folder}/out/report/index.html"
    assert re.search(r"^3 recordings: .*1 set aside", text, re.MULTILINE)
    reason = quality_of(folder)["report", "mesh.json"]["reason"]
    assert f"set aside: report/mesh.json: {reason}" in lines[-2]
    assert not list(folder.glob("out/*/*/failures.tsv"))


def test_detectors_that_are_not_wanted_leave_no_trace(hostile):
    folder, text = hostile
    assert {path.name[:2] for path in folder.glob("out/*/*/0*.parquet")} == {"01", "06", "07"}
    assert "detect.py" not in text


def test_a_logged_command_can_be_pasted_anywhere(hostile):
    folder, text = hostile
    path = next(folder.glob("out/%2E*/-n*/07_filled.parquet"))
    before = path.read_bytes()
    # The names of the files have ends of lines.
    (command,) = re.findall(
        r"Shell command: ([^\n]*/finish\.py (?:(?!/finish\.log).)*?/-n.*?/finish\.log'?)", text, re.DOTALL
    )
    path.unlink()
    # Last bits hang on which kernels the linear algebra uses, which a machine may set in the environment.
    environment = {name: value for name, value in os.environ.items() if name == "PATH" or name.startswith("OPENBLAS")}
    subprocess.run(["sh", "-c", command], cwd="/", env=environment, check=True)
    assert path.read_bytes() == before


def test_the_python_of_snakemake_runs_the_stages(hostile):
    assert f"Shell command: {Path(sys.executable)}" in hostile[1].replace("python3", "python").replace(
        "python.11", "python"
    )
