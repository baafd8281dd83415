"""Names that differ in capital letters alone, on disks of both kinds."""

from pathlib import Path

import pytest

from markermend.planning import capital_letters
from markermend.planning.plan import make_plan
from markermend.planning.recordings import BadDataSet
from support.paths import PROJECT


@pytest.fixture
def one_for_both(monkeypatch):
    """A disk that takes such names for one."""
    monkeypatch.setattr(Path, "exists", lambda path: path.name.casefold() != "absent")
    monkeypatch.setattr(Path, "samefile", lambda path, other: str(path).casefold() == str(other).casefold())


def test_a_disk_is_asked_by_a_folder_that_is_there(tmp_path, one_for_both):
    for folder in (tmp_path, tmp_path / "absent", Path("/study/1/2")):
        assert not capital_letters.distinguishes_capitals(folder)
    assert capital_letters.distinguishes_capitals(Path("/1/2"))


def test_a_disk_with_both_names_distinguishes_them(tmp_path):
    if (tmp_path.parent / tmp_path.name.swapcase()).exists():
        pytest.skip("this disk takes both for one")
    (tmp_path / "Results").mkdir()
    (tmp_path / "rESULTS").mkdir()
    assert capital_letters.distinguishes_capitals(tmp_path / "Results/out")
    capital_letters.check_distinct(["Bob", "bob", "Ada"], tmp_path / "Results")


def test_names_that_would_meet_are_named(tmp_path, one_for_both):
    capital_letters.check_distinct(["Bob", "Bob", "Ada"], tmp_path)
    with pytest.raises(BadDataSet, match="in capital letters alone for one: Bob, bob; rename one"):
        capital_letters.check_distinct(["Bob", "bob", "Ada"], tmp_path)


@pytest.mark.parametrize("other", ["Study/bob/turn.c3d", "Study/Bob/Walk.c3d"])
def test_neither_subjects_nor_recordings_meet(config, tmp_path, monkeypatch, other):
    for name in ("Study/Bob/walk.c3d", other):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    own = {**config, "recordings": str(tmp_path / "Study"), "results": str(tmp_path / "out")}
    assert len(make_plan(own, PROJECT, deployed=False).data.entries) == 2
    monkeypatch.setattr(capital_letters, "distinguishes_capitals", lambda folder: False)
    with pytest.raises(BadDataSet, match="capital letters alone"):
        make_plan(own, PROJECT, deployed=False)
