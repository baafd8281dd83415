"""The ending of a file's name decides which module reads and writes it."""

import numpy as np
import pytest

from markermend.core.recording import BadRecording
from markermend.formats import files
from support.c3d_files import write


def test_a_file_is_dispatched_by_its_ending(tmp_path):
    source = write(tmp_path / "WALK.C3D")
    assert files.read(source, unlabelled=[], rate=None).recording.rate == 100
    assert files.read(source, unlabelled=[], rate=50.0).recording.rate == 50
    with pytest.raises(BadRecording, match="impossible"):
        files.read(source, unlabelled=[], rate=0.0)
    with pytest.raises(BadRecording, match="is not there"):
        files.read(tmp_path / "run.c3d", unlabelled=[], rate=None)
    positions = files.read(source, unlabelled=[], rate=None).recording.positions
    changed = np.zeros(positions.shape[:2], bool)
    changed[3, 1] = True
    result = files.write_back(
        source, tmp_path / "out.c3d", format="c3d", positions=positions + 1, changed=changed, columns=range(4)
    )
    assert result.samples == 1
    after = files.read(tmp_path / "out.c3d", unlabelled=[], rate=None).recording.positions
    np.testing.assert_allclose(after - positions, changed[..., None] * np.ones(3), atol=1e-4)


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("walk.trc.gz", "walk.trc.gz is compressed: unpack it"),
        ("walk.C3D.GZ", "is compressed: unpack it"),
        ("walk.trb", "is a binary TRB file: export it from Cortex as C3D or TRC"),
        ("walk.tak", "is a take of Motive"),
        ("walk.xlsx", "is a spreadsheet: save it as CSV"),
        ("walk.mov", "ends in .mov, which is not a known format"),
        ("walk", "ends in nothing, which is not a known format"),
    ],
)
def test_what_cannot_be_read_is_refused_with_what_to_do(tmp_path, name, reason):
    (tmp_path / name).write_bytes(b"anything")
    with pytest.raises(BadRecording, match=reason):
        files.read(tmp_path / name, unlabelled=[], rate=None)
