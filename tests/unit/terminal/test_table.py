"""`markermend table`: a table to correct, never over another."""

import pytest

from markermend.planning import recording_table
from markermend.terminal import command_line
from support import c3d_files


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "data/S01/Day1").mkdir(parents=True)
    c3d_files.write(tmp_path / "data/S01/Day1/walk.c3d")
    return tmp_path


def test_a_table_is_written_and_what_it_was_guessed_from(here, capsys):
    assert command_line.main(["table", "data"]) == 0
    assert (here / "recordings.tsv").read_text() == (
        "recording\tsubject\tfile\tkind\trate\tunit\nDay1_walk\tS01\tdata/S01/Day1/walk.c3d\tauto\t\t\n"
    )
    assert capsys.readouterr().out.splitlines() == [
        "1 recording of 1 subject",
        "1 recording: subject from the folder: S01",
        "Correct recordings.tsv where it is wrong, and clean it: markermend clean recordings.tsv",
    ]


def test_a_table_that_is_there_is_left(here, capsys):
    (here / "recordings.tsv").write_text("mine")
    assert command_line.main(["table", "data"]) == 1
    assert capsys.readouterr().err == "recordings.tsv is there already: name another table with --to\n"
    assert (here / "recordings.tsv").read_text() == "mine"
    assert command_line.main(["table", "data", "--to", "tables/new.tsv"]) == 0
    assert "../data/S01/Day1/walk.c3d" in (here / "tables/new.tsv").read_text()


def test_a_table_that_cannot_be_written_is_said(here, capsys):
    (here / "file").touch()
    assert command_line.main(["table", "data", "--to", "file/recordings.tsv"]) == 1
    assert "was not written" in capsys.readouterr().err


def test_what_days_and_static_recordings_are_called_is_read_from_files_of_options(here):
    (here / "own.yaml").write_text("day_folders: []\ningest: {static_names: [walk]}\n")
    assert command_line.main(["table", "data", "--options", "own.yaml"]) == 0
    [entry] = recording_table.read("recordings.tsv")
    assert (entry.subject, entry.recording, entry.kind) == ("Day1", "walk", "static")


@pytest.mark.parametrize(
    "change", [lambda text: "\ufeff" + text, lambda text: text.replace("\t", ";").replace("\n", "\r\n")]
)
def test_a_table_that_a_spreadsheet_saved_is_read(here, change):
    command_line.main(["table", "data"])
    text = (here / "recordings.tsv").read_text()
    (here / "recordings.tsv").write_bytes(change(text).encode())
    [entry] = recording_table.read("recordings.tsv")
    assert entry.subject == "S01" and entry.source == str(here / "data/S01/Day1/walk.c3d")
