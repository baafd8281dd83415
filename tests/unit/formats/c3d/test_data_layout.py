"""The data block is found where header and parameters disagree, or one of them is broken."""

import math

import numpy as np
import pytest

from markermend.core.recording import BadRecording
from markermend.formats.c3d import parameters, reader
from markermend.formats.c3d.data_layout import locate
from support.c3d_files import UNLABELLED, section_of, set_header, set_parameter, trajectories, write


@pytest.fixture
def path(tmp_path):
    return write(tmp_path / "walk.c3d", trajectories(200, 4))


def read(path):
    return reader.read(path, unlabelled=UNLABELLED)


def assert_read_whole(path, *words, positions=None):
    reading = read(path)
    np.testing.assert_array_equal(reading.recording.positions, trajectories(200, 4) if positions is None else positions)
    warnings = " ".join(reading.warnings)
    assert all(word in warnings for word in words) and bool(words) == bool(warnings), warnings
    return reading.recording


def test_parameters_win_over_a_wrong_header(path):
    set_header(path, 2, 7)
    set_header(path, 3, 12)
    set_header(path, 5, 150)
    set_header(path, 7, 0.1, "<f")
    set_header(path, 9, 1)
    assert_read_whole(path)


@pytest.mark.parametrize(
    ("name", "value", "code"), [("USED", 5, "<h"), ("FRAMES", 150, "<h"), ("SCALE", 0.1, "<f"), ("USED", 0, "<h")]
)
def test_the_header_wins_where_only_it_fits_the_file(path, name, value, code):
    if name == "FRAMES":
        set_parameter(path, "ACTUAL_END_FIELD", 150, "<h")
    set_parameter(path, name, value, code)
    assert_read_whole(path, "disagree")


def test_analog_samples_are_found_by_either(tmp_path):
    path = write(tmp_path / "walk.c3d", trajectories(200, 4), analog=np.ones((200, 10, 3)))
    set_header(path, 3, 0)
    assert_read_whole(path)
    set_header(path, 3, 30)
    set_parameter(path, "USED", 4, "<h")
    content = path.read_bytes()
    assert content.count(b"ANALOG") == 1
    assert_read_whole(path)


@pytest.mark.parametrize("value", [0, 1, 30000])
def test_data_start_falls_back_to_the_header(path, value):
    set_parameter(path, "DATA_START", value, "<h")
    assert_read_whole(path)


def test_data_start_that_neither_knows_is_after_the_parameters(path):
    set_parameter(path, "DATA_START", 0, "<h")
    set_header(path, 9, 0)
    assert_read_whole(path)


def test_a_truncated_file_is_read_as_far_as_it_goes(path):
    layout = locate(section_of(path), path.stat().st_size, path.name)
    path.write_bytes(path.read_bytes()[: layout.start + 29 * layout.stride + 7])
    assert_read_whole(path, "truncated", "29 of the 200", positions=trajectories(200, 4)[:29])
    path.write_bytes(path.read_bytes()[: layout.start + 5])
    with pytest.raises(BadRecording, match=r"walk\.c3d holds no complete frame"):
        read(path)


def test_a_truncated_file_whose_header_is_wrong_is_read_by_the_parameters(path):
    set_header(path, 3, 12)
    layout = locate(section_of(path), path.stat().st_size, path.name)
    path.write_bytes(path.read_bytes()[: layout.start + 29 * layout.stride])
    assert_read_whole(path, "neither fits", "29 of the 200", positions=trajectories(200, 4)[:29])


def test_a_file_that_ends_in_its_parameters_is_refused(path):
    path.write_bytes(path.read_bytes()[:900])
    with pytest.raises(BadRecording, match=r"walk\.c3d"):
        read(path)


def test_more_than_65535_frames(tmp_path):
    positions = trajectories(70000, 1)
    path = write(tmp_path / "long.c3d", positions)
    assert assert_read_whole(path, positions=positions).frames == 70000


@pytest.mark.parametrize("stored", [65535, 70000 - 65536])
def test_a_frame_count_that_16_bits_cannot_hold(tmp_path, stored):
    positions = trajectories(70000, 1)
    path = write(tmp_path / "long.c3d", positions, groups={"TRIAL": {}})
    content = path.read_bytes().replace(b"LONG_FRAMES", b"PONG_FRAMES").replace(b"ACTUAL_END", b"FACTUAL_EN")
    path.write_bytes(content)
    set_parameter(path, "FRAMES", stored, "<H")
    set_header(path, 5, stored)
    assert_read_whole(path, "too small", positions=positions)


def test_frames_as_a_float(tmp_path):
    positions = trajectories(70000, 1)
    path = write(tmp_path / "long.c3d", positions, groups={"POINT": {"FRAMES": 70000.0}})
    path.write_bytes(path.read_bytes().replace(b"LONG_FRAMES", b"PONG_FRAMES").replace(b"ACTUAL_END", b"FACTUAL_EN"))
    assert_read_whole(path, positions=positions)


@pytest.mark.parametrize("first", [1, 0, 705, 65535, 100000])
def test_first_frame(tmp_path, first):
    path = write(tmp_path / "walk.c3d", trajectories(200, 4), first_frame=first)
    if first == 100000:
        set_header(path, 4, first % 65536)
    assert assert_read_whole(path).first_frame == first


def test_first_frames_that_disagree(path):
    set_header(path, 4, 31)
    set_header(path, 5, 230)
    assert assert_read_whole(path, "31 by the header and 1 by TRIAL").first_frame == 1
    set_parameter(path, "ACTUAL_START_FIELD", 7, "<h")
    assert assert_read_whole(path, "7 by TRIAL", "31 is used").first_frame == 31


def test_rates_that_disagree_or_fail(path):
    set_parameter(path, "RATE", 250.0, "<f")
    assert assert_read_whole(path, "POINT:RATE, which is used").rate == 250
    set_parameter(path, "RATE", 0.0, "<f")
    assert assert_read_whole(path, "header's 100 Hz").rate == 100
    set_header(path, 11, math.nan, "<f")
    assert math.isnan(assert_read_whole(path).rate)


def test_an_integer_file_without_scale_is_refused(tmp_path):
    path = write(tmp_path / "walk.c3d", storage="pc_int")
    set_parameter(path, "SCALE", 0.0, "<f")
    assert read(path).recording.frames == 20
    set_header(path, 7, math.nan, "<f")
    with pytest.raises(BadRecording, match="POINT:SCALE"):
        read(path)


def test_no_points(tmp_path):
    path = write(tmp_path / "analog.c3d", np.zeros((20, 0, 3)), labels=[], analog=np.ones((20, 2, 3)))
    with pytest.raises(BadRecording, match="no 3-D data"):
        read(path)


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
