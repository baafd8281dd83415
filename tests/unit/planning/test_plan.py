"""The plan of a run, asked as the rules ask it but without Snakemake."""

import json
from pathlib import Path
from types import SimpleNamespace

import pytest

from markermend.core.artifacts import DETECTORS
from markermend.planning import end_of_run
from markermend.planning.plan import make_plan
from markermend.planning.recordings import BadDataSet
from markermend.storage import last_run
from markermend.storage.atomic import write_list
from markermend.storage.last_run import LastRun
from support.paths import PROJECT


def job(subject="S%201", recording="walk"):
    return SimpleNamespace(subject=subject, recording=recording)


def test_every_recording_has_a_quality_file(plan):
    assert [path.rpartition("out/")[2] for path in plan.quality_files] == [
        "S%201/run/08_qc.json",
        "S%201/walk/08_qc.json",
        "S2/%7Bx%7D/08_qc.json",
    ]


def test_a_mesh_is_made_of_all_recordings_of_its_subject(plan, tmp_path):
    markers = plan.subject_markers(SimpleNamespace(subject="S%201"))
    assert markers == [f"{tmp_path}/out/S%201/{name}/01_markers.parquet" for name in ("run", "walk")]


def test_a_mesh_and_poses_are_made_of_a_bounded_number_of_recordings(plan, config):
    config["advanced"]["mesh"]["max_recordings"] = 1
    few, subject = make_plan(config, PROJECT, deployed=False), SimpleNamespace(subject="S%201")
    (markers,), (repaired,) = few.subject_markers(subject), few.subject_repaired(subject)
    assert markers in plan.subject_markers(subject) and markers.rpartition("/")[0] == repaired.rpartition("/")[0]
    assert few.poses(job()) == plan.poses(job())


def test_a_subject_has_poses_where_its_recordings_are_filled_from_each_other(plan, config, tmp_path):
    assert plan.poses(job()) == [f"{tmp_path}/out/S%201/poses.parquet"]
    repaired = plan.subject_repaired(SimpleNamespace(subject="S%201"))
    assert repaired == [f"{tmp_path}/out/S%201/{name}/06_repaired.parquet" for name in ("run", "walk")]
    assert plan.poses(job("S2", "%7Bx%7D")) == []
    for change in ({"pool": False}, {"members": ["spline", "local_grnn"]}):
        other = {**config, "fill": {**config["fill"], **change}}
        assert make_plan(other, PROJECT, deployed=False).poses(job()) == []


def test_detectors_that_run_have_events_in_their_strict_order(plan, config):
    assert plan.detectors == list(DETECTORS)
    assert plan.events == [plan.files.events[stage] for stage in DETECTORS]
    some = make_plan({**config, "detect": ["slow", "peaks"]}, PROJECT, deployed=False)
    assert some.detectors == ["peaks", "slow"]
    assert some.events == [plan.files.events["peaks"], plan.files.events["slow"]]


def test_cleaned_files_go_to_a_tree_under_their_own_names_with_a_copy_as_trc_on_request(plan, config, tmp_path):
    folders = list(plan.data.entries)
    assert [plan.cleaned(job(*own)) for own in folders] == [
        f"{tmp_path}/out/cleaned/{name}" for name in ("run.trc", "walk.c3d", "{x}.csv")
    ]
    assert [plan.trc(job(*own)) for own in folders] == [[], [], []]
    wanted = make_plan({**config, "export": {"also_trc": True}}, PROJECT, deployed=False)
    copies = [[], [f"{tmp_path}/out/cleaned/walk.trc"], [f"{tmp_path}/out/cleaned/{{x}}.trc"]]
    assert [wanted.trc(job(*own)) for own in folders] == copies


def test_copies_of_two_recordings_never_meet(config, tmp_path):
    (tmp_path / "S01").mkdir()
    for name in ("walk.c3d", "walk.csv"):
        (tmp_path / "S01" / name).touch()
    plan = make_plan(
        {**config, "recordings": str(tmp_path), "results": str(tmp_path / "../out"), "export": {"also_trc": True}},
        PROJECT,
        deployed=False,
    )
    copies = [path for own in plan.data.entries for path in plan.trc(job(*own))]
    assert [path.rpartition("/")[2] for path in copies] == ["walk.c3d.trc", "walk.csv.trc"]


