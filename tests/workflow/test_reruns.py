"""What a second run does: nothing, unless something that a result depends on has changed."""

import csv
import json
import os
import re
import shutil
import signal
import subprocess
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import yaml

from markermend.core.artifacts import DETECTORS
from markermend.options.general import FINISHING
from markermend.planning import code_hashes
from markermend.storage import stage_files
from support.workflow_runs import Project, write_recording

CHAIN = ["ingest", "mesh", "detect", "repair", "finish", "report"]
NOTHING = "Nothing to be done"
FAULT = """
import os, sys
if os.path.basename(sys.orig_argv[1]) == "repair.py":
    replace = os.replace
    def fail_once(source, target):
        os.replace = replace
        raise MemoryError
    os.replace = fail_once
"""
NO_ROOM = """
import os, sys
if os.path.basename(sys.orig_argv[1]) == "finish.py":
    def fail(source, target):
        raise OSError(28, "No space left on device")
    os.replace = fail
"""


@pytest.fixture(scope="module")
def finished(tmp_path_factory) -> Project:
    """A project whose workflow has run, on a recording of each of two subjects."""
    project = Project(tmp_path_factory.mktemp("reruns"))
    for seed, name in enumerate(["S01/a", "S02/b"]):
        write_recording(project.recordings / f"{name}.c3d", seed=seed)
    project.run()
    return project


@contextmanager
def edited(path: Path, addition: str) -> Iterator[None]:
    """Append to a file, and take it back."""
    before = path.read_bytes()
    path.write_bytes(before + addition.encode())
    try:
        yield
    finally:
        path.write_bytes(before)


