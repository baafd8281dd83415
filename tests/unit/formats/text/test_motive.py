"""Of a Motive CSV the measured markers are read, in any unit of length."""

from pathlib import Path

import pytest

from markermend.core.recording import BadRecording
from support.text_files import assert_positions, make, positions, read


def test_motive_units_and_solved_markers(tmp_path: Path) -> None:
    values, content = positions(), make("motive", positions())
    assert_positions(read(tmp_path, content.replace(b"Units,Meters", b"Units,Centimeters")), values / 100)
    assert_positions(read(tmp_path, content.replace(b"Units,Meters", b"Units,Millimeters")), values / 1000)
    with pytest.raises(BadRecording, match="no column holds a measured marker"):
        read(tmp_path, content.replace(b",Marker", b",Rigid Body Marker"))
    with pytest.raises(BadRecording, match="header of this Motive file"):
        read(tmp_path, content[:200])
