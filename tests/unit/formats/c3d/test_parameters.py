"""Header and parameters are read with every length checked; ezc3d sees only sound sections."""

import pytest

from markermend.core.recording import BadRecording
from markermend.formats.c3d import parameters
from support.c3d_files import assert_read_whole, read, section_of, trajectories, write


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


def test_a_damaged_parameter_is_left_out_and_never_reaches_ezc3d(path, monkeypatch):
    content = bytearray(path.read_bytes())
    at = content.index(b"DESCRIPTIONS") + len("DESCRIPTIONS") + 4
    content[at] = 200
    path.write_bytes(content)
    monkeypatch.setattr(parameters, "strings_by_ezc3d", lambda *_: pytest.fail("ezc3d got a damaged section"))
    assert_read_whole(path, "parameter section is damaged")


def test_ezc3d_reads_sound_sections_as_our_parser_does(path, monkeypatch):
    both = section_of(path)
    monkeypatch.setattr(parameters, "strings_by_ezc3d", lambda *_: {})
    ours = section_of(path)
    assert ours.groups["POINT"] == both.groups["POINT"]
    assert "EZC3D" not in ours.groups


def test_labels_come_from_ezc3d_where_it_can_read_the_file(path, monkeypatch):
    monkeypatch.setattr(parameters, "strings_by_ezc3d", lambda *_: {"POINT": {"LABELS": ["W", "X", "Y", "Z"]}})
    assert read(path).recording.markers == tuple("WXYZ")
