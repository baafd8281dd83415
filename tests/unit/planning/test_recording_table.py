"""The table of recordings."""

import pytest

from markermend.formats import units
from markermend.planning import recording_table
from markermend.planning.recordings import BadDataSet, Entry


@pytest.mark.parametrize("separator", ["\t", ",", ";"])
def test_a_table_names_recordings_files_and_more(tmp_path, separator):
    (tmp_path / "raw").mkdir()
    for name in ("raw/1.c3d", "raw/2.trc", "bob.json"):
        (tmp_path / name).touch()
    rows = [
        "recording;subject;file;kind;rate;unit;mesh",
        "walk;Bob;raw/1.c3d;;;METERS;bob.json",
        "",
        "stand;Bob;raw/2.trc;static;50",
    ]
    path = tmp_path / "recordings.tsv"
    path.write_text("\ufeff" + "\r\n".join(rows).replace(";", separator), encoding="utf-8")
    raw = str(tmp_path / "raw")
    assert recording_table.read(str(path)) == [
        Entry("Bob", "stand", f"{raw}/2.trc", kind="static", rate=50.0),
        Entry("Bob", "walk", f"{raw}/1.c3d", unit="m", mesh=str(tmp_path / "bob.json")),
    ]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "recording\tfile\na\tb\n",
            "has no column subject; columns are recording, subject, file, kind, rate, unit, mesh",
        ),
        ("", "has no column recording, subject, file"),
        ("recording\tsubject\tfile\n", "has no rows"),
        ("recording\tsubject\tfile\na\tb\tc\td\n", "line 2 has 4 cells for 3 columns"),
    ],
)
def test_a_table_that_cannot_be_read_says_why(tmp_path, text, message):
    path = tmp_path / "recordings.tsv"
    path.write_text(text)
    with pytest.raises(BadDataSet, match=message):
        recording_table.read(str(path))


def test_every_problem_of_a_table_is_named_at_once_by_line_and_column(tmp_path):
    for name in ("1.c3d", "2.mov"):
        (tmp_path / name).touch()
    path = tmp_path / "recordings.tsv"
    rows = [
        "recording;subject;file;kind;rate;unit;mesh",
        "walk;Bob;1.c3d;statc",
        "",
        "walk;Bob;2.mov;;-5;furlong",
        "run;Bob;3.c3d;;fast;;bob.json",
        "sit;;.",
    ]
    path.write_text("\n".join(rows))
    with pytest.raises(BadDataSet) as error:
        recording_table.read(str(path))
    assert str(error.value).splitlines() == [
        f"recordings: {path} cannot be used (config/README.md)",
        "line 2, column kind: 'statc' is none of auto, dynamic, static; did you mean 'static'?",
        "line 4, column rate: '-5' is no number of frames per second",
        f"line 4, column unit: 'furlong' is none of {units.KNOWN}",
        f"line 4, column file: {tmp_path}/2.mov ends in .mov, which is not a known format (.c3d, .trc, .csv, .tsv)",
        "line 4, column recording: 'walk' of the subject 'Bob' is in line 2 already",
        "line 5, column rate: 'fast' is no number of frames per second",
        f"line 5, column file: {tmp_path}/3.c3d is not there",
        f"line 5, column mesh: {tmp_path}/bob.json is not there",
        "line 6, column subject: is empty",
        f"line 6, column file: {tmp_path} is not a file",
    ]
