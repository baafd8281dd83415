"""Filling, export and quality in one process do what their commands do, each with its own record, reasons and right to keep what it wrote."""

import json
import shlex
import shutil
import subprocess
from importlib import import_module

import pytest

import finish
import ingest
import mesh
import repair
from markermend.core.recording import BadRecording
from markermend.options.config import read_config
from markermend.options.flags import flags, write_flags
from markermend.options.general import FINISHING
from markermend.storage import output_checksums
from support.paths import PROJECT
from support.workflow_runs import write_recording

WRITTEN = {
    "fill": ["07_filled.parquet", "07_changes.parquet"],
    "export": ["changes.tsv", "originals.parquet", "certificate.json", "../../cleaned/day 1/walk.c3d"],
    "qc": ["08_qc.json", "page.html"],
}


@pytest.fixture(scope="module")
def repaired(tmp_path_factory):
    """A recording with a gap and a peak, up to repair, in a folder of results beside it; nothing was looked for."""
    top = tmp_path_factory.mktemp("finishing")
    write_recording(top / "day 1/walk.c3d", seed=1)
    sections, folder = read_config({"detect": []}), top / "results/S01/walk"

    def options(name):
        return shlex.split(write_flags(sections[name]))

    known = ["--recording=walk", "--subject=S01", "--kind=dynamic", "--rate=none", "--unit=none", "--sha256=none"]
    source = ["--source", str(top / "day 1/walk.c3d"), "--within", "none"]
    markers, body = str(folder / "01_markers.parquet"), str(folder.parent / "mesh.json")
    ingest.main([*source, "--markers", markers, *known, *options("ingest")])
    mesh.main(["--markers", markers, "--mesh-files", "--mesh", body, *options("mesh")])
    done = ["--repaired", str(folder / "06_repaired.parquet"), "--changes", str(folder / "06_changes.parquet")]
    repair.main(["--markers", markers, "--mesh", body, "--events", *done, *options("repair"), "--decisions=[]"])
    return top


@pytest.fixture
def folder(repaired, tmp_path):
    """The folder of the recording, in a copy."""
    shutil.copytree(repaired, tmp_path, dirs_exist_ok=True)
    return tmp_path / "results/S01/walk"


@pytest.fixture
def worked(monkeypatch):
    """The stages that worked, and did not keep what they wrote before."""
    seen = []
    for stage in FINISHING:
        script = import_module(stage)

        def work(call, work=script.work):
            seen.append(call.facts["stage"])
            return work(call)

        monkeypatch.setattr(script, "work", work)
    return seen


def run(folder, *, config=None, codes=None, decisions=()):
    """Run the command."""
    sections, top = read_config({"detect": [], **(config or {})}), folder.parents[2]
    given = {stage: [f"--code={(codes or {}).get(stage, '')}", *flags(sections[stage])] for stage in FINISHING}
    (top / "stages.json").write_text(json.dumps(given))
    own = {
        "source": top / "day 1/walk.c3d",
        "markers": folder / "01_markers.parquet",
        "mesh": folder.parent / "mesh.json",
        "repaired": folder / "06_repaired.parquet",
        "repairs": folder / "06_changes.parquet",
        "filled": folder / "07_filled.parquet",
        "changes": folder / "07_changes.parquet",
        "cleaned": folder / "../../cleaned/day 1/walk.c3d",
        "table": folder / "changes.tsv",
        "originals": folder / "originals.parquet",
        "certificate": folder / "certificate.json",
        "qc": folder / "08_qc.json",
        "page": folder / "page.html",
        "stages": top / "stages.json",
    }
    files = [word for name, path in own.items() for word in (f"--{name}", str(path))]
    finish.main([*files, "--events", "--poses", "--trc", "--within", "none", "--decisions", json.dumps(decisions)])


def content(folder):
    return {name: (folder / name).read_bytes() for names in WRITTEN.values() for name in names}


def test_each_stage_gives_the_bytes_of_the_command_that_its_record_names(folder):
    run(folder)
    before = content(folder)
    assert json.loads(before["certificate.json"])["changed_samples"] > 0
    for stage, names in WRITTEN.items():
        record = output_checksums.read(folder, stage)
        assert record.command[1] == str(PROJECT / f"scripts/{stage}.py") and sorted(record.outputs) == sorted(names)
        for name in names:
            (folder / name).unlink()
        subprocess.run(record.command, check=True, capture_output=True)
        assert content(folder) == before and output_checksums.read(folder, stage) == record


def test_a_stage_works_again_only_on_something_else(folder, worked):
    run(folder)
    run(folder)
    assert worked == list(FINISHING)
    run(folder, config={"qc": {"plots": 7}})
    assert worked == [*FINISHING, "qc"]
    run(folder, config={"qc": {"plots": 7}}, codes={"export": "edited"})
    # What was written has the same bytes.
    assert worked == [*FINISHING, "qc", "export"]


def test_another_remark_on_a_decision_fills_nothing_again(folder, worked):
    protect = {"marker": "M1", "decision": "protect", "note": "hop"}
    run(folder, decisions=[protect])
    before = content(folder)
    run(folder, decisions=[{**protect, "by": "A.L.", "date": "2026-03-31"}])
    assert worked == [*FINISHING, "export", "qc"]
    after = content(folder)
    assert all(after[name] == before[name] for name in (*WRITTEN["fill"], "../../cleaned/day 1/walk.c3d"))
    assert b"A.L." in after["page.html"]


def test_what_is_gone_or_damaged_is_made_anew(folder, worked):
    run(folder)
    before = content(folder)
    (folder / WRITTEN["export"][-1]).write_bytes(b"edited")
    (folder / "page.html").unlink()
    run(folder)
    assert worked == [*FINISHING, "export", "qc"] and content(folder) == before


def test_a_recording_that_one_stage_cannot_use_is_passed_through_by_those_after_it(folder, monkeypatch):
    def fail(call):
        raise BadRecording("no such markers")

    monkeypatch.setattr(import_module("fill"), "work", fail)
    run(folder)
    assert json.loads((folder / "08_qc.json").read_text())["reason"] == "no such markers"
    assert (folder / WRITTEN["export"][-1]).read_bytes() == (folder.parents[2] / "day 1/walk.c3d").read_bytes()


def test_a_stage_that_cannot_write_ends_the_command(folder):
    (folder / "07_filled.parquet").mkdir()
    with pytest.raises(SystemExit) as end:
        run(folder)
    assert end.value.code == 1 and not (folder / "certificate.json").exists()
