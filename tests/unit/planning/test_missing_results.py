"""A result that is gone is made anew."""

from itertools import chain

import pytest

from markermend.planning.missing_results import count_missing, find_missing
from markermend.planning.plan import make_plan
from support.paths import PROJECT

STAGES = {
    "ingest": ["01_markers.parquet"],
    "labels": ["02_labels.parquet"],
    "frames": ["02_frames.parquet"],
    "frozen": ["02_frozen.parquet"],
    "tails": ["02_tails.parquet"],
    "peaks": ["02_peaks.parquet"],
    "noise": ["03_noise.parquet"],
    "steps": ["04_steps.parquet"],
    "slow": ["05_slow.parquet"],
    "repair": ["06_repaired.parquet", "06_changes.parquet"],
    "fill": ["07_filled.parquet", "07_changes.parquet"],
    "export": ["../../cleaned/walk.c3d", "changes.tsv", "originals.parquet", "certificate.json"],
    "qc": ["08_qc.json", "page.html"],
}


@pytest.fixture
def walk(plan, tmp_path):
    """The folder of a recording that is finished, of a subject with two; the report has been made."""
    folder = tmp_path / "out/S%201/walk"
    folder.mkdir(parents=True)
    (tmp_path / "out/cleaned").mkdir()
    for name in [*chain.from_iterable(STAGES.values()), "../mesh.json", "../poses.parquet"]:
        (folder / name).touch()
    return folder


@pytest.fixture
def report(tmp_path):
    """The report of the run before."""
    (tmp_path / "out/report").mkdir(parents=True)
    (tmp_path / "out/report/index.html").touch()


def test_what_was_not_made_yet_is_not_missing(plan, walk):
    assert find_missing(plan) == []
    for name in ("08_qc.json", "page.html", "certificate.json", "../poses.parquet"):
        (walk / name).unlink()
        if name == "08_qc.json":
            assert find_missing(plan) == []
    assert find_missing(plan) == []


def test_a_result_that_is_gone_is_found(plan, walk):
    for stage, names in STAGES.items():
        for name in set(names) - {"08_qc.json"}:
            (walk / name).rename(walk / "elsewhere")
            assert find_missing(plan) == [("S%201", "walk", stage)]
            (walk / "elsewhere").rename(walk / name)
    for stage, name in {"mesh": "mesh.json", "poses": "poses.parquet"}.items():
        (walk.parent / name).rename(walk / "elsewhere")
        assert find_missing(plan) == [("S%201", "", stage)]
        (walk / "elsewhere").rename(walk.parent / name)


def test_what_is_gone_counts_as_failed(plan, walk, config):
    missing = [("S%201", "walk", "export"), ("S%201", "", "mesh"), ("report", "", "report")]
    count_missing(plan.files, missing)
    assert make_plan(config, PROJECT, deployed=False).failures == dict.fromkeys(missing, 1)


def test_a_report_of_recordings_that_are_gone_is_made_anew_with_them(plan, walk, report):
    assert find_missing(plan) == [("report", "", "collect"), ("report", "", "report")]


def test_a_copy_as_trc_is_missed_where_it_is_written(config, walk):
    config["export"]["also_trc"] = True
    assert find_missing(make_plan(config, PROJECT, deployed=False)) == [("S%201", "walk", "export")]
    (walk / "../../cleaned/walk.trc").touch()
    assert find_missing(make_plan(config, PROJECT, deployed=False)) == []


def test_poses_and_events_are_not_missed_where_none_are_made(config, walk):
    config["fill"]["pool"] = False
    config["detect"] = ["peaks"]
    for name in ("02_labels.parquet", "05_slow.parquet", "../poses.parquet"):
        (walk / name).unlink()
    assert find_missing(make_plan(config, PROJECT, deployed=False)) == []


def test_a_folder_is_listed_once(plan, monkeypatch):
    listed = []
    monkeypatch.setattr("markermend.planning.missing_results.os.listdir", lambda folder: listed.append(folder) or [])
    find_missing(plan)
    assert len(listed) == len(plan.data.entries) == 3
