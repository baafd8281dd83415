"""What each text format's layout makes of the variants and the damage that files of it have."""

from pathlib import Path

import numpy as np
import pytest

from markermend.core.recording import BadRecording, Recording
from markermend.formats.reading import Reading
from markermend.formats.text import reader, trc
from support.text_files import MARKERS, make, positions


def read(folder: Path, content: bytes, *, name: str = "walk.txt", rate: float | None = None) -> Reading:
    path = folder / name
    path.write_bytes(content)
    return reader.read(path, unlabelled=[], rate=rate)


def same(reading: Reading, values: np.ndarray) -> None:
    np.testing.assert_allclose(reading.recording.positions, values, rtol=0, atol=1e-9)


TRC = make("trc", positions())


@pytest.mark.parametrize(
    ("old", "new", "warning"),
    [
        (b"\t30\t4\tmm", b"\t999999999\t4\tmm", "999999999 frames and the file has 30"),
        (b"\t30\t4\tmm", b"\t30\t66\tmm", "66 markers and 4 are labelled"),
        (b"\t30\t4\tmm", b"\t30\t\tmm", "no markers and 4 are labelled"),
        (b"Time\tLASI\t\t\tRASI\t\t\tC7\t\t\tT10", b"Time\t\tLASI\t\tRASI\t\tC7\t\tT10", "in order"),
        (b"LASI\t\t\tRASI\t\t\tC7\t\t\tT10", b"LASI\tRASI\tC7\tT10", "in order"),
        (b"RASI", b"LASI", "of several trajectories"),
        (b"\r\n103\t", b"\r\n102\t", "1 repeat"),
        (b"\r\n103\t", b"\r\n203\t", "1 go back, 1 leap"),
        (b"\r\n103\t", b"\r\nx\t", "no frame number"),
        (b"\t4\tmm", b"\t4\t", "names no unit"),
        (b"\r\n100\t", b"\r\n50\t", "time column says 100 Hz; 50 Hz is used"),
    ],
)
def test_trc_damage_is_read_with_a_warning(tmp_path: Path, old: bytes, new: bytes, warning: str) -> None:
    assert TRC.count(old) == 1
    reading = read(tmp_path, TRC.replace(old, new))
    same(reading, positions())
    assert warning in " ".join(reading.warnings)
    assert reading.recording.first_frame == 101


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        (b"DataRate", b"Rate", "do not name DataRate"),
        (TRC[TRC.index(b"Frame#") :], b"", "cut off"),
        (b"Time\tLASI\t\t\tRASI\t\t\tC7\t\t\tT10", b"Time\tLASI\tRASI\tC7", "do not stand above columns"),
        (b"\t4\tmm", b"\t4\tfurlong", "'furlong' is not known"),
        (b"LASI\t\t\tRASI\t\t\tC7\t\t\tT10", b"", "no marker is labelled"),
    ],
)
def test_trc_damage_that_is_refused(tmp_path: Path, old: bytes, new: bytes, reason: str) -> None:
    with pytest.raises(BadRecording, match=reason):
        read(tmp_path, TRC.replace(old, new), name="walk.trc")


@pytest.mark.parametrize("rate", [b"nan", b"0", b"inf", b"1e999", b"a hundred"])
def test_no_rate_anywhere_is_refused(tmp_path: Path, rate: bytes) -> None:
    content = make("trc", positions(frames=10)[:1]).replace(b"\r\n100\t", b"\r\n" + rate + b"\t")
    with pytest.raises(BadRecording, match="no usable frame rate"):
        read(tmp_path, content)
    for wrong in (0.0, -5.0, float("nan"), float("inf")):
        with pytest.raises(BadRecording, match="no usable frame rate"):
            read(tmp_path, TRC, rate=wrong)


@pytest.mark.parametrize("rate", [b"0", b"-100", b"inf", b"1e999", b""])
def test_a_rate_that_is_none_gives_way_to_the_times(tmp_path: Path, rate: bytes) -> None:
    reading = read(tmp_path, TRC.replace(b"\r\n100\t", b"\r\n" + rate + b"\t"))
    assert reading.recording.rate == 100.0
    assert read(tmp_path, TRC, rate=200.0).recording.rate == 200.0


def test_trc_with_commas_blank_lines_and_without_a_line_of_axes(tmp_path: Path) -> None:
    lines = TRC.replace(b"\t", b",").split(b"\r\n")
    content = b"\n".join([*lines[:4], b"", *lines[6:20], b",,,", *lines[20:], b"", b",,,,"])
    same(read(tmp_path, content), positions())


def test_trc_cells_beyond_the_labels_are_left_alone(tmp_path: Path) -> None:
    values = positions()
    reading = read(tmp_path, TRC.replace(b"T10\t", b"\t"))
    same(reading, values[:, :3])
    assert any("beyond the last labelled marker" in warning for warning in reading.warnings)


@pytest.mark.parametrize("unit", ["mm", "cm", "m"])
def test_new_trc(tmp_path: Path, unit: str) -> None:
    values = positions()
    recording = Recording(MARKERS, values, 120.0, first_frame=705)
    trc.write_new(tmp_path / "new.trc", recording=recording, unit=unit)
    content = (tmp_path / "new.trc").read_text()
    lines = content.split("\n")
    assert lines[2] == f"120\t120\t30\t4\t{unit}\t120\t705\t30"
    assert lines[5] == "" and lines[-1] == "" and "nan" not in content
    assert {line.count("\t") for line in lines[6:-1]} == {13}
    reading = reader.read(tmp_path / "new.trc", unlabelled=[], rate=None)
    same(reading, values)
    assert reading.warnings == () and reading.recording.first_frame == 705 and reading.unit == unit


