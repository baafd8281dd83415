"""The workflow as a whole: config, schema and flags in step; what is planned; recordings with any name and any content."""

import copy
import csv
import functools
import importlib.util
import json
import operator
import os
import re
import subprocess
import sys
from pathlib import Path

import jsonschema
import pytest
import yaml

from support.workflow_runs import PROJECT, Project, write_recording

STAGES = (
    "ingest", "mesh", "labels", "frozen", "tails", "peaks", "noise", "steps", "slow", "repair", "fill", "export", "qc", "report",
)  # fmt: skip
PER_RECORDING = {"ingest": {"recording", "subject", "kind", "rate"}}
NO_OPTIONS = {"mesh": {"files"}}
CONFIG = yaml.safe_load((PROJECT / "config/config.yaml").read_text())
SCHEMA = yaml.safe_load((PROJECT / "workflow/schemas/config.schema.yaml").read_text())


def stage_of(name):
    spec = importlib.util.spec_from_file_location(f"script_{name}", PROJECT / "scripts" / f"{name}.py")
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    return script.STAGE


def keys(schema):
    for name, part in schema.get("properties", {}).items():
        yield name
        yield from keys(part)


@pytest.mark.parametrize("name", STAGES)
def test_options_config_and_schema_are_in_step(name):
    section = set(CONFIG[name])
    assert set(SCHEMA["properties"][name].get("properties", {})) == section
    shared = CONFIG.keys() - {"recordings", "results", "detect", *STAGES}
    own = set(stage_of(name).options) - PER_RECORDING.get(name, set()) - shared
    assert own == section - NO_OPTIONS.get(name, set())


def test_the_schema_is_closed_complete_and_explained():
    jsonschema.validate(CONFIG, SCHEMA)

    def check(schema, name):
        schema = SCHEMA["$defs"][schema["$ref"].rpartition("/")[2]] if "$ref" in schema else schema
        if "properties" in schema:
            assert schema["additionalProperties"] is False, name
            assert set(schema["required"]) == set(schema["properties"]), name
            for key, part in schema["properties"].items():
                check(part, f"{name}.{key}")
        elif schema.get("type") != "object" or name.count(".") > 1:
            assert len(schema["description"]) > 10, name

    check(SCHEMA, "config")
    for wrong in ({"surprise": 1}, {"mesh": {**CONFIG["mesh"], "surprise": 1}}, {"detect": ["swaps"]}, {"results": ""}):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate({**CONFIG, **wrong}, SCHEMA)


@pytest.mark.parametrize(("wrong", "words"), [({"input": 8}, "'input' was unexpected"), ({"anchors": 2}, "2 is less")])
@pytest.mark.parametrize("place", ["slow.default.ridge", "repair.separation.ridges", "fill.variants"])
def test_changes_to_the_local_ridge_are_held_to_its_settings(place, wrong, words):
    config = copy.deepcopy(CONFIG)
    *parents, last = place.split(".")
    section = functools.reduce(operator.getitem, parents, config)
    section[last] = {"ridge": wrong, "ridges": [{}, wrong], "variants": {"other": wrong}}[last]
    with pytest.raises(jsonschema.ValidationError, match=words):
        jsonschema.validate(config, SCHEMA)


def test_a_step_is_never_measured_by_a_threshold_of_nothing():
    config = copy.deepcopy(CONFIG)
    config["steps"]["default"]["joint"] = 0
    with pytest.raises(jsonschema.ValidationError, match="0 is less"):
        jsonschema.validate(config, SCHEMA)


@pytest.mark.parametrize("name", CONFIG)
def test_every_key_is_explained_to_people(name):
    text = (PROJECT / "config/README.md").read_text()
    nested = isinstance(CONFIG[name], dict)
    part = text.partition(f"\n## `{name}`")[2].partition("\n## ")[0] if nested else text.partition("\n## General")[2]
    assert set(keys(SCHEMA["properties"][name]) if nested else [name]) <= set(
        re.findall(r"^\| `(\w+)` \|", part, re.MULTILINE)
    )


@pytest.fixture(scope="module")
def project(tmp_path_factory) -> Project:
    return Project(tmp_path_factory.mktemp("workflow"))


def test_a_folder_of_every_format_is_planned_whole(project):
    for name in ("S01/a.c3d", "S01/b.trc", "S02/day/c.csv", "S02/day/d.tsv", "S02/notes.txt"):
        (project.recordings / name).parent.mkdir(parents=True, exist_ok=True)
        (project.recordings / name).touch()
    plan = project.plan()
    every = dict.fromkeys((*STAGES[2 : STAGES.index("export")], "qc", "ingest"), 4)
    exports = dict.fromkeys(["export_c3d", "export_trc", "export_csv", "export_tsv"], 1)
    assert plan.jobs == {**every, **exports, "mesh": 2, "report": 1, "all": 1}
    assert "OMP_NUM_THREADS" not in plan.text


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
        assert "recordings[0].kind: 'dynamo' is not one of ['auto', 'dynamic', 'static']" in done.stdout
    else:
        assert f"no such folder or table: {place}" in done.stdout
    assert "Traceback" not in done.stdout


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
    assert {path.name for path in (folder / "out").iterdir()} == {"%2E.%2F%7Brecording%7D", "%72eport", "report"}
    quality = quality_of(folder)
    assert set(quality) == {(subject, recording) for subject, recording, _ in HOSTILE}
    assert [quality[subject, name]["status"] == "set aside" for subject, name, _ in HOSTILE] == [False, False, True]
    assert not list(folder.rglob("pwned"))


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
    assert "peaks.py" not in text


def test_a_logged_command_can_be_pasted_anywhere(hostile):
    folder, text = hostile
    path = next(folder.glob("out/%2E*/-n*/07_filled.parquet"))
    before = path.read_bytes()
    command = next(line for line in text.splitlines() if "fill.py" in line and "/-n" in line).partition(
        "Shell command: "
    )[2]
    path.unlink()
    # Last bits hang on which kernels the linear algebra uses, which a machine may set in the environment.
    environment = {name: value for name, value in os.environ.items() if name == "PATH" or name.startswith("OPENBLAS")}
    subprocess.run(["sh", "-c", command], cwd="/", env=environment, check=True)
    assert path.read_bytes() == before


def test_the_python_of_snakemake_runs_the_stages(hostile):
    assert f"Shell command: {Path(sys.executable)}" in hostile[1].replace("python3", "python").replace(
        "python.11", "python"
    )
