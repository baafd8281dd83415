"""The data set of a run, asked as the rules ask it."""

import json
import os
from pathlib import Path
from types import SimpleNamespace

import pytest

from markermend.options.config import read_config
from markermend.planning.data_set import DataSet, find_data_set
from markermend.planning.plan import make_plan
from markermend.planning.recordings import BadDataSet
from markermend.storage import source_checksums
from markermend.storage.atomic import sha256
from support.paths import PROJECT


def job(subject="S%201", recording="walk"):
    return SimpleNamespace(subject=subject, recording=recording)


def test_recordings_are_identified_by_their_folders(plan):
    assert plan.data.subjects == {"S%201": ["run", "walk"], "S2": ["%7Bx%7D"]}
    assert plan.data.entry(job()).recording == "walk"
    assert plan.data.mesh_files(SimpleNamespace(subject="S%201")) == []


def test_of_many_recordings_a_bounded_choice_stands_for_the_subject_and_hardly_moves_with_another():
    entries = {("S", f"r{number:04}"): None for number in range(1000)}
    data = DataSet(entries, None)
    chosen = data.chosen("S", at_most=100)
    assert len(chosen) == 100 and chosen == sorted(chosen)
    tenths = [sum(name.startswith(f"r0{digit}") for name in chosen) for digit in range(10)]
    assert min(tenths) >= 3 and max(tenths) <= 20
    assert data.chosen("S", at_most=1000) == data.chosen("S", at_most=2000) == [name for _, name in entries]
    changed = [
        len({*chosen} - {*DataSet({**entries, ("S", f"new{number}"): None}, None).chosen("S", at_most=100)})
        for number in range(50)
    ]
    assert max(changed) == 1 and sum(changed) <= 15


def test_an_original_is_identified_by_its_content(plan, config, tmp_path):
    assert plan.data.original(job()) == str(tmp_path / "walk.c3d")
    strange = job("S2", "%7Bx%7D")
    assert plan.data.original(strange) == str(tmp_path / "{x}.csv")
    before = plan.data.source_hash(strange)
    assert before == sha256(tmp_path / "{x}.csv")
    (tmp_path / "{x}.csv").write_text("edited")
    assert plan.data.source_hash(strange) == before
    again = make_plan(config, PROJECT, deployed=False)
    assert again.data.source_hash(strange) == sha256(tmp_path / "{x}.csv") != before


def test_a_job_may_take_more_for_a_large_original_and_with_each_attempt(plan, config, tmp_path):
    need, subject = plan.data.need(2000), SimpleNamespace(subject="S%201")
    assert [need(job(), attempt) for attempt in (1, 2, 3)] == [need(subject, attempt) for attempt in (1, 2, 3)]
    assert [need(job(), attempt) for attempt in (1, 2, 3)] == [2000, 4000, 6000]
    os.truncate(tmp_path / "walk.c3d", 50_000_000)
    need = make_plan(config, PROJECT, deployed=False).data.need(2000)
    (tmp_path / "run.trc").unlink()
    assert (need(job(), 1), need(job(), 2), need(job("S%201", "run"), 1), need(subject, 1)) == (5000, 10000, 2000, 2000)


@pytest.mark.parametrize(("stage", "again"), [("ingest", True), ("export", True), ("fill", False)])
def test_an_original_is_read_again_where_a_stage_that_reads_it_has_failed_since(
    plan, config, tmp_path, monkeypatch, stage, again
):
    monkeypatch.setattr(source_checksums.time, "time_ns", lambda: 10**19)
    read, wrong = plan.data.source_hash(job()), "0" * 64
    plan.data.checksums.save()
    record = Path(plan.files.sources)
    record.write_text(record.read_text(encoding="utf-8").replace(read, wrong), encoding="utf-8")
    assert make_plan(config, PROJECT, deployed=False).data.source_hash(job()) == wrong
    failures = tmp_path / "out/S%201/walk/failures.tsv"
    failures.parent.mkdir(parents=True)
    failures.write_text(f"{stage}\twalk.c3d changed while the run was on\n")
    assert make_plan(config, PROJECT, deployed=False).data.source_hash(job()) == (read if again else wrong)


def test_what_the_table_says_of_a_recording_becomes_flags(plan):
    flags = plan.data.recording_flags(job(recording="run"))
    checksum = f"--sha256={sha256(Path(plan.data.original(job(recording='run'))))}"
    assert flags == ["--subject=S 1", "--recording=run", "--kind=dynamic", "--rate=120", "--unit=none", checksum]
    assert "--rate=none" in plan.data.recording_flags(job())


def test_decisions_reach_their_recording_alone(tmp_path, plan, config):
    path = tmp_path / "decisions.tsv"
    path.write_text("recording\tmarker\tfirst_frame\tlast_frame\tdecision\nrun\tM1\t3\t5\treject\n")
    decided = make_plan({**config, "decisions": str(path)}, PROJECT, deployed=False)
    assert plan.data.decisions_flag(job()) == decided.data.decisions_flag(job()) == "--decisions=[]"
    name, _, value = decided.data.decisions_flag(job(recording="run")).partition("=")
    assert name == "--decisions" and [line["marker"] for line in json.loads(value)] == ["M1"]


def test_other_remarks_on_decisions_do_not_reach_what_is_computed(tmp_path, plan, config):
    path = tmp_path / "decisions.tsv"
    flags = []
    for remarks in ("hop\tA.L.\t2026-03-31", "taped\tB.K.\t"):
        path.write_text(f"recording\tmarker\tdecision\tnote\tby\tdate\nrun\tM1\tprotect\t{remarks}\n")
        data = make_plan({**config, "decisions": str(path)}, PROJECT, deployed=False).data
        flags.append([data.decisions_flag(job(recording="run")), data.bare_decisions_flag(job(recording="run"))])
    assert flags[0][0] != flags[1][0] and flags[0][1] == flags[1][1]


def test_what_is_missing_by_default_is_said_and_what_is_named_must_be_there(tmp_path, config, monkeypatch):
    monkeypatch.chdir(tmp_path)
    data, warnings = find_data_set(read_config(config), str(tmp_path / "out"))
    assert not data.entries and "no such folder or table" in data.missing and warnings == []
    with pytest.raises(BadDataSet, match="no such folder or table"):
        options = read_config({**config, "recordings": "none"})
        find_data_set(options, str(tmp_path / "out"))
