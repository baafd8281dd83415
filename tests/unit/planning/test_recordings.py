import os

import pytest

from markermend.planning import recordings
from markermend.planning.recordings import BadDataSet


def make(folder, *names):
    for name in names:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(b"")
    return str(folder)


def found(folder, results="elsewhere"):
    return {(entry.subject, entry.recording): entry.source for entry in recordings.find(str(folder), str(results))[0]}


def test_every_recording_below_a_folder_belongs_to_the_folder_that_holds_it(tmp_path):
    make(tmp_path / "study", "S01/walk.c3d", "S01/run.TRC", "S02/day/sit.csv", "top.tsv", "S01/notes.txt", "readme")
    assert set(found(tmp_path / "study")) == {("S01", "walk"), ("S01", "run"), ("day", "sit"), ("study", "top")}


def test_hidden_files_and_results_are_left_out(tmp_path):
    make(tmp_path, "S01/walk.c3d", "S01/._walk.c3d", ".trash/old.c3d", "results/S01/walk/cleaned.c3d")
    make(tmp_path, "old/S01/walk/cleaned.c3d", "old/S01/walk/01_markers.parquet")
    assert set(found(tmp_path, tmp_path / "results")) == {("S01", "walk")}
    _, warnings = recordings.find(str(tmp_path), str(tmp_path / "results"))
    assert warnings == [
        f"recordings: left alone below {tmp_path}: 2 hidden (.trash/, S01/._walk.c3d),"
        " 1 with results of earlier runs (old/S01/walk)"
    ]


def test_a_folder_of_compressed_recordings_says_what_to_do(tmp_path):
    make(tmp_path, "S01/walk.c3d.gz", "S01/run.trc.gz")
    with pytest.raises(BadDataSet, match=r"no recording .*\n.*2 .gz .*is compressed: unpack it"):
        recordings.find(str(tmp_path), "elsewhere")


def test_links_are_followed_once(tmp_path):
    make(tmp_path / "study", "store/walk.c3d")
    (tmp_path / "study/a").symlink_to(tmp_path / "study/store")
    (tmp_path / "study/store/loop").symlink_to(tmp_path / "study")
    assert set(found(tmp_path / "study")) == {("a", "walk")}


@pytest.fixture
def linked(tmp_path):
    """A folder of recordings with links: to a folder and a file outside, and to a file inside."""
    make(tmp_path, "study/S01/walk.c3d", "store/run.c3d", "secret.c3d")
    (tmp_path / "study/S02").symlink_to("../store")
    (tmp_path / "study/S01/out.c3d").symlink_to("../../secret.c3d")
    (tmp_path / "study/S01/in.c3d").symlink_to("walk.c3d")
    return tmp_path / "study"


def test_links_that_lead_out_of_the_folder_are_not_followed(linked):
    entries, warnings = recordings.find(str(linked), "elsewhere")
    assert {entry.recording: entry.leads_out for entry in entries} == {"walk": False, "in": False, "out": True}
    assert warnings == [
        f"recordings: {linked}/S02 is a link that leads out of the folder of recordings: it is left out "
        "(follow_links: true follows it)"
    ]


def test_links_that_lead_out_of_the_folder_are_followed_on_request(linked):
    entries, warnings = recordings.find(str(linked), "elsewhere", follow_links=True)
    assert {entry.recording for entry in entries} == {"walk", "in", "out", "run"}
    assert not any(entry.leads_out for entry in entries) and warnings == []


def test_a_folder_that_is_itself_a_link_holds_what_is_in_it(linked, tmp_path):
    (tmp_path / "link").symlink_to(linked)
    entries, _ = recordings.find(str(tmp_path / "link"), "elsewhere")
    assert {entry.recording for entry in entries if entry.leads_out} == {"out"}


def test_a_folder_of_nothing_but_links_out_says_so(tmp_path):
    make(tmp_path, "store/run.c3d")
    (tmp_path / "study").mkdir()
    (tmp_path / "study/S02").symlink_to("../store")
    with pytest.raises(BadDataSet, match=r"no recording .*\n.*follow_links: true follows it"):
        recordings.find(str(tmp_path / "study"), "elsewhere")


def test_a_folder_that_cannot_be_searched_is_named(tmp_path, monkeypatch):
    make(tmp_path, "S01/walk.c3d", "S02/walk.c3d")
    scandir = os.scandir

    def locked(path):
        if str(path).endswith("S02"):
            raise PermissionError(13, "Permission denied", path)
        return scandir(path)

    monkeypatch.setattr(os, "scandir", locked)
    entries, warnings = recordings.find(str(tmp_path), "elsewhere")
    assert [entry.subject for entry in entries] == ["S01"]
    assert warnings == [f"recordings: {tmp_path}/S02 cannot be searched (Permission denied): it is left out"]


def test_files_of_one_stem_are_distinguished(tmp_path):
    make(tmp_path / "S01", "a.trc", "a.c3d", "a.C3D", "a.csv", "b.trc", "c.trc", "c.trc.c3d")
    names = {recording: source.rsplit("/", 1)[1] for (_, recording), source in found(tmp_path).items()}
    assert names == {
        "a": "a.C3D",
        "a.c3d": "a.c3d",
        "a.trc": "a.trc",
        "a.csv": "a.csv",
        "b": "b.trc",
        "c": "c.trc",
        "c.trc.c3d": "c.trc.c3d",
    }


