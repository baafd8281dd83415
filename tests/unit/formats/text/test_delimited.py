"""Plain CSV files are read by the names of their columns."""

from pathlib import Path

import numpy as np
import pytest

from markermend.core.recording import BadRecording
from support.text_files import MARKERS, assert_positions, make, positions, read


@pytest.mark.parametrize(
    "style",
    [
        "{}_{}",
        "{}.{}",
        "{}:{}",
        "{}-{}",
        "{} {}",
        "{1}_{0}",
        "Ann:{} {}",
        '"{}.{} [mm]"',
        "{}({})",
        "{} [{}]",
        "{} ({}) [mm]",
        '"{}[{}, mm]"',
        "{}{}",
        "{}{}_mm",
    ],
)
def test_plain_column_names(tmp_path: Path, style: str) -> None:
    values = positions()
    titles = ",".join(style.format(name, axis) for name in MARKERS for axis in "XYZ")
    body = make("csv", values).split(b"\r\n")[1:]
    content = b"\n".join([titles.encode(), *(line.split(b",", 3)[-1] for line in body)])
    reading = read(tmp_path, content, rate=50.0)
    assert_positions(reading, values)
    assert [name.rpartition(":")[2] for name in reading.recording.markers] == list(MARKERS)
    assert (reading.recording.rate, reading.recording.first_frame) == (50.0, 1)
    with pytest.raises(BadRecording, match="give its `rate` in the recordings table"):
        read(tmp_path, content)


def test_plain_in_two_lines_with_semicolons_and_decimal_commas(tmp_path: Path) -> None:
    values = positions()
    body = [line.replace(b",", b";").replace(b".", b",") for line in make("csv", values).split(b"\r\n")[1:]]
    head = [";;;" + ";;;".join(MARKERS) + ";;", "frame;time;emg" + ";x;y;z" * 4]
    reading = read(tmp_path, b"\r\n".join([*map(str.encode, head), *body]))
    assert_positions(reading, values)
    assert (reading.recording.rate, reading.recording.first_frame) == (100.0, 101)


def test_plain_units_and_times(tmp_path: Path) -> None:
    content = b"time,A_x,A_y,A_z\n0.0,0.5,1.5,-0.25\n8.3,0.5,1.5,-0.25\n16.7,0.5,1.5,-0.25\n25.0,0.5,1.5,-0.25\n"
    reading = read(tmp_path, content)
    assert (reading.unit, reading.recording.rate) == ("m", 120.0)
    assert len(reading.warnings) == 2 and "milliseconds" in " ".join(reading.warnings)
    named = content.replace(b"time", b"time (ms)").replace(b"A_x", b"A_x_cm")
    reading = read(tmp_path, named)
    assert (reading.unit, reading.recording.rate, reading.warnings) == ("cm", 120.0, ())
    with pytest.raises(BadRecording, match="no usable frame rate"):
        read(tmp_path, content.replace(b"16.7", b"-5").replace(b"8.3", b"-2").replace(b"25.0", b"-9"))
    assert read(tmp_path, content.replace(b"8.3", b"1e-310")).recording.rate > 0
    leap = content.replace(b"25.0", b"250.0")
    assert any("leap" in warning for warning in read(tmp_path, leap).warnings)


def test_plain_incomplete_and_repeated_columns(tmp_path: Path) -> None:
    content = b"time,A_x,A_y,A_z,B_x,B_y,A_x,A_y,A_z\n0,1,2,30,4,5,6,7,80\n0.01,1,2,30,4,5,6,7,80\n"
    reading = read(tmp_path, content)
    assert reading.recording.markers == ("A", "A#2")
    np.testing.assert_array_equal(reading.recording.positions[1], [[1, 2, 30], [6, 7, 80]])
    assert any("'B' do not have all of x, y, z" in warning for warning in reading.warnings)
    with pytest.raises(BadRecording, match="names columns by marker and axis"):
        read(tmp_path, b"1,2,3,4,5,6\n1,2,3,4,5,6\n")


def test_axes_at_the_end_of_names_count_where_none_stands_apart(tmp_path: Path) -> None:
    content = b"time,box,boy,boz,Fx,Fy,Fz,index,flex\n0,1,2,30,4,5,6,1,2\n0.01,1,2,30,4,5,6,2,2\n"
    assert read(tmp_path, content).recording.markers == ("bo",)
    apart = (
        content.replace(b"index,flex", b"A_x,A_y,A_z").replace(b",1,2\n", b",1,2,3\n").replace(b",2,2\n", b",1,2,3\n")
    )
    assert read(tmp_path, apart).recording.markers == ("A",)


def test_columns_in_degrees_are_model_outputs(tmp_path: Path) -> None:
    content = (
        b"time,A_x (mm),A_y (mm),A_z (mm),Knee_x (deg),Knee_y (deg),Knee_z (deg)\n0,1,2,30,4,5,6\n0.01,1,2,30,4,5,6\n"
    )
    two_lines = b",A,,,Knee,,\ntime,X,Y,Z,X,Y,Z\n,mm,mm,mm,deg,deg,deg\n0,1,2,30,4,5,6\n0.01,1,2,30,4,5,6\n"
    for own in (content, two_lines):
        reading = read(tmp_path, own)
        assert (reading.recording.markers, reading.unit, reading.model_outputs) == (("A",), "mm", ("Knee",))
        with pytest.raises(BadRecording, match="'deg' is not known"):
            read(tmp_path, own.replace(b"mm", b"deg"))
        with pytest.raises(BadRecording, match="several units"):
            read(tmp_path, own.replace(b"deg", b"cm"))
