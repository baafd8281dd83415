"""Where declarations contradict each other or are unusable, the most reliable one is used, with a warning."""

import math

import pytest

from markermend.core.recording import BadRecording
from support.c3d_files import (
    assert_read_whole,
    read,
    set_header,
    set_parameter,
    trajectories,
    write,
)


@pytest.fixture
def path(tmp_path):
    return write(tmp_path / "walk.c3d", trajectories(200, 4))


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


def test_frames_as_a_float(tmp_path):
    positions = trajectories(70000, 1)
    path = write(tmp_path / "long.c3d", positions, groups={"POINT": {"FRAMES": 70000.0}})
    path.write_bytes(path.read_bytes().replace(b"LONG_FRAMES", b"PONG_FRAMES").replace(b"ACTUAL_END", b"FACTUAL_EN"))
    assert_read_whole(path, positions=positions)
