"""TRC files with odd headers are read with a warning or refused, and new ones hold what was put in."""

from pathlib import Path

import numpy as np
import pytest

from markermend.core.recording import BadRecording, Recording
from markermend.formats.text import reader, trc
from support.text_files import MARKERS, assert_positions, make, positions, read

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
        (b"\t4\tmm", b"\t4\t", "states no unit"),
        (b"100\t100\t30\t4\tmm\t100", b"100\t\t100\t\t30\t\t4\t\t\t\t100", "states no unit"),
        (b"\r\n100\t", b"\r\n50\t", "header says 50 Hz, but the times are evenly spaced at 100 Hz"),
        (b"LASI\t\t\tRASI\t\t\tC7\t\t\tT10", b"LASI   RASI   C7   T10", "separated by blanks"),
    ],
)
def test_trc_damage_is_read_with_a_warning(tmp_path: Path, old: bytes, new: bytes, warning: str) -> None:
    assert TRC.count(old) == 1
    reading = read(tmp_path, TRC.replace(old, new))
    assert_positions(reading, positions())
    assert warning in " ".join(reading.warnings)
    assert reading.recording.first_frame == 101


HEADER = TRC.split(b"\r\n")[1:3]


@pytest.mark.parametrize(
    ("fields", "values"),
    [
        (HEADER[0], HEADER[1].replace(b"\t", b"\t\t")),
        (HEADER[0].replace(b"\t", b"\t\t"), HEADER[1]),
        (HEADER[0].replace(b"\t", b"\t\t"), HEADER[1].replace(b"\t", b"\t\t")),
        (HEADER[0], HEADER[1].replace(b"\tmm", b"\t\t mm")),
        (HEADER[0], b"100\t\t100\t\t30\t\t4\t\tmm"),
    ],
)
def test_doubled_tabs_in_the_header(tmp_path: Path, fields: bytes, values: bytes) -> None:
    reading = read(tmp_path, TRC.replace(HEADER[0], fields).replace(HEADER[1], values))
    assert_positions(reading, positions())
    assert (reading.unit, reading.recording.rate, reading.warnings) == ("mm", 100.0, ())


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


def test_trc_with_commas_blank_lines_and_without_a_line_of_axes(tmp_path: Path) -> None:
    lines = TRC.replace(b"\t", b",").split(b"\r\n")
    content = b"\n".join([*lines[:4], b"", *lines[6:20], b",,,", *lines[20:], b"", b",,,,"])
    assert_positions(read(tmp_path, content), positions())


def test_trc_cells_beyond_the_labels_are_left_alone(tmp_path: Path) -> None:
    values = positions()
    reading = read(tmp_path, TRC.replace(b"T10\t", b"\t"))
    assert_positions(reading, values[:, :3])
    assert any("beyond the last labelled marker" in warning for warning in reading.warnings)


@pytest.mark.parametrize("unit", ["mm", "cm", "m"])
def test_new_trc(tmp_path: Path, unit: str) -> None:
    values = positions()
    recording = Recording(MARKERS, values, 120.0, first_frame=705)
    trc.write_new(tmp_path / "new.trc", recording=recording, unit=unit)
    content = (tmp_path / "new.trc").read_text(encoding="utf-8")
    lines = content.split("\n")
    assert lines[2] == f"120\t120\t30\t4\t{unit}\t120\t705\t30"
    assert lines[5] == "" and lines[-1] == "" and "nan" not in content
    assert {line.count("\t") for line in lines[6:-1]} == {14}
    reading = reader.read(tmp_path / "new.trc", unlabelled=[], rate=None)
    assert_positions(reading, values)
    assert reading.warnings == () and reading.recording.first_frame == 705 and reading.unit == unit


@pytest.mark.parametrize(("frames", "markers"), [(0, 4), (5, 0), (0, 0)])
def test_new_trc_of_nothing_has_a_header(tmp_path: Path, frames: int, markers: int) -> None:
    recording = Recording(MARKERS[:markers], np.empty((frames, markers, 3)), 100.0)
    trc.write_new(tmp_path / "new.trc", recording=recording)
    lines = (tmp_path / "new.trc").read_text(encoding="utf-8").split("\n")
    assert lines[2].split("\t")[2:4] == [str(frames), str(markers)]
    assert len(lines) == 6 + frames + 1
