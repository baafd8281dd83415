"""Text files in any encoding of one byte or UTF-8 are split into lines and cells, byte for byte."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from markermend.core.recording import BadRecording
from markermend.formats.text import lines
from support.text_files import make, positions, read


def test_encodings(tmp_path: Path) -> None:
    content = make("trc", positions()).replace(b"LASI", "Hüfte".encode())
    assert read(tmp_path, content).recording.markers[0] == "Hüfte"
    assert read(tmp_path, content.decode().encode("latin-1")).recording.markers[0] == "Hüfte"
    with pytest.raises(BadRecording, match="UTF-16"):
        read(tmp_path, content.decode().encode("utf-16"))


def naive_split(line: bytes, delimiter: bytes) -> list[bytes]:
    """Cells by a walk over the characters: a cell in quotes ends at the delimiter after its closing quote."""
    cells, cell, i = [], b"", 0
    while i < len(line):
        closing = closing_quote(line, i) if not cell.strip() and line[i : i + 1] == b'"' else None
        if closing is not None:
            cell, i = cell + line[i : closing + 1], closing + 1
        elif line[i : i + 1] == delimiter:
            cells, cell, i = [*cells, cell], b"", i + 1
        else:
            cell, i = cell + line[i : i + 1], i + 1
    return [*cells, cell]


def closing_quote(line: bytes, opening: int) -> int | None:
    """Where the quotation that opens here ends; two quotes within it stand for one."""
    i = opening + 1
    while i < len(line):
        if line[i : i + 2] == b'""':
            i += 2
        elif line[i : i + 1] == b'"':
            return i
        else:
            i += 1
    return None


@given(st.lists(st.sampled_from([b'"', b",", b"a", b"1.5", b" ", b'"a,b"', b'""'])).map(b"".join))
def test_a_line_is_split_as_by_a_walk_over_its_characters(line: bytes) -> None:
    assert lines.split(line, b",") == naive_split(line, b",")
    assert b",".join(lines.split(line, b",")) == line


@pytest.mark.parametrize("newline", [b"\n", b"\r\n", b"\r"])
def test_joining_the_lines_gives_the_file(tmp_path: Path, newline: bytes) -> None:
    content = b"\xef\xbb\xbf" + newline.join([b"a,b", b"", b"1;2", b"x"]) + newline
    (tmp_path / "walk.csv").write_bytes(content)
    sheet = lines.load(tmp_path / "walk.csv")
    assert sheet.joined(sheet.lines) == content and sheet.complete
    assert sheet.filled(0, b",") == [0, 2, 3] and sheet.texts(0, b",") == ["a", "b"] and sheet.texts(9, b",") == []


@pytest.mark.parametrize(
    ("rows", "delimiter", "comma"),
    [
        ([b"1,5;2,25"], b";", True),
        ([b"1,5;2.25"], b";", False),
        ([b"1;2"], b";", False),
        ([b"1,5,2,25"], b",", False),
        ([b'"1,5","2,25"'], b",", True),
    ],
)
def test_decimal_commas(rows: list[bytes], delimiter: bytes, comma: bool) -> None:
    assert lines.has_decimal_comma(rows, delimiter) == comma


@pytest.mark.parametrize(
    ("line", "delimiter"), [(b"a\tb,c;d", b"\t"), (b"a;b,c", b";"), (b"a,b", b","), (b"alone", b",")]
)
def test_the_likeliest_delimiter(line: bytes, delimiter: bytes) -> None:
    assert lines.likeliest_delimiter([line]) == delimiter
