"""The rows of a table are its lines with a number in the first cell, or all that are not empty."""

import pytest

from markermend.formats.text.lines import Sheet
from markermend.formats.text.table_rows import frame_rows, plain_rows, row_widths, writes_decimal_comma


def sheet(*lines: bytes) -> Sheet:
    return Sheet("walk.csv", b"", lines, b"\n", "utf-8")


TABLE = sheet(b"title", b"1,a", b"", b"2,b,,", b"x,c", b"3,d", b"", b"End", b"5,e", b"")


@pytest.mark.parametrize(("section", "rows"), [(True, [1, 3, 4, 5]), (False, [1, 3, 4, 5, 7, 8])])
def test_frame_rows(section: bool, rows: list[int]) -> None:
    found, warnings = frame_rows(TABLE, 0, b",", section=section)
    assert found == rows
    assert warnings == [f"{2 - section} rows have no frame number, the first in line 5."]


def test_text_below_the_last_row_is_left_alone() -> None:
    assert frame_rows(sheet(b"1,a", b"text"), 0, b",", section=False) == (
        [0],
        ["Text from line 2 on is no frame and is left alone."],
    )


def test_plain_rows() -> None:
    assert plain_rows(sheet(b"head", b"1,2", b",", b"", b"3,4", b",,", b""), 1, b",") == [1, 2, 4]
    assert plain_rows(sheet(b"head", b""), 1, b",") == []


def test_widths_and_decimal_commas() -> None:
    assert row_widths(TABLE, [1, 3, 5], b",") == [2, 2, 2]
    assert writes_decimal_comma(sheet(b"1,5;2", b"3;4"), [0, 1], b";")
