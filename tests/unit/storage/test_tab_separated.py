"""Tables that no spreadsheet takes for formulas, and that are read back as they were."""

import csv
import io

import pytest
from hypothesis import given
from hypothesis import strategies as st

from markermend.storage.tab_separated import guarded, lines, plain, table
from support.table_rules import CASES


@pytest.mark.parametrize(("text", "cell"), CASES["cells"])
def test_a_text_is_a_cell_that_no_spreadsheet_calculates_and_comes_back(text, cell):
    assert lines([[text]]) == cell + "\n"
    assert plain(guarded(text)) == text


@pytest.mark.parametrize("value", [-1.5, -3, None])
def test_numbers_stay_as_they_are(value):
    assert guarded(value) == value


@given(st.text(alphabet="'=+-@\t\r\n1.ea\uff1d", max_size=6))
def test_every_text_comes_back_and_none_begins_like_a_formula(text):
    cell = guarded(text)
    assert plain(cell) == text
    assert cell[:1] not in {*"=@\t\r\n\uff1d"} and (cell[:1] not in {*"+-"} or float(cell) is not None)


def test_a_table_is_read_back_by_columns():
    rows = [{"marker": name, "amount": -1.5, "note": 'a "b"\tc\r'} for name in ("LASI", "=HYPERLINK(1)")]
    text = table(["marker", "amount", "note"], rows)
    assert text.split("\n")[2] == "'=HYPERLINK(1)\t-1.5\t" + '"a ""b""\tc\r"'
    read = list(csv.DictReader(io.StringIO(text, newline=""), delimiter="\t"))
    assert [plain(row["marker"]) for row in read] == ["LASI", "=HYPERLINK(1)"]
    assert {(row["amount"], row["note"]) for row in read} == {("-1.5", 'a "b"\tc\r')}
    assert lines([]) == ""
