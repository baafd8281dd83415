"""The outline of a recording is read from its beginning."""

import numpy as np
import pytest

from markermend.core.recording import BadRecording
from markermend.formats import outline
from markermend.formats.outline import Outline, read_outline
from support import c3d_files, text_files


def test_of_c3d_files_all_is_known(tmp_path):
    path = c3d_files.write(tmp_path / "walk.c3d", c3d_files.trajectories(500, 7), rate=250.0)
    assert (
        read_outline(path) == Outline(tuple(f"M{m}" for m in range(7)), 500, 2.0) and read_outline(path).samples == 3500
    )
    assert read_outline(path, rate=100.0).seconds == 5.0


@pytest.mark.parametrize("format", text_files.FORMATS)
def test_of_text_files_the_length_is_extrapolated(tmp_path, monkeypatch, format):
    path = tmp_path / f"walk.{ {'trc': 'trc', 'qtm': 'tsv'}.get(format, 'csv') }"
    path.write_bytes(text_files.make(format, text_files.positions(3000)))
    whole = read_outline(path)
    assert whole.frames == pytest.approx(3000, rel=0.01) and len(whole.names) == len(text_files.MARKERS) + (
        format == "motive"
    )
    assert whole.seconds == pytest.approx(30.0, rel=0.01)
    monkeypatch.setattr(outline, "BEGINNING", 20_000)
    part = read_outline(path)
    assert part.frames == pytest.approx(3000, rel=0.02) and part.names == whole.names


@pytest.mark.parametrize("name", ["walk.c3d", "walk.trc", "walk.csv"])
def test_what_is_no_recording_is_refused(tmp_path, name):
    (tmp_path / name).write_bytes(b"nothing\nof the kind\n")
    with pytest.raises(BadRecording):
        read_outline(tmp_path / name)


def test_a_file_without_a_rate_has_no_duration(tmp_path):
    path = c3d_files.write(tmp_path / "walk.c3d", rate=1.0)
    c3d_files.set_parameter(path, "RATE", 0.0, "<f")
    c3d_files.set_header(path, 11, 0.0, "<f")
    assert np.isnan(read_outline(path).seconds)
