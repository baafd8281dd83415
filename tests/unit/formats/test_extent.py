"""How much there is in a recording is found from its beginning."""

import numpy as np
import pytest

from markermend.core.recording import BadRecording
from markermend.formats import extent
from markermend.formats.extent import Extent, find_extent
from support import c3d_files, text_files


def test_of_c3d_files_all_is_known(tmp_path):
    path = c3d_files.write(tmp_path / "walk.c3d", c3d_files.trajectories(500, 7), rate=250.0)
    assert find_extent(path) == Extent(500, 7, 2.0) and find_extent(path).samples == 3500
    assert find_extent(path, rate=100.0).seconds == 5.0


@pytest.mark.parametrize("format", text_files.FORMATS)
def test_of_text_files_the_length_is_extrapolated(tmp_path, monkeypatch, format):
    path = tmp_path / f"walk.{ {'trc': 'trc', 'qtm': 'tsv'}.get(format, 'csv') }"
    path.write_bytes(text_files.make(format, text_files.positions(3000)))
    whole = find_extent(path)
    assert whole.frames == pytest.approx(3000, rel=0.01) and whole.trajectories == len(text_files.MARKERS) + (
        format == "motive"
    )
    assert whole.seconds == pytest.approx(30.0, rel=0.01)
    monkeypatch.setattr(extent, "BEGINNING", 20_000)
    part = find_extent(path)
    assert part.frames == pytest.approx(3000, rel=0.02) and part.trajectories == whole.trajectories


@pytest.mark.parametrize("name", ["walk.c3d", "walk.trc", "walk.csv"])
def test_what_is_no_recording_is_refused(tmp_path, name):
    (tmp_path / name).write_bytes(b"nothing\nof the kind\n")
    with pytest.raises(BadRecording):
        find_extent(tmp_path / name)


def test_a_file_without_a_rate_has_no_duration(tmp_path):
    path = c3d_files.write(tmp_path / "walk.c3d", rate=1.0)
    c3d_files.set_parameter(path, "RATE", 0.0, "<f")
    c3d_files.set_header(path, 11, 0.0, "<f")
    assert np.isnan(find_extent(path).seconds)
