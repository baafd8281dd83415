"""Tables that people write."""

import pytest

from markermend.planning import tables
from markermend.planning.recordings import BadDataSet

COLUMNS = ("recording", "subject", "file")


def test_rows_have_their_line_numbers_and_filled_cells(tmp_path):
    path = tmp_path / "t.csv"
    path.write_text("recording,subject,file\n\na, S 1 ,\n,,\nb,S2,b.c3d\n")
    rows = tables.read_table(str(path), what="recordings", columns=COLUMNS, required=COLUMNS)
    assert rows == [
        (3, {"recording": "a", "subject": "S 1"}),
        (5, {"recording": "b", "subject": "S2", "file": "b.c3d"}),
    ]


def test_an_unknown_column_is_refused(tmp_path):
    path = tmp_path / "t.tsv"
    path.write_text("recording\tsubject\tfile\tweight\n")
    with pytest.raises(BadDataSet, match="column weight, which means nothing"):
        tables.read_table(str(path), what="recordings", columns=COLUMNS, required=COLUMNS)


def test_a_binary_file_is_no_table(tmp_path):
    path = tmp_path / "walk.c3d"
    path.write_bytes(b"\x02\x50\xff\xfe" * 100)
    with pytest.raises(BadDataSet, match="not a table in UTF-8 text"):
        tables.read_table(str(path), what="recordings", columns=COLUMNS, required=COLUMNS)


def test_a_repeated_column_is_refused(tmp_path):
    (tmp_path / "t.tsv").write_text("recording\tsubject\tfile\tsubject\na\tS\ta.c3d\tT\n")
    with pytest.raises(BadDataSet, match="column subject more than once"):
        tables.read_table(str(tmp_path / "t.tsv"), what="recordings", columns=COLUMNS, required=COLUMNS)


def test_an_apostrophe_that_guards_a_cell_is_left_out(tmp_path):
    (tmp_path / "t.tsv").write_text("recording\tsubject\tfile\n'=walk\t'-S\t'x.c3d\n")
    ((_, row),) = tables.read_table(str(tmp_path / "t.tsv"), what="recordings", columns=COLUMNS, required=COLUMNS)
    assert row == {"recording": "=walk", "subject": "-S", "file": "'x.c3d"}
