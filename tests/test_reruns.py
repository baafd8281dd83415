"""What a second run does: nothing, unless something that a result depends on has changed."""

import json
import os
import signal
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import yaml

from markermend import provenance
from workflow_runs import Project, write_recording

NOTHING = "Nothing to be done"
FAULT = """
import os, sys
if os.path.basename(sys.orig_argv[1]) == "repair.py":
    replace = os.replace
    def fail_once(source, target):
        os.replace = replace
        raise OSError(28, "No space left on device")
    os.replace = fail_once
"""


@pytest.fixture(scope="module")
def finished(tmp_path_factory) -> Project:
    """A project whose workflow has run: two recordings of one subject, and one of another."""
    project = Project(tmp_path_factory.mktemp("reruns"))
    for seed, name in enumerate(["S01/a", "S01/b", "S02/c"]):
        write_recording(project.recordings / f"{name}.c3d", seed=seed)
    project.run()
    return project


@contextmanager
def edited(path: Path, addition: str) -> Iterator[None]:
    """Append to a file, and take it back."""
    before = path.read_bytes()
    path.write_bytes(before + addition.encode())
    yield
    path.write_bytes(before)


def rules(stages):
    return {"export_c3d" if stage == "export" else stage for stage in stages}


def test_a_second_run_has_nothing_to_do_and_neither_has_one_after_a_touch(finished):
    assert NOTHING in finished.plan().text
    for path in [
        finished.recordings / "S01/a.c3d",
        *finished.results.glob("S01/**/0*"),
        *finished.folder.rglob("*.py"),
    ]:
        path.touch()
    assert NOTHING in finished.plan().text


@pytest.mark.parametrize("module", ["storage", "mesh_tree", "repair"])
def test_an_edited_module_reruns_the_stages_that_import_it(finished, module):
    path = finished.folder / "scripts" / "markermend" / f"{module}.py"
    scripts = finished.folder.glob("scripts/*.py")
    users = {script.stem for script in scripts if f"markermend/{module}.py" in str(provenance.code(script))}
    with edited(path, "\n# edited\n"):
        plan = finished.plan()
    assert plan.parameters_changed == rules(users - {"synthesize"})
    assert f"now: 'markermend/{module}.py:" in plan.text


def test_an_edited_script_reruns_its_stage_and_what_follows(finished):
    with edited(finished.folder / "scripts" / "fill.py", "\n# edited\n"):
        plan = finished.plan()
    assert plan.parameters_changed == {"fill"}
    assert plan.jobs == {"fill": 3, "export_c3d": 3, "qc": 3, "report": 1, "all": 1}


@pytest.mark.parametrize("stage", ["steps", "qc"])
def test_an_option_reruns_its_stage_and_what_follows(finished, stage, tmp_path):
    section = yaml.safe_load((finished.folder / "config/config.yaml").read_text())[stage]
    key, value = next((k, v) for k, v in section.items() if isinstance(v, int | float) and not isinstance(v, bool))
    (tmp_path / "study.yaml").write_text(yaml.safe_dump({stage: {key: value + 1}}))
    plan = finished.plan("--configfile", str(tmp_path / "study.yaml"))
    later = ["steps", "slow", "repair", "fill", "export_c3d", "qc"]
    assert plan.parameters_changed == {stage}
    assert plan.jobs == {**dict.fromkeys(later[later.index(stage) :], 3), "report": 1, "all": 1}


def test_an_added_recording_reruns_what_its_subject_shares_and_the_report(finished):
    write_recording(finished.recordings / "S02/new.c3d", seed=9)
    plan = finished.plan()
    (finished.recordings / "S02/new.c3d").unlink()
    detectors = ["peaks", "noise", "steps", "slow"]
    expected = dict.fromkeys([*detectors, "repair", "fill", "export_c3d", "qc"], 2)
    assert plan.jobs == {"ingest": 1, "mesh": 1, **expected, "report": 1, "all": 1}
    assert "S01" not in plan.text.partition("Building DAG")[2].replace("S01/a/08", "").replace("S01/b/08", "")


def test_a_failure_that_may_pass_is_tried_again_until_it_has_passed(finished, tmp_path):
    (tmp_path / "sitecustomize.py").write_text(FAULT)
    write_recording(tmp_path / "recordings/S01/a.c3d", seed=1)
    places = {"recordings": tmp_path / "recordings", "results": tmp_path / "results"}
    here = tmp_path / "results/S01/a"
    text = finished.run(environment={"PYTHONPATH": str(tmp_path)}, **places)
    assert "set aside: S01/a: repair failed: OSError: [Errno 28] No space left on device" in text
    assert (here / "failures.tsv").read_text().count("\n") == 1
    assert json.loads((here / "08_qc.json").read_text())["status"] == "set aside"

    assert finished.plan(**places).parameters_changed == {"repair"}
    assert "set aside" not in finished.run(**places).splitlines()[-2]
    assert json.loads((here / "08_qc.json").read_text())["status"] != "set aside"
    assert NOTHING in finished.plan(**places).text


def test_a_killed_run_is_finished_by_the_same_command_with_the_same_bytes(finished, tmp_path):
    results = tmp_path / "results"
    run = subprocess.Popen(
        finished.command(results=results),
        cwd=finished.folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    deadline = time.monotonic() + 120
    while not list(results.glob("*/*/02_peaks.parquet")) and time.monotonic() < deadline:
        time.sleep(0.02)
    os.killpg(run.pid, signal.SIGKILL)
    run.wait()
    assert not (results / "report/index.html").exists()

    finished.run(results=results)
    undisturbed, resumed = finished.outputs(), finished.outputs(results)
    left = {name for name in resumed.keys() - undisturbed.keys() if not Path(name).name.startswith(".")}
    assert not left
    assert {name: resumed[name] == content for name, content in undisturbed.items()} == dict.fromkeys(undisturbed, True)
