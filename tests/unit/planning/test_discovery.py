"""What a config names is found: recordings, supplied meshes, decisions."""

import os

import pytest

from markermend.options.config import read_config
from markermend.options.general import GeneralOptions
from markermend.planning import discovery
from markermend.planning.recordings import BadDataSet, Entry


def entry(subject, recording, mesh=None):
    return Entry(subject, recording, f"/data/{recording}.c3d", mesh=mesh)


def by_folders(*entries):
    return {entry.folders: entry for entry in entries}


def test_recordings_come_from_a_folder_or_a_table(tmp_path):
    (tmp_path / "S01").mkdir()
    (tmp_path / "S01/walk.c3d").touch()
    found, _ = discovery.find_recordings(GeneralOptions(recordings=str(tmp_path)), str(tmp_path / "out"))
    assert list(found) == [("S01", "walk")] and found["S01", "walk"].source == str(tmp_path / "S01/walk.c3d")
    table = tmp_path / "recordings.tsv"
    table.write_text("recording\tsubject\tfile\trate\nwalk 1\tBob\tS01/walk.c3d\t50\n")
    found, _ = discovery.find_recordings(GeneralOptions(recordings=str(table)), str(tmp_path / "out"))
    assert list(found) == [("Bob", "walk%201")] and found["Bob", "walk%201"].rate == 50


def test_the_home_folder_may_be_written_as_a_tilde(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    (tmp_path / "S01").mkdir()
    (tmp_path / "S01/walk.c3d").touch()
    assert discovery.find_recordings(GeneralOptions(recordings="~"), str(tmp_path / "out"))[0]


def test_recordings_that_are_not_there_are_named(tmp_path):
    with pytest.raises(BadDataSet, match=f"no such folder or table: {tmp_path}/none"):
        discovery.find_recordings(GeneralOptions(recordings=str(tmp_path / "none")), "out")


@pytest.mark.parametrize("name", ["walk.c3d", "walk.TRC"])
def test_a_recording_in_place_of_its_folder_is_told_apart_from_a_table(tmp_path, name):
    (tmp_path / name).touch()
    with pytest.raises(BadDataSet, match="is a recording itself: name the folder"):
        discovery.find_recordings(GeneralOptions(recordings=str(tmp_path / name)), "out")


def test_a_table_with_a_cell_that_means_nothing_is_refused(tmp_path):
    table = tmp_path / "recordings.tsv"
    table.write_text("recording\tsubject\tfile\tkind\nwalk\tBob\twalk.c3d\tdynamo\n")
    with pytest.raises(BadDataSet, match=r"line 2, column kind: 'dynamo' is none of auto, dynamic, static"):
        discovery.find_recordings(GeneralOptions(recordings=str(table)), "out")


def test_meshes_of_the_table_win_over_those_of_the_config(tmp_path):
    own, shared = tmp_path / "own.json", tmp_path / "shared.json"
    own.touch()
    shared.touch()
    entries = by_folders(entry("S01", "a", str(own)), entry("S01", "b"), entry("S02", "c"))
    meshes = discovery.supplied_meshes(entries, [os.path.relpath(shared)])
    assert meshes == {"S01": [str(own)], "S02": [str(shared)]}


@pytest.mark.parametrize("name", ["none.json", "{subject}.json"])
def test_a_mesh_that_cannot_be_an_input_is_named(tmp_path, name):
    (tmp_path / "{subject}.json").touch()
    with pytest.raises(BadDataSet, match="is not there, or its name is none that Snakemake can take"):
        discovery.supplied_meshes(by_folders(entry("S01", "a", str(tmp_path / name))), [])


@pytest.mark.parametrize(
    ("name", "expected"),
    [("walk.c3d", True), ("a b'$x.c3d", True), ("{x.c3d", True), ("{x}.c3d", False), ("<b>.c3d", False)],
)
def test_what_can_be_an_input(tmp_path, name, expected):
    path = tmp_path / name
    path.touch()
    assert discovery.nameable(str(path)) is expected
    path.unlink()
    assert discovery.nameable(str(path)) is False


def test_a_name_that_is_not_utf_8_cannot_be_an_input(tmp_path):
    path = os.fsencode(tmp_path) + b"/\xff.c3d"
    open(path, "wb").close()
    assert discovery.nameable(os.fsdecode(path)) is False


def decided_by(name):
    """The options with another table of decisions."""
    return read_config({"decisions": name})


def test_a_table_of_decisions_need_not_be_there_unless_it_was_named(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    entries = [entry("S01", "walk")]
    for name in (None, GeneralOptions().decisions):
        assert discovery.find_decisions(decided_by(name), entries) == ({}, [])
    with pytest.raises(BadDataSet, match=r"decisions: .*other\.tsv cannot be read \(No such file"):
        discovery.find_decisions(decided_by("other.tsv"), entries)
    (tmp_path / "other.tsv").write_text("recording\tmarker\tdecision\nwalk\tM1\tprotect\nrun\tM1\tprotect\n")
    decided, warnings = discovery.find_decisions(decided_by("other.tsv"), entries)
    assert [line["marker"] for line in decided["S01", "walk"]] == ["M1"]
    assert len(warnings) == 1 and "'run'" in warnings[0]
