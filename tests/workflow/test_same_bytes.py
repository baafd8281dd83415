"""The chain in one process and the workflow give the same bytes."""

from pathlib import Path

import pytest

import synthesize
from markermend import api
from support.workflow_runs import Project


def same(project: Project, folder: Path) -> dict[str, list[bool]]:
    """Clean all recordings of a project in this process; say which files equal those of the workflow."""
    equal = {}
    for subject in sorted(project.recordings.iterdir()):
        paths = sorted(subject.iterdir())
        recordings = [api.read(path) for path in paths]
        for path, cleaned in zip(paths, api.clean_subject(recordings), strict=True):
            there = project.results / subject.name / path.stem
            made = [folder / path.name, folder / "changes.tsv"]
            api.write(cleaned, path, made[0], changes=made[1])
            written = [project.results / "cleaned" / subject.name / path.name, there / "changes.tsv"]
            equal[f"{subject.name}/{path.stem}"] = [
                one.read_bytes() == other.read_bytes() for one, other in zip(made, written, strict=True)
            ]
    return equal


def test_on_synthetic_sessions(tmp_path):
    project = Project(tmp_path)
    places = ["--folder", str(project.recordings), "--truth", str(tmp_path / "truth")]
    synthesize.main([*places, "--seed", "1", "--subjects", "1", "--duration-s", "4"])
    project.run()
    names = sorted(path.stem for path in (project.recordings / "S01").iterdir())
    assert same(project, tmp_path) == {f"S01/{name}": [True, True] for name in names}


@pytest.mark.slow
@pytest.mark.data
def test_on_a_real_recording(tmp_path, data):
    project = Project(tmp_path)
    (project.recordings / "S").mkdir(parents=True)
    (project.recordings / "S/85_02.c3d").write_bytes((data / "clean/85_02.c3d").read_bytes())
    project.run()
    assert same(project, tmp_path) == {"S/85_02": [True, True]}
