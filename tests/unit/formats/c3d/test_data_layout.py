"""The data block is found where header and parameters disagree, or one of them is broken."""

import numpy as np
import pytest

from markermend.core.recording import BadRecording
from markermend.formats.c3d.data_layout import locate
from support.c3d_files import (
    assert_read_whole,
    layout_of,
    read,
    section_of,
    set_header,
    set_parameter,
    trajectories,
    write,
)


@pytest.fixture
def path(tmp_path):
    return write(tmp_path / "walk.c3d", trajectories(200, 4))


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


def test_a_data_start_that_neither_declares_is_after_the_parameters(path):
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


def test_absurd_counts_are_refused_with_what_the_file_has_room_for(path):
    size = path.stat().st_size - layout_of(path).start
    for word, name in ((2, "USED"), (5, "FRAMES")):
        set_header(path, word, 65535)
        set_parameter(path, name, 65535, "<H")
    words = f"declares 65535 of 65535 points, {65535 * 16} bytes each, and has {size} bytes for them"
    with pytest.raises(BadRecording, match=rf"walk\.c3d holds no complete frame: it {words}"):
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


def test_no_points(tmp_path):
    path = write(tmp_path / "analog.c3d", np.zeros((20, 0, 3)), labels=[], analog=np.ones((20, 2, 3)))
    with pytest.raises(BadRecording, match="no 3-D data"):
        read(path)
