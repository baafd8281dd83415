"""The recordings can be read, and have a gap and artifacts."""

import numpy as np
import pytest

from faults.data_set import FRAMES, MARKERS, NAMES, write_data_set
from markermend import api


def test_equal_calls_give_equal_bytes(tmp_path):
    for folder in ("one", "other"):
        write_data_set(tmp_path / folder)
    assert [(tmp_path / "one" / name).read_bytes() for name in NAMES] == [
        (tmp_path / "other" / name).read_bytes() for name in NAMES
    ]


@pytest.mark.parametrize("name", NAMES)
def test_each_recording_has_a_gap(tmp_path, name):
    write_data_set(tmp_path)
    recording = api.read(tmp_path / name)
    assert recording.markers == MARKERS and recording.frames == FRAMES
    assert np.flatnonzero(recording.missing[:, 1]).tolist() == list(range(125, 137))