def test_after_an_edit_the_next_plan_names_the_module(tmp_path, plan, config):
    end_of_run.write_facts(plan, finished=True)
    (tmp_path / "out/.snakemake").mkdir()
    assert not make_plan(config, PROJECT, deployed=False).warnings
    path = tmp_path / "out/report/provenance.json"
    facts = json.loads(path.read_text())
    facts["code"]["fill"] = [entry for entry in facts["code"]["fill"] if "filling/fill.py" not in entry]
    path.write_text(json.dumps(facts))
    named = "code changed since the last run: markermend/filling/fill.py (of fill)"
    assert make_plan(config, PROJECT, deployed=False).warnings == [named]


def test_a_failure_counts_for_what_the_job_is_about(tmp_path, plan, config):
    texts = {"S%201/walk": "fill\tx\nfill\ty\n", "S%201": "mesh\tx\n", "report": "report\tx\n"}
    for place, text in {**texts, "report/batches/1_of_2": "collect\tx\n"}.items():
        (tmp_path / "out" / place).mkdir(parents=True, exist_ok=True)
        (tmp_path / "out" / place / "failures.tsv").write_text(text)
    again = make_plan(config, PROJECT, deployed=False)
    assert plan.failed("fill")(job()) == 0
    assert again.failed("fill")(job()) == 2 and again.failed("fill")(job(recording="run")) == 0
    assert again.failed("fill", "qc")(job()) == 2 and again.failed("qc", "export")(job()) == 0
    assert again.failed("mesh")(SimpleNamespace(subject="S%201")) == 1
    assert again.failed("report")(SimpleNamespace()) == 1
    assert again.failed("collect")(SimpleNamespace(batch="2_of_2")) == 1


def test_lists_name_the_files_that_meshes_and_the_report_are_made_of(tmp_path, plan):
    plan.write_lists()
    assert (tmp_path / "out/S2/logs/recordings.txt").read_text() == f"{tmp_path}/out/S2/%7Bx%7D/01_markers.parquet\n"
    assert (tmp_path / "out/S%201/logs/recordings.txt").read_text().count("\n") == 2
    assert (tmp_path / "out/report/logs/recordings.txt").read_text().splitlines() == plan.quality_files


def test_what_an_earlier_run_did_not_finish_is_no_longer_listed_when_another_begins(plan):
    write_list(plan.files.unfinished_list, plan.quality_files[:1])
    plan.write_lists()
    assert last_run.read(Path(plan.files.results)) == LastRun(tuple("/".join(entry) for entry in plan.data.entries))


def test_the_report_of_many_recordings_is_made_of_batches(tmp_path, plan, config):
    assert plan.judged(None) == plan.quality_files and list(plan.batches) == ["1_of_1"]
    config["advanced"]["report"]["max_batch"] = 1
    many = make_plan(config, PROJECT, deployed=False)
    names = [path.split("/")[-2] for path in many.judged(None)]
    assert many.judged(None) == [f"{tmp_path}/out/report/batches/{name}/qc.json" for name in names]
    found = {name: many.batch(SimpleNamespace(batch=name)) for name in names}
    assert sorted(path for own in found.values() for path in own) == sorted(plan.quality_files)
    many.write_lists()
    assert (tmp_path / "out/report/logs/recordings.txt").read_text().splitlines() == many.judged(None)
    for name, own in found.items():
        assert (tmp_path / f"out/report/batches/{name}/logs/recordings.txt").read_text().splitlines() == own


def test_networks_are_trained_only_where_they_are_members(plan, config):
    assert not plan.trains_networks
    config["fill"]["members"] = [*config["fill"]["members"], "network_lstm"]
    assert make_plan(config, PROJECT, deployed=True).trains_networks


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [("surprise", 1, "surprise"), ("recordings", 7, "Snakemake understood 7"), ("results", "a{b}", "pattern")],
)
def test_what_cannot_be_used_is_named(plan, config, key, value, words):
    with pytest.raises(BadDataSet, match=words):
        make_plan({**config, key: value}, PROJECT, deployed=False)
