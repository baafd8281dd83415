"""Of a Nexus CSV the section of trajectories is read, and nothing else."""

from pathlib import Path

import pytest

from markermend.core.recording import BadRecording
from support.text_files import assert_positions, make, positions, read


def test_nexus_leaves_other_sections_and_velocities_alone(tmp_path: Path) -> None:
    values = positions()
    content = make("nexus", values)
    reading = read(tmp_path, content.replace(b"Trajectories", b'"Trajectories",,,').replace(b",mm", b",m"))
    assert_positions(reading, values * 1000)
    assert reading.unit == "m" and reading.recording.markers[0] == "Ann:LASI"
    velocity = content.replace(b"X,Y,Z,X,Y,Z,X,Y,Z,X,Y,Z", b"X,Y,Z,X',Y',Z',X,Y,Z,X,Y,Z")
    assert_positions(read(tmp_path, velocity), values[:, [0, 2, 3]])


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
