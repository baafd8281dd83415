"""Tables that no spreadsheet takes for formulas, and that are read back as they were."""

import csv
import io

import pytest
from hypothesis import given
from hypothesis import strategies as st

from markermend.storage.tab_separated import guarded, lines, plain, table

FORMULAS = ["=1+1", "+cmd|' /C calc'!A0", "-2+3", "@SUM(A1)", "\t=1", "\r=1", "\uff1d1", "-", "-1.5 mm", "'=1", "''-x"]


@pytest.mark.parametrize("text", FORMULAS)
def test_what_a_spreadsheet_would_calculate_begins_with_an_apostrophe(text):
    assert guarded(text) == "'" + text
    assert plain(guarded(text)) == text


@pytest.mark.parametrize("value", [-1.5, -3, None, "-1.5", "+2e-3", "-.5", "-inf", "LASI", "'til", "a=b", ""])
def test_numbers_and_names_stay_as_they_are(value):
    assert guarded(value) == value
    assert value is None or plain(str(value)) == str(value)


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