def test_folders_of_one_name_are_distinguished(tmp_path):
    make(tmp_path / "S01", "a.c3d", "S01/a.c3d", "old/S01/a.c3d", "new/S01/a.c3d", "new/S02/a.c3d")
    subjects = {subject for subject, _ in found(tmp_path / "S01")}
    assert subjects == {"S01", "S01/S01", "old/S01", "new/S01", "S02"}


@pytest.mark.parametrize(
    "day",
    ["2024-05-03", "20240503", "2024.05.03", "3.5.2024", "Session1", "session 2", "New Session", "Day2", "ses-01"],
)
def test_a_day_is_no_subject(tmp_path, day):
    make(tmp_path / "study", f"S01/{day}/walk.c3d", "S01/walk.c3d", f"{day}/S02/walk.c3d", "S03/other/walk.c3d")
    assert set(found(tmp_path / "study")) == {
        ("S01", f"{day}_walk"), ("S01", "walk"), ("S02", f"{day}_walk"), ("other", "walk"),
    }  # fmt: skip


@pytest.mark.parametrize("name", ["20249903", "Day", "Sessions", "S20240503", "Daytona1", "12345678"])
def test_what_only_looks_like_a_day_is_a_subject(tmp_path, name):
    make(tmp_path / "study", f"{name}/walk.c3d")
    assert set(found(tmp_path / "study")) == {(name, "walk")}


def test_days_right_below_the_folder_are_those_of_one_subject_and_that_is_said(tmp_path):
    make(tmp_path / "S01", "Day1/walk.c3d", "Day2/am/walk.c3d", "Day2/walk.c3d", "Day3/Session1/walk.c3d", "Day4/x.trc")
    entries, warnings = recordings.find(str(tmp_path / "S01"), "elsewhere")
    assert {(entry.subject, entry.recording) for entry in entries} == {
        ("S01", "Day1_walk"), ("S01", "Day2_walk"), ("am", "Day2_walk"), ("S01", "Day3_Session1_walk"), ("S01", "Day4_x"),
    }  # fmt: skip
    assert warnings == [
        "recordings: Day1, Day2, Day3 and 1 more are taken for days of one subject, S01 (day_folders: [] takes each for a subject)"
    ]
    entries, warnings = recordings.find(str(tmp_path / "S01"), "elsewhere", day_folders=[])
    assert {entry.subject for entry in entries} == {"Day1", "Day2", "am", "Session1", "Day4"} and not warnings


def test_a_name_that_a_day_would_give_twice_is_named(tmp_path):
    make(tmp_path / "S01", "Day1/walk.c3d", "Day1_walk.c3d")
    with pytest.raises(BadDataSet, match="cannot be distinguished by name"):
        found(tmp_path / "S01")


def test_an_added_recording_renames_no_other(tmp_path):
    make(tmp_path, "S01/walk.c3d", "S02/walk.c3d")
    before = found(tmp_path)
    make(tmp_path, "S01/walk.trc", "S01/a.c3d", "S03/walk.c3d")
    assert before.items() < found(tmp_path).items()


@pytest.mark.parametrize("results", [".", "study", "study/.."])
def test_results_must_not_lie_over_the_recordings(tmp_path, results):
    make(tmp_path / "study", "S01/walk.c3d")
    with pytest.raises(BadDataSet, match=r"results: .* holds the recordings .* Choose another folder for the results$"):
        recordings.find(str(tmp_path / "study"), str(tmp_path / results))


def test_a_folder_without_recordings_says_what_was_looked_for(tmp_path):
    with pytest.raises(BadDataSet, match=r"no recording \(\.c3d, \.trc, \.csv, \.tsv\) in .*"):
        recordings.find(make(tmp_path, "readme.md"), "elsewhere")


def test_bytes_that_are_no_text_are_shown(tmp_path):
    (tmp_path / "S01").mkdir()
    try:
        open(bytes(tmp_path / "S01") + b"/w\xe4lk.c3d", "w", encoding="utf-8").close()
    except OSError:
        pytest.skip("this file system takes only UTF-8 names")
    assert set(found(tmp_path)) == {("S01", r"w\xe4lk")}


def test_a_broken_link_is_a_recording_and_equal_names_are_refused(tmp_path):
    (tmp_path / "S").mkdir()
    (tmp_path / "S" / "gone.c3d").symlink_to(tmp_path / "nowhere.c3d")
    ((entry,), _) = recordings.find(str(tmp_path), str(tmp_path / "out"))
    assert entry.recording == "gone"
    (tmp_path / "S" / os.fsdecode(b"\xff.c3d")).touch()
    (tmp_path / "S" / r"\xff.c3d").touch()
    with pytest.raises(BadDataSet, match="distinguished by name"):
        recordings.find(str(tmp_path), str(tmp_path / "out"))
