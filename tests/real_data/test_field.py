"""Files that failed once, each for its whole kind."""

import pytest

from markermend import api

TOO_LITTLE = [
    ("finger_tap.trc", {"Thumb", "Index"}),
    ("clip50.trc", {"M2", "M5"}),
    ("ten_frames.c3d", set()),
]
"""Recordings that are too small for a body mesh, and the markers with exchanged labels."""


@pytest.mark.data
@pytest.mark.parametrize(("name", "exchanged"), TOO_LITTLE)
def test_too_little_for_a_mesh(data, name, exchanged):
    """Exchanged labels alone can be found; the markers that nothing else can judge are named."""
    recording = api.read(data / "field" / name)
    cleaned = api.clean(recording)
    assert {change.marker for change in cleaned.changes if change.method == "swap"} == exchanged
    assert len(cleaned.changes) == len(exchanged)
    named = {marker for text in cleaned.mesh.warnings for marker in text.split(": ")[-1].split(", ")}
    assert set(recording.markers) <= named
