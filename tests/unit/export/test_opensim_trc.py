"""A TRC file is as OpenSim reads it: its rules (TRCFileAdapter, MarkerData) are those of `opensim_reads`."""

from pathlib import Path

import numpy as np
import pytest

from markermend.core.recording import Recording
from markermend.export.opensim_trc import write_opensim_trc
from markermend.formats.units import MILLIMETRES
from markermend.options.reporting import ExportOptions


def tokens(line: str) -> list[str]:
    """The cells of a line as OpenSim counts them: a tab ends a cell, and nothing behind the last one is no cell."""
    cells = line.split("\t")
    return cells[:-1] if cells[-1] == "" else cells


def opensim_reads(path: Path) -> tuple[dict[str, str], list[str], np.ndarray, np.ndarray]:
    """Header, labels, times and positions (NaN where blank) by the rules of OpenSim's reader, which is strict."""
    lines = path.read_text(encoding="utf-8").split("\n")
    assert tokens(lines[0])[:3] == ["PathFileType", "4", "(X/Y/Z)"]
    keys, values = tokens(lines[1]), tokens(lines[2])
    assert len(keys) == len(values) and "" not in values
    header = dict(zip(keys, values, strict=True))
    count = int(header["NumMarkers"])
    titles = lines[3].split("\t")
    assert titles[:2] == ["Frame#", "Time"]
    labels = [title for title in titles[2:] if title]
    assert len(labels) == count and titles[2::3][:count] == labels
    assert [cell for cell in lines[4].split("\t") if cell] == [f"{a}{i}" for i in range(1, count + 1) for a in "XYZ"]
    assert lines[5] == "" and lines[-1] == ""
    rows = [tokens(line) for line in lines[6:-1]]
    assert len(rows) == int(header["NumFrames"])
    assert {len(row) for row in rows} <= {2 + 3 * count}
    cells = np.array([[float(cell) if cell else np.nan for cell in row] for row in rows])
    return header, labels, cells[:, 1], cells[:, 2:].reshape(len(rows), count, 3)


def recording(**facts: object) -> Recording:
    positions = np.round(np.random.default_rng(3).uniform(0, 1500, (20, 3, 3)), 4)
    positions[4:8, 1] = np.nan
    positions[5:9, 2] = np.nan
    positions[12] = np.nan
    return Recording(("Ann:LASI", "C7", "left heel"), positions, 120.0, 705, facts)


@pytest.mark.parametrize("unit", ["mm", "m"])
def test_opensim_reads_what_was_written(tmp_path: Path, unit: str) -> None:
    own = recording(source={"screen": ["+Y", "+Z"]})
    stated = write_opensim_trc(tmp_path / "walk.trc", own, ExportOptions(trc_unit=unit))
    header, labels, times, positions = opensim_reads(tmp_path / "walk.trc")
    assert labels == list(own.markers)
    assert header == {
        **dict.fromkeys(["DataRate", "CameraRate", "OrigDataRate"], "120"),
        **dict.fromkeys(["NumFrames", "OrigNumFrames"], "20"),
        **{"NumMarkers": "3", "Units": unit, "OrigDataStartFrame": "705"},
    }
    np.testing.assert_allclose(times, np.arange(20) / 120, rtol=0, atol=1e-6)
    wanted = own.positions[..., [1, 2, 0]] / MILLIMETRES[unit]
    np.testing.assert_allclose(positions, wanted, rtol=0, atol=1e-6)
    assert stated == {"unit": unit, "x": "+Y", "y": "+Z", "z": "+X", "reason": "as the file states"}


@pytest.mark.parametrize(("frames", "markers"), [(1, 1), (1, 3), (20, 1)])
def test_one_frame_and_one_marker(tmp_path: Path, frames: int, markers: int) -> None:
    own = recording()
    few = Recording(own.markers[-markers:], own.positions[4 : 4 + frames, -markers:], 100.0)
    write_opensim_trc(tmp_path / "walk.trc", few, ExportOptions(trc_vertical_axis="+Y"))
    _, labels, _, positions = opensim_reads(tmp_path / "walk.trc")
    assert labels == list(few.markers)
    np.testing.assert_allclose(positions, few.positions, rtol=0, atol=1e-5)
