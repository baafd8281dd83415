"""The real text files: what is read of them, what a patch changes, and which are refused."""

from pathlib import Path

import numpy as np
import pytest

from markermend.core.recording import BadRecording
from markermend.formats.text import reader

REAL = {
    "clean/STS1.trc": ("trc", (1399, 51), 100.0, 1, "m", {}),
    "raw/flicker_ee8cdcfd_markers.trc": ("trc", (1854, 41), 100.0, 1, "mm", {"not finite": 562}),
    "text/nexus_markers.csv": ("nexus", (580, 51), 100.0, 1, "mm", {"blank": 305}),
    "text/Measurement2.tsv": ("qtm", (2000, 16), 100.0, 1, "mm", {}),
    "text/sample_optitrack_take.csv": ("motive", (250, 3), 120.0, 0, "m", {}),
    "text/127_07.csv": ("csv", (145, 41), 60.0, 1, "mm", {}),
    "odd/Gait.trc": ("trc", (487, 33), 100.0, 1, "mm", {"blank": 7306}),
    "odd/markers.trc": ("trc", (93, 51), 100.0, 1, "mm", {}),
    "odd/step_width.trc": ("trc", (501, 32), 100.0, 1, "mm", {}),
    "odd/WeirdFormatTests_markers.trc": ("trc", (281, 61), 100.0, 1, "m", {"zero": 71}),
}

WARNED = {
    "odd/Gait.trc": "66 markers and 33 are labelled",
    "odd/markers.trc": "652 frames and the file has 93",
    "odd/step_width.trc": "27107 frames and the file has 501",
    "odd/WeirdFormatTests_markers.trc": "do not stand above their columns",
    "text/127_07.csv": "states no unit",
}


@pytest.mark.data
@pytest.mark.parametrize("name", REAL)
def test_real_files(data: Path, tmp_path: Path, name: str) -> None:
    format, shape, rate, first_frame, unit, missing = REAL[name]
    path = data / name
    reading = reader.read(path, unlabelled=[r"\*\d+"], rate=60.0 if format == "csv" else None)
    recording = reading.recording
    assert (reading.format, recording.positions.shape[:2], recording.rate) == (format, shape, rate)
    assert (recording.first_frame, reading.unit, reading.missing) == (first_frame, unit, missing)
    assert len(reading.warnings) > 0 if name in WARNED else reading.warnings == ()
    assert WARNED.get(name, "") in " ".join(reading.warnings)

    changed = ~recording.missing & (np.random.default_rng(8).random(recording.missing.shape) < 0.01)
    wanted = recording.positions + 1.25 * changed[:, :, None]
    target = tmp_path / path.name
    result = reader.patch(path, target, format=format, positions=wanted, changed=changed, columns=reading.columns)
    again = reader.read(target, unlabelled=[r"\*\d+"], rate=rate).recording.positions
    assert result.samples == changed.sum() and result.refused == ()
    np.testing.assert_allclose(again, wanted, rtol=0, atol=0.000501)
    np.testing.assert_array_equal(again[~changed], recording.positions[~changed])


@pytest.mark.data
@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("odd/Empty.trc", "empty"),
        ("odd/Truncated.trc", "cut off"),
        ("text/127_07.csv", "give its `rate`"),
        ("odd/gait-raw.c3d", "names columns"),
    ],
)
def test_real_files_that_are_refused(data: Path, name: str, reason: str) -> None:
    with pytest.raises(BadRecording, match=reason):
        reader.read(data / name, unlabelled=[], rate=None)
