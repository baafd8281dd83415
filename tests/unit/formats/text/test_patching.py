"""Cells are written as the table writes its own, and the file grows only where it must."""

from pathlib import Path

import numpy as np

from markermend.formats.comparison import compare
from support.text_files import make, patched, positions


def test_patch_writes_as_many_decimals_as_the_column_has(tmp_path: Path) -> None:
    content = b"time,A_x,A_y,A_z\n0.00,100.12345,1,300\n0.01,-200.5,2.5e-05,30\n0.02,,,\n"
    new = patched(tmp_path, content, {(2, 0): [1 / 3, 2 / 3, -1e-9]})
    assert new == content.replace(b"0.02,,,", b"0.02,0.33333,0.666667,0.000")


def test_patch_keeps_decimal_commas_quotes_and_blanks(tmp_path: Path) -> None:
    content = b'"time";"A_x";"A_y";"A_z"\n0,00; 100,5 ;"200,25";-300\n0,01;1,5;2,5;3,5'
    new = patched(tmp_path, content, {(0, 0): [1.5, -2.25, 3]})
    assert new == content.replace(b' 100,5 ;"200,25";-300', b' 1,500 ;"-2,250";3,000')


def test_patch_lengthens_a_short_row_only_as_far_as_needed(tmp_path: Path) -> None:
    content = b"frame,A_x,A_y,A_z,B_x,B_y,B_z\r\n1,1,2,30,4,5,60\r\n2\r\n3,1,2,30\r\n"
    new = patched(tmp_path, content, {(1, 0): [11, 12, 13], (2, 1): [np.nan] * 3}, rate=50)
    assert new == content.replace(b"\r\n2\r\n", b"\r\n2,11.000,12.000,13.000\r\n")
    changed = np.array([[False, False], [True, False], [False, True]])
    difference = compare(tmp_path / "walk.txt", tmp_path / "new", format="csv", changed=changed, columns=(0, 1))
    assert difference.other_bytes_equal


def test_patch_in_metres_writes_six_decimals(tmp_path: Path) -> None:
    content = make("motive", positions())
    before, after = content.split(b"\n"), patched(tmp_path, content, {(0, 0): [1234.56789, -1, 0]}).split(b"\n")
    assert after[7].split(b",")[10:13] == [b"1.234568", b"-0.001000", b"0.000000"]
    assert [i for i in range(len(before)) if before[i] != after[i]] == [7]


def test_a_delimiter_follows_a_last_cell_that_becomes_blank_in_trc_alone(tmp_path: Path) -> None:
    values = positions()
    for format, extra in (("trc", b"\t"), ("csv", b"")):
        content = make(format, values, end="\n").replace(b"\t\n", b"\n")
        before, after = (
            text.split(b"\n")
            for text in (content, patched(tmp_path, content, {(2, 3): [np.nan] * 3, (3, 3): [1.5] * 3}))
        )
        changed = [(old, new) for old, new in zip(before, after, strict=True) if old != new]
        delimiter = b"\t" if format == "trc" else b","
        assert len(changed) == 2
        assert changed[0][1] == changed[0][0].rsplit(delimiter, 3)[0] + 3 * delimiter + extra
        assert changed[1][1].endswith(delimiter + b"1.500")
