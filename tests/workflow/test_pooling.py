"""A subject's recordings are filled from each other: which jobs that takes, what is stated, and what runs again."""

from pathlib import Path

import numpy as np
import pytest
import yaml

from markermend.storage import atomic, poses_file, stage_files
from support.workflow_runs import Project, write_recording

NOTHING = "Nothing to be done"
AFTER_REPAIR = ("finish",)


@pytest.fixture(scope="module")
def finished(tmp_path_factory) -> Project:
    """A project whose workflow has run: S01 with three recordings, one at another rate, and a file that is none; S02 with one
    recording; S03 with two that share no marker. Nothing is detected, for the sake of time."""
    project = Project(tmp_path_factory.mktemp("pooling"))
    config = project.folder / "config/config.yaml"
    config.write_text(yaml.safe_dump({**yaml.safe_load(config.read_text()), "detect": []}))
    for seed, (name, rate) in enumerate([("walk", 100.0), ("jump", 50.0), ("turn", 100.0)]):
        write_recording(project.recordings / f"S01/{name}.c3d", seed=seed, rate=rate, body=1)
    (project.recordings / "S01/bad.c3d").write_text("not a recording")
    write_recording(project.recordings / "S02/alone.c3d", seed=4)
    for seed, prefix in enumerate("AB"):
        write_recording(project.recordings / f"S03/{prefix}.c3d", seed=seed, prefix=prefix)
    project.run()
    return project


def facts_of(project: Project, recording: str) -> dict:
    return stage_files.read_facts(project.results / recording / "07_filled.parquet")


def decide(project: Project, tmp_path: Path, *lines: str) -> tuple[str, str]:
    """Flags with a table of decisions."""
    header = (project.folder / "config/decisions.tsv").read_text()
    (tmp_path / "decisions.tsv").write_text(header + "".join(f"{line}\n" for line in lines))
    (tmp_path / "study.yaml").write_text(yaml.safe_dump({"decisions": str(tmp_path / "decisions.tsv")}))
    return "--configfile", str(tmp_path / "study.yaml")


def test_the_poses_of_a_subject_are_those_of_its_usable_recordings(finished):
    poses = poses_file.read(finished.results / "S01/poses.parquet")
    assert poses.recordings == ("jump", "turn", "walk") and len(poses.markers) == 6
    for number, name in enumerate(poses.recordings):
        repaired = stage_files.read_recording(finished.results / f"S01/{name}/06_repaired.parquet")
        rows = poses.recording == number
        seen = ~np.isnan(poses.positions[rows])
        assert rows.sum() > 100 and seen.mean() > 0.95
        shown = repaired.positions[poses.frames[rows]][:, [repaired.markers.index(m) for m in poses.markers]]
        assert np.array_equal(shown[seen], poses.positions[rows][seen])


def test_a_filled_recording_names_those_that_it_learned_from(finished):
    facts = facts_of(finished, "S01/walk")
    assert facts["learned_from"] == ["jump", "turn"]
    assert facts["inputs"]["poses"] == [atomic.sha256(finished.results / "S01/poses.parquet")]
    assert "of the subject, too: jump, turn" in (finished.results / "S01/walk/page.html").read_text()
    sources = stage_files.read_facts(finished.results / "S01/poses.parquet")["sources"]
    assert sources["walk"] == atomic.sha256(finished.recordings / "S01/walk.c3d")


def test_recordings_with_nothing_to_learn_from_are_filled_from_themselves(finished):
    assert not (finished.results / "S02/poses.parquet").exists()
    assert facts_of(finished, "S02/alone")["inputs"]["poses"] == []
    assert not poses_file.read(finished.results / "S03/poses.parquet").recordings
    for name in ("S02/alone", "S03/A", "S03/B"):
        assert "learned_from" not in facts_of(finished, name)
        filled = stage_files.read_recording(finished.results / name / "07_filled.parquet")
        assert not filled.missing.any()


def test_without_pooling_no_job_is_about_poses(finished, tmp_path):
    (tmp_path / "study.yaml").write_text(yaml.safe_dump({"fill": {"pool": False}}))
    plan = finished.plan("--configfile", str(tmp_path / "study.yaml"))
    assert plan.jobs == {**dict.fromkeys(AFTER_REPAIR, 7), "report": 1, "all": 1}
    fresh = finished.plan("--configfile", str(tmp_path / "study.yaml"), results=tmp_path / "results")
    assert "poses" not in fresh.jobs and fresh.jobs["finish"] == 7


def test_on_a_cluster_no_batch_waits_for_one_that_waits_for_it(finished, tmp_path):
    plan = finished.plan("--profile", str(finished.folder / "profiles/slurm"), results=tmp_path)
    assert plan.jobs["poses"] == 2 and plan.jobs["finish"] == 7


def test_an_added_recording_repeats_its_subject_and_leaves_the_others(finished):
    before = finished.outputs()
    new = finished.recordings / "S01/new.c3d"
    write_recording(new, seed=9, body=1)
    chain = dict.fromkeys(("repair", *AFTER_REPAIR), 5)
    assert finished.plan().jobs == {"ingest": 1, "mesh": 1, **chain, "poses": 1, "report": 1, "all": 1}
    finished.run()
    assert facts_of(finished, "S01/walk")["learned_from"] == ["jump", "new", "turn"]
    after = finished.outputs()
    changed = {name for name in before if before[name] != after[name]}
    assert {name.removeprefix("cleaned/").split("/")[0] for name in changed} == {"S01", "report"}
    assert not any(name.endswith("01_markers.parquet") for name in changed)
    new.unlink()
    finished.run()
    again = finished.outputs()
    assert {name: again[name] for name in before} == before


def test_a_decision_that_changes_no_pose_refills_its_recording_alone(finished, tmp_path):
    before = finished.outputs()
    flags = decide(finished, tmp_path, "walk\tM1\t41\t50\treject\tgap")
    plan = finished.plan(*flags)
    jobs = {"repair": 1, "poses": 1, **dict.fromkeys(AFTER_REPAIR, 4), "report": 1, "all": 1}
    assert plan.jobs == jobs
    finished.run(*flags)
    after = finished.outputs()
    changed = {name for name in before if before[name] != after[name]}
    assert {name.rpartition("/")[0] for name in changed} == {"S01/walk", "cleaned/S01", "report"}
    logs = {name: (finished.results / f"S01/{name}/logs/finish.log").read_text() for name in ("walk", "jump", "turn")}
    assert [name for name, text in logs.items() if "fill: the outputs are kept" in text] == ["jump", "turn"]
    assert NOTHING in finished.plan(*flags).text
    finished.run()
    assert finished.outputs() == before


def test_a_decision_that_changes_poses_refills_the_recordings_that_learn_from_them(finished, tmp_path):
    before = finished.outputs()
    flags = decide(finished, tmp_path, "walk\tM3\t1\t120\tmissing")
    finished.run(*flags)
    after = finished.outputs()
    assert after["S01/poses.parquet"] != before["S01/poses.parquet"]
    assert np.isnan(poses_file.read(finished.results / "S01/poses.parquet").positions[:, 3]).mean() > 0.3
    changed = {name for name in before if before[name] != after[name]}
    assert {name.split("/")[1] for name in changed if name.endswith("07_filled.parquet")} == {"walk", "jump", "turn"}
    assert not any(name.startswith(("S02", "S03")) for name in changed)
    finished.run()
    assert finished.outputs() == before