def changes(project: Project, recording: str) -> list[dict[str, str]]:
    """The table of changes of one recording."""
    with open(project.results / recording / "changes.tsv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file, delimiter="\t"))


def places(rows: Iterable[dict[str, str]]) -> list[tuple[str, ...]]:
    """What changed where."""
    return [tuple(row[name] for name in ("marker", "first_frame", "last_frame", "class")) for row in rows]


def scripts(rule):
    """The scripts that a job of a rule runs."""
    return [rule, *{"detect": DETECTORS, "finish": FINISHING}.get(rule, ())]


def code_of(project, rule):
    return str([code_hashes.code(project.folder / f"scripts/{script}.py") for script in scripts(rule)])


def test_a_second_run_has_nothing_to_do_and_neither_has_one_after_a_touch(finished):
    assert NOTHING in finished.plan().text
    for path in [
        finished.recordings / "S01/a.c3d",
        *finished.results.glob("S01/**/0*"),
        *finished.folder.rglob("*.py"),
    ]:
        path.touch()
    assert NOTHING in finished.plan().text


def test_an_original_is_recognised_by_its_content_whatever_its_date_or_name(finished, tmp_path):
    """As after `cp -p` or `rsync -a` of another recording, and after two recordings exchanged their names."""
    a, b, kept = finished.recordings / "S01/a.c3d", finished.recordings / "S02/b.c3d", tmp_path / "kept.c3d"
    write_recording(tmp_path / "other.c3d", seed=7)
    os.utime(tmp_path / "other.c3d", (10**9, 10**9))
    shutil.copy2(a, kept)
    shutil.copy2(tmp_path / "other.c3d", a)
    replaced = finished.plan()
    shutil.copy2(kept, a)
    assert replaced.jobs == {**dict.fromkeys([*CHAIN, "all"], 1)}
    assert replaced.parameters_changed == {"ingest"}
    assert NOTHING in finished.plan().text
    a.rename(tmp_path / "aside.c3d")
    b.rename(a)
    (tmp_path / "aside.c3d").rename(b)
    exchanged = finished.plan()
    a.rename(tmp_path / "aside.c3d")
    b.rename(a)
    (tmp_path / "aside.c3d").rename(b)
    assert exchanged.jobs == {**dict.fromkeys(CHAIN[:-1], 2), "report": 1, "all": 1}
    assert NOTHING in finished.plan().text


@pytest.mark.parametrize(
    "module",
    [
        "markermend/storage/stage_files.py",
        "markermend/mesh/segment_tree.py",
        "markermend/detection/tails.py",
        "markermend/export/write_back.py",
        "fill.py",
    ],
)
def test_an_edit_reruns_the_first_stage_that_uses_the_module_and_what_follows(finished, module):
    users = [rule for rule in CHAIN if module in code_of(finished, rule)]
    with edited(finished.folder / "scripts" / module, "\n# edited\n"):
        plan = finished.plan()
    assert plan.parameters_changed == {users[0]}
    assert set(plan.jobs) == {*CHAIN[CHAIN.index(users[0]) :], "all"}
    assert f"code changed since the last run: {module} (of " in plan.text


@pytest.mark.parametrize(
    ("rule", "change"),
    [
        ("detect", {"steps": {"threshold_sigmas": 7.5}}),
        ("detect", {"advanced": {"steps": {"paper": {"window_s": 0.2}}}}),
        ("finish", {"qc": {"plots": 7}}),
    ],
)
def test_an_option_reruns_its_job_and_what_follows(finished, rule, change, tmp_path):
    (tmp_path / "study.yaml").write_text(yaml.safe_dump(change))
    plan = finished.plan("--configfile", str(tmp_path / "study.yaml"))
    assert plan.parameters_changed == {rule}
    assert plan.jobs == {**dict.fromkeys(CHAIN[CHAIN.index(rule) : -1], 2), "report": 1, "all": 1}


def test_an_option_of_a_detector_reruns_it_and_no_detector_before(finished, tmp_path):
    before = finished.outputs()
    (tmp_path / "study.yaml").write_text(yaml.safe_dump({"slow": {"threshold_sigmas": 7.5}}))
    finished.run("--configfile", str(tmp_path / "study.yaml"))
    log = (finished.results / "S01/a/logs/detect.log").read_text()
    kept = re.findall(r"^INFO (\w+): the outputs are kept", log, re.MULTILINE)
    assert kept == [stage for stage in DETECTORS if stage != "slow"]
    assert NOTHING in finished.plan("--configfile", str(tmp_path / "study.yaml")).text
    finished.run()
    assert finished.outputs() == before and NOTHING in finished.plan().text


def test_an_option_of_the_page_keeps_what_was_filled_and_written(finished, tmp_path):
    before = finished.outputs()
    (tmp_path / "study.yaml").write_text(yaml.safe_dump({"qc": {"plots": 7}}))
    finished.run("--configfile", str(tmp_path / "study.yaml"))
    log = (finished.results / "S01/a/logs/finish.log").read_text()
    assert re.findall(r"^INFO (\w+): the outputs are kept", log, re.MULTILINE) == ["fill", "export"]
    finished.run()
    assert finished.outputs() == before and NOTHING in finished.plan().text


def test_events_of_a_detector_can_be_asked_for_and_of_one_that_is_off_are_not_read(finished, tmp_path):
    (tmp_path / "study.yaml").write_text(yaml.safe_dump({"detect": ["frozen", "peaks"]}))
    given = ("--configfile", str(tmp_path / "study.yaml"))
    slow = finished.results / "S01/a/05_slow.parquet"
    before = slow.read_bytes()
    assert finished.plan(str(finished.results / "S01/a/02_peaks.parquet"), *given).jobs == {"detect": 1}
    slow.write_text("not events")
    finished.run(*given)
    assert "05_slow" not in (finished.results / "S01/a/logs/repair.json").read_text()
    facts = stage_files.read_facts(finished.results / "S01/a/06_repaired.parquet")
    assert len(facts["inputs"]["events"]) == 2
    finished.run()
    assert slow.read_bytes() == before


def test_a_run_that_is_started_in_another_folder_notices_the_same(finished, tmp_path):
    (tmp_path / "study.yaml").write_text(yaml.safe_dump({"steps": {"threshold_sigmas": 7.5}}))
    here = finished.command("--dry-run", "--snakefile", str(finished.folder / "Snakefile"))
    for arguments, expected in (
        ((), NOTHING),
        (("--configfile", "study.yaml"), r"changed since last execution:\n\s+detect"),
    ):
        done = subprocess.run(
            [*here, *arguments], cwd=tmp_path, stderr=subprocess.STDOUT, stdout=subprocess.PIPE, text=True, check=True
        )
        assert re.search(expected, done.stdout)


def test_an_added_recording_reruns_what_its_subject_shares_and_the_report(finished):
    write_recording(finished.recordings / "S02/new.c3d", seed=9)
    plan = finished.plan()
    (finished.recordings / "S02/new.c3d").unlink()
    assert plan.jobs == {"ingest": 1, "mesh": 1, **dict.fromkeys(CHAIN[2:-1], 2), "poses": 1, "report": 1, "all": 1}
    assert "S01" not in plan.text.partition("Building DAG")[2].replace("S01/a/08", "")


def test_a_decision_reruns_its_recording_alone_and_is_followed(finished):
    found = changes(finished, "S01/a")
    peak = next(row for row in found if row["class"] == "peak")
    untouched = changes(finished, "S02/b")
    line = "\t".join(
        [*(peak[name] for name in ("recording", "marker", "first_frame", "last_frame")), "reject\tpeak\thop"]
    )
    with edited(finished.folder / "config/decisions.tsv", f"{line}\n"):
        plan = finished.plan()
        assert plan.jobs == {**dict.fromkeys(("repair", "finish", "report", "all"), 1)}
        assert plan.parameters_changed == {"repair"}
        finished.run()
        assert places(changes(finished, "S01/a")) == places(row for row in found if row != peak)
        assert changes(finished, "S02/b") == untouched
        page = (finished.results / "S01/a/page.html").read_text()
        assert "a person decided: reject peak (hop)" in page and '<table id="decided">' in page
        sign(finished, line)
        with edited(finished.folder / "config/decisions.tsv", "b\tM1\t41\t50\treject\tgap\n"):
            assert finished.plan().jobs == plan.jobs
        assert NOTHING in finished.plan().text
    finished.run()
    assert changes(finished, "S01/a") == found


def sign(finished: Project, line: str) -> None:
    """Give a line that was followed another note, and the name of a person: it is stated, and nothing is computed again."""
    folder, table = finished.results / "S01/a", finished.folder / "config/decisions.tsv"
    cleaned = (finished.results / "cleaned/S01/a.c3d").read_bytes()
    signed = line.replace("hop", "taped") + "\t\t李 L.\t2026-03-31"
    table.write_text(table.read_text().replace(line, signed))
    assert finished.plan().jobs == dict.fromkeys(("finish", "report", "all"), 1)
    finished.run()
    assert "fill: the outputs are kept" in (folder / "logs/finish.log").read_text()
    assert (finished.results / "cleaned/S01/a.c3d").read_bytes() == cleaned
    assert (
        "reject peak (taped; 李 L., 2026-03-31)"
        in (folder / "changes.tsv").read_text() + (folder / "page.html").read_text()
    )
    assert "a person decided: reject peak (taped; 李 L., 2026-03-31)" in (folder / "page.html").read_text()
    assert "treated as decided by 李 L. (2026-03-31)." in (finished.results / "report/index.html").read_text()


def test_a_decision_on_a_recording_that_is_not_there_is_kept_in_the_report(finished):
    with edited(finished.folder / "config/decisions.tsv", "gone\tM1\t1\t5\treject\n"):
        plan = finished.plan()
    assert plan.jobs == {"report": 1, "all": 1} and plan.parameters_changed == {"report"}


def test_a_table_of_decisions_that_contradicts_itself_stops_before_anything_runs(finished):
    path = finished.folder / "config/decisions.tsv"
    with edited(path, "a\tM1\t1\t5\taccept\nb\tM1\t5\t7\tacept\na\tM*\t5\t7\treject\n"):
        done = subprocess.run(
            finished.command("-n"), cwd=finished.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
    assert done.returncode == 1 and "Traceback" not in done.stdout
    assert f"decisions: {path} cannot be used" in done.stdout
    assert "line 3, column decision: 'acept' is none of" in done.stdout
    assert "lines 2 and 4 contradict each other: M1 accept, M* reject" in done.stdout


def test_a_table_of_decisions_that_was_named_must_be_there(finished, tmp_path):
    (tmp_path / "study.yaml").write_text(yaml.safe_dump({"decisions": str(tmp_path / "none.tsv")}))
    done = subprocess.run(
        finished.command("-n", "--configfile", str(tmp_path / "study.yaml")),
        cwd=finished.folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert done.returncode == 1 and f"{tmp_path}/none.tsv" in done.stdout and "Traceback" not in done.stdout
    (tmp_path / "study.yaml").write_text(yaml.safe_dump({"decisions": None}))
    assert NOTHING in finished.plan("--configfile", str(tmp_path / "study.yaml")).text


def test_a_failure_that_may_pass_is_tried_again_until_it_has_passed(finished, tmp_path):
    (tmp_path / "sitecustomize.py").write_text(FAULT)
    write_recording(tmp_path / "recordings/S01/a.c3d", seed=1)
    places = {"recordings": tmp_path / "recordings", "results": tmp_path / "results"}
    here = tmp_path / "results/S01/a"
    text = finished.run(environment={"PYTHONPATH": str(tmp_path)}, **places)
    assert "set aside: S01/a: repair failed: not enough memory: run fewer recordings at once" in text
    assert (here / "failures.tsv").read_text().count("\n") == 1
    assert json.loads((here / "08_qc.json").read_text())["status"] == "set aside"

    assert finished.plan(**places).parameters_changed == {"repair"}
    assert "set aside" not in finished.run(**places)
    assert json.loads((here / "08_qc.json").read_text())["status"] != "set aside"
    assert NOTHING in finished.plan(**places).text


def test_results_that_are_gone_are_made_anew(finished):
    before = finished.outputs()
    for name in ("S01/a/changes.tsv", "S02/b/page.html", "cleaned/S02/b.c3d"):
        (finished.results / name).unlink()
    assert finished.plan().parameters_changed == {"finish"}
    finished.run()
    assert finished.outputs() == before and NOTHING in finished.plan().text


def test_after_a_run_that_failed_the_plan_names_the_module_still(finished, tmp_path):
    (tmp_path / "sitecustomize.py").write_text(NO_ROOM)
    with edited(finished.folder / "scripts/fill.py", "\n# edited\n"):
        text = finished.run(environment={"PYTHONPATH": str(tmp_path)}, status=1)
        assert "code changed since the last run: fill.py (of fill)" in text
        assert "code changed since the last run: fill.py (of fill)" in finished.plan().text
    assert "code changed" not in finished.run()


def test_a_part_of_a_run_says_what_it_did_and_the_last_one_writes_the_report(finished, tmp_path):
    results = tmp_path / "results"
    text = finished.run("--batch", "report=1/2", results=results)
    assert "1 recording: 1 cleaned" in text and "not finished" not in text
    assert text.strip().splitlines()[-1] == "This part of the run is closed; the last part writes the report."
    assert "Report: " in finished.run("--batch", "report=2/2", results=results).strip().splitlines()[-1]
    undisturbed, parts = finished.outputs(), finished.outputs(results)
    assert {name: parts[name] == content for name, content in undisturbed.items()} == dict.fromkeys(undisturbed, True)


def damage(path: Path) -> None:
    """Flip one bit in the middle of a file, and keep its date."""
    content, file = bytearray(path.read_bytes()), path.stat()
    content[len(content) // 2] ^= 1
    path.write_bytes(content)
    os.utime(path, ns=(file.st_atime_ns, file.st_mtime_ns))


def test_a_damaged_file_is_made_anew_and_alters_no_result(finished):
    before = finished.outputs()
    for name in ("05_slow.parquet", "06_repaired.parquet", "07_changes.parquet"):
        damage(finished.results / "S01/a" / name)
    finished.run("--forcerun", "finish")
    assert finished.outputs() == before
    logs = "".join(path.read_text() for path in (finished.results / "S01/a/logs").glob("*.log"))
    assert "06_repaired.parquet is damaged: running repair once more" in logs


def test_a_damaged_file_of_a_subject_is_made_anew_by_the_next_run(finished):
    before = finished.outputs()
    damage(finished.results / "S01/mesh.json")
    text = finished.run("--forcerun", "detect")
    assert (
        "set aside: S01/a: mesh.json is not as mesh wrote it: the file is damaged; the next run makes it anew" in text
    )
    assert "set aside" not in finished.run()
    assert {name: content for name, content in finished.outputs().items() if name in before} == before
    assert NOTHING in finished.plan().text


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
