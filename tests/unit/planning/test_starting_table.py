"""A table to begin with: subjects by folders and names, days that are none, static recordings, and what was left out."""

import pytest

from markermend.options.general import GeneralOptions
from markermend.options.ingest import IngestOptions
from markermend.planning import recording_table
from markermend.planning.recordings import BadDataSet
from markermend.planning.starting_table import make_table
from support import c3d_files


@pytest.fixture
def make(tmp_path):
    """Makes a table of files with these names; gives its rows as they are read back, and the notes."""

    def make_files(*names, table="out/recordings.tsv"):
        top = tmp_path / "study"
        for name in names:
            (top / name).parent.mkdir(parents=True, exist_ok=True)
            if name.lower().endswith(".c3d"):
                c3d_files.write(top / name)
            else:
                (top / name).write_text("something")
        made = make_table(str(top), GeneralOptions(), IngestOptions())
        path = tmp_path / table
        path.parent.mkdir(exist_ok=True)
        path.write_text(made.text(path.parent))
        entries = recording_table.read(str(path))
        assert [(e.subject, e.recording, e.source, e.kind) for e in entries] == [
            (e.subject, e.recording, e.source, e.kind) for e in made.entries
        ]
        return {(entry.subject, entry.recording) for entry in entries}, made

    return make_files


def test_subjects_are_folders_that_are_no_days(make):
    found, made = make(
        "S01/2024-05-03/walk.c3d", "S01/2024-05-04/walk.c3d", "20240503/Anna/walk.c3d", "Session1/Anna/sit.c3d"
    )
    assert found == {
        ("S01", "2024-05-03_walk"), ("S01", "2024-05-04_walk"), ("Anna", "20240503_walk"), ("Anna", "Session1_sit"),
    }  # fmt: skip
    assert made.notes[:2] == ("4 recordings of 2 subjects", "4 recordings: subject from the folder: Anna, S01")


@pytest.mark.parametrize(
    ("files", "subjects"),
    [
        (["S01_walk", "S02_walk", "S02_run"], {"S01", "S02"}),
        (["sub-01_task-walk", "sub-02_task-walk"], {"sub-01", "sub-02"}),
        (["Patient 3 gait", "Patient 4 gait"], {"Patient 3", "Patient 4"}),
        (["85_02", "85_12", "07_01"], {"85", "07"}),
        (["S01_walk", "static"], {"trials"}),
        (["walk1", "walk2"], {"trials"}),
        (["p1a", "p2b"], {"trials"}),
        (["t2", "t3"], {"trials"}),
    ],
)
def test_subjects_are_what_all_names_of_a_folder_begin_with(make, files, subjects):
    found, made = make(*(f"trials/{name}.c3d" for name in files))
    assert {subject for subject, _ in found} == subjects
    assert any("beginning of the file's name" in note for note in made.notes) == (subjects != {"trials"})


def test_a_folder_with_the_name_of_a_subject_is_one_whatever_its_files_are_called(make):
    found, _ = make("S07/P1_walk.c3d", "S07/P2_walk.c3d", "Subject 8/S01_a.c3d")
    assert {subject for subject, _ in found} == {"S07", "Subject 8"}


def test_names_that_a_subject_has_twice_are_those_of_the_paths(make):
    found, _ = make("gait/S01_a.c3d", "balance/S01_a.c3d", "balance/S02_a.c3d")
    assert found == {("S01", "gait_S01_a.c3d"), ("S01", "balance_S01_a.c3d"), ("S02", "S02_a")}


def test_static_recordings_and_those_of_the_range_of_motion_are_named(make):
    _, made = make("S01/static 1.c3d", "S01/Cal01.c3d", "S01/T-Pose.c3d", "S01/ROM.c3d", "S01/walk.c3d", "S01/from.c3d")
    assert {entry.recording for entry in made.entries if entry.kind == "static"} == {"static 1", "Cal01", "T-Pose"}
    assert "3 recordings: static by name, reported and never changed: Cal01, T-Pose, static 1" in made.notes
    [rom] = [note for note in made.notes if "range of motion" in note]
    assert rom.startswith("1 recording: ") and rom.endswith(": ROM")


def test_what_cannot_be_read_or_named_and_what_else_is_there_is_said(make):
    found, made = make("S01/walk.c3d", "S01/broken.trc", "S01/\udcff.c3d", "S01/video.mp4", "S01/b.MP4", "notes.txt")
    assert found == {("S01", "walk"), ("S01", "broken")}
    notes = "\n".join(made.notes)
    assert "S01/broken will be set aside as it is: broken.trc" in notes
    assert r"S01/\xff.c3d', whose name is not text in UTF-8: rename it" in notes.replace("\\\\", "\\")
    assert "2 .mp4 (S01/b.MP4, S01/video.mp4), 1 .txt (notes.txt)" in notes


def test_names_lose_their_outer_blanks_and_are_found_all_the_same(make):
    found, _ = make(" S01/ walk .c3d", table="study/recordings.tsv")
    assert found == {("S01", "walk")}


def test_names_with_tabs_quotes_formulas_and_any_letters_come_back(make):
    found, _ = make('S01/a\t"b".c3d', "S01/=1+1.c3d", "S01/läuft ü.c3d", "S01/a;b,c.c3d")
    assert found == {("S01", 'a\t"b"'), ("S01", "=1+1"), ("S01", "läuft ü"), ("S01", "a;b,c")}


def test_a_folder_without_recordings_is_refused(make):
    with pytest.raises(BadDataSet, match="no recording"):
        make("S01/notes.txt")
