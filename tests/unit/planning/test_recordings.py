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
    return {(entry.subject, entry.recording): entry.source for entry in recordings.find(str(folder), str(results))}


def test_every_recording_below_a_folder_belongs_to_the_folder_that_holds_it(tmp_path):
    make(tmp_path / "study", "S01/walk.c3d", "S01/run.TRC", "S02/day/sit.csv", "top.tsv", "S01/notes.txt", "readme")
    assert set(found(tmp_path / "study")) == {("S01", "walk"), ("S01", "run"), ("day", "sit"), ("study", "top")}


def test_hidden_files_and_results_are_left_out(tmp_path):
    make(tmp_path, "S01/walk.c3d", "S01/._walk.c3d", ".trash/old.c3d", "results/S01/walk/cleaned.c3d")
    make(tmp_path, "old/S01/walk/cleaned.c3d", "old/S01/walk/01_markers.parquet")
    assert set(found(tmp_path, tmp_path / "results")) == {("S01", "walk")}


def test_links_are_followed_once(tmp_path):
    make(tmp_path / "store", "walk.c3d")
    (tmp_path / "study").mkdir()
    (tmp_path / "study" / "S01").symlink_to(tmp_path / "store")
    (tmp_path / "store" / "loop").symlink_to(tmp_path / "study")
    assert set(found(tmp_path / "study")) == {("S01", "walk")}


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
    make(tmp_path / "S01", "a.c3d", "S01/a.c3d", "day1/S01/a.c3d", "day2/S01/a.c3d", "day2/S02/a.c3d")
    subjects = {subject for subject, _ in found(tmp_path / "S01")}
    assert subjects == {"S01", "S01/S01", "day1/S01", "day2/S01", "S02"}


def test_an_added_recording_renames_no_other(tmp_path):
    make(tmp_path, "S01/walk.c3d", "S02/walk.c3d")
    before = found(tmp_path)
    make(tmp_path, "S01/walk.trc", "S01/a.c3d", "S03/walk.c3d")
    assert before.items() < found(tmp_path).items()


@pytest.mark.parametrize("results", [".", "study", "study/.."])
def test_results_must_not_lie_over_the_recordings(tmp_path, results):
    make(tmp_path / "study", "S01/walk.c3d")
    with pytest.raises(BadDataSet, match=r"results: .* holds the recordings"):
        recordings.find(str(tmp_path / "study"), str(tmp_path / results))


def test_a_folder_without_recordings_says_what_was_looked_for(tmp_path):
    with pytest.raises(BadDataSet, match=r"no recording \(\.c3d, \.trc, \.csv, \.tsv\) in .*"):
        recordings.find(make(tmp_path, "readme.md"), "elsewhere")


def test_bytes_that_are_no_text_are_shown(tmp_path):
    (tmp_path / "S01").mkdir()
    try:
        open(bytes(tmp_path / "S01") + b"/w\xe4lk.c3d", "w").close()
    except OSError:
        pytest.skip("this file system takes only UTF-8 names")
    assert set(found(tmp_path)) == {("S01", r"w\xe4lk")}


def test_a_broken_link_is_a_recording_and_equal_names_are_refused(tmp_path):
    (tmp_path / "S").mkdir()
    (tmp_path / "S" / "gone.c3d").symlink_to(tmp_path / "nowhere.c3d")
    (entry,) = recordings.find(str(tmp_path), str(tmp_path / "out"))
    assert entry.recording == "gone"
    (tmp_path / "S" / os.fsdecode(b"\xff.c3d")).touch()
    (tmp_path / "S" / r"\xff.c3d").touch()
    with pytest.raises(BadDataSet, match="distinguished by name"):
        recordings.find(str(tmp_path), str(tmp_path / "out"))