@pytest.mark.parametrize(("frames", "markers"), [(0, 4), (5, 0), (0, 0)])
def test_new_trc_of_nothing_has_a_header(tmp_path: Path, frames: int, markers: int) -> None:
    recording = Recording(MARKERS[:markers], np.empty((frames, markers, 3)), 100.0)
    trc.write_new(tmp_path / "new.trc", recording=recording)
    lines = (tmp_path / "new.trc").read_text().split("\n")
    assert lines[2].split("\t")[2:4] == [str(frames), str(markers)]
    assert len(lines) == 6 + frames + 1


def test_nexus_leaves_other_sections_and_velocities_alone(tmp_path: Path) -> None:
    values = positions()
    content = make("nexus", values)
    reading = read(tmp_path, content.replace(b"Trajectories", b'"Trajectories",,,').replace(b",mm", b",m"))
    same(reading, values * 1000)
    assert reading.unit == "m" and reading.recording.markers[0] == "Ann:LASI"
    velocity = content.replace(b"X,Y,Z,X,Y,Z,X,Y,Z,X,Y,Z", b"X,Y,Z,X',Y',Z',X,Y,Z,X,Y,Z")
    same(read(tmp_path, velocity), values[:, [0, 2, 3]])


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        (b"Frame,Sub Frame,X,Y,Z,X", b"Frame,Sub Frame,A,B,C,D", None),
        (b",mm,mm,mm,mm", b",m,m,m,mm", "several units"),
        (b"Sub Frame" + b",X,Y,Z" * 4, b"Sub Frame", "no line of axes"),
        (b"Trajectories\r\n100", b"Trajectories\r\nfast", "no usable frame rate"),
    ],
)
def test_nexus_damage(tmp_path: Path, old: bytes, new: bytes, reason: str | None) -> None:
    content = make("nexus", positions())
    assert old in content
    if reason is None:
        assert len(read(tmp_path, content.replace(old, new)).recording.markers) == 2
        return
    with pytest.raises(BadRecording, match=reason):
        read(tmp_path, content.replace(old, new))


def test_motive_units_and_solved_markers(tmp_path: Path) -> None:
    values, content = positions(), make("motive", positions())
    same(read(tmp_path, content.replace(b"Units,Meters", b"Units,Centimeters")), values / 100)
    same(read(tmp_path, content.replace(b"Units,Meters", b"Units,Millimeters")), values / 1000)
    with pytest.raises(BadRecording, match="no column holds a measured marker"):
        read(tmp_path, content.replace(b",Marker", b",Rigid Body Marker"))
    with pytest.raises(BadRecording, match="header of this Motive file"):
        read(tmp_path, content[:200])


def test_qtm_without_titles_frames_or_times(tmp_path: Path) -> None:
    values = positions()
    lines = make("qtm", values).split(b"\r\n")
    untitled = b"\r\n".join([*lines[:7], *lines[8:]])
    same(read(tmp_path, untitled), values)
    assert read(tmp_path, untitled).recording.first_frame == 101
    bare = b"\n".join([*lines[:7], *(line.split(b"\t", 2)[-1] for line in lines[8:])])
    reading = read(tmp_path, bare.replace(b"0.000", b""))
    same(reading, values)
    assert (reading.recording.first_frame, reading.missing) == (1, {"blank": 4})


@pytest.mark.parametrize("wrong", [(b"INCLUDED\t3D", b"INCLUDED\t6D"), (b"MARKER_NAMES", b"BODY_NAMES")])
def test_qtm_without_trajectories_is_refused(tmp_path: Path, wrong: tuple[bytes, bytes]) -> None:
    with pytest.raises(BadRecording, match="no 3-D trajectories"):
        read(tmp_path, make("qtm", positions()).replace(*wrong))


@pytest.mark.parametrize("style", ["{}_{}", "{}.{}", "{}:{}", "{}-{}", "{} {}", "{1}_{0}", "Ann:{} {}", '"{}.{} [mm]"'])
def test_plain_column_names(tmp_path: Path, style: str) -> None:
    values = positions()
    titles = ",".join(style.format(name, axis) for name in MARKERS for axis in "XYZ")
    body = make("csv", values).split(b"\r\n")[1:]
    content = b"\n".join([titles.encode(), *(line.split(b",", 3)[-1] for line in body)])
    reading = read(tmp_path, content, rate=50.0)
    same(reading, values)
    assert [name.rpartition(":")[2] for name in reading.recording.markers] == list(MARKERS)
    assert (reading.recording.rate, reading.recording.first_frame) == (50.0, 1)
    with pytest.raises(BadRecording, match="give its `rate` in the recordings table"):
        read(tmp_path, content)


def test_plain_in_two_lines_with_semicolons_and_decimal_commas(tmp_path: Path) -> None:
    values = positions()
    body = [line.replace(b",", b";").replace(b".", b",") for line in make("csv", values).split(b"\r\n")[1:]]
    head = [";;;" + ";;;".join(MARKERS) + ";;", "frame;time;emg" + ";x;y;z" * 4]
    reading = read(tmp_path, b"\r\n".join([*map(str.encode, head), *body]))
    same(reading, values)
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
