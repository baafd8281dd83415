"""QTM TSV files are read with and without titles, frames and times."""

from pathlib import Path

import pytest

from markermend.core.recording import BadRecording
from support.text_files import assert_positions, make, positions, read


def test_qtm_without_titles_frames_or_times(tmp_path: Path) -> None:
    values = positions()
    lines = make("qtm", values).split(b"\r\n")
    untitled = b"\r\n".join([*lines[:7], *lines[8:]])
    assert_positions(read(tmp_path, untitled), values)
    assert read(tmp_path, untitled).recording.first_frame == 101
    bare = b"\n".join([*lines[:7], *(line.split(b"\t", 2)[-1] for line in lines[8:])])
    reading = read(tmp_path, bare.replace(b"0.000", b""))
    assert_positions(reading, values)
    assert (reading.recording.first_frame, reading.missing) == (1, {"blank": 4})


@pytest.mark.parametrize("wrong", [(b"INCLUDED\t3D", b"INCLUDED\t6D"), (b"MARKER_NAMES", b"BODY_NAMES")])
def test_qtm_without_trajectories_is_refused(tmp_path: Path, wrong: tuple[bytes, bytes]) -> None:
    with pytest.raises(BadRecording, match="no 3-D trajectories"):
        read(tmp_path, make("qtm", positions()).replace(*wrong))
