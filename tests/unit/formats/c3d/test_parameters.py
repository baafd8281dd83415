"""Header and parameters are read with every length checked, and as ezc3d reads them."""

import pytest

from markermend.core.recording import BadRecording
from support.c3d_files import assert_read_whole, read, section_of, trajectories, write
from support.ezc3d_strings import strings_by_ezc3d


@pytest.fixture
def path(tmp_path):
    return write(tmp_path / "walk.c3d", trajectories(200, 4))


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"", "empty"),
        (b"\2\x50", "not a C3D"),
        (b"Time,X,Y\n" * 200, "not a C3D"),
        (b"\2\x50" + bytes(1022), "section"),
    ],
)
def test_what_is_no_c3d_file(tmp_path, content, reason):
    path = tmp_path / "walk.c3d"
    path.write_bytes(content)
    with pytest.raises(BadRecording, match=rf"walk\.c3d .*{reason}"):
        read(path)


def test_a_damaged_parameter_is_left_out(path):
    content = bytearray(path.read_bytes())
    at = content.index(b"DESCRIPTIONS") + len("DESCRIPTIONS") + 4
    content[at] = 200
    path.write_bytes(content)
    assert_read_whole(path, "parameter section is damaged")


def test_ezc3d_reads_the_same_strings(tmp_path):
    path = write(tmp_path / "walk.c3d", labels=["LASI", "Knie innen", "Gürtel", "C7  "])
    for content in (path.read_bytes(), path.read_bytes().replace("Gü".encode(), b"G\xfc ")):
        path.write_bytes(content)
        theirs, ours = strings_by_ezc3d(path)["POINT"], section_of(path).groups["POINT"]
        assert theirs["LABELS"] == ours["LABELS"] and theirs["UNITS"] == ours["UNITS"]
    assert ours["LABELS"] == ["LASI", "Knie innen", "Gü rtel", "C7"]
