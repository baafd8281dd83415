"""Text files damaged at random: a sane reading or a clear refusal, never anything else."""

from pathlib import Path

import numpy as np
import pytest

from markermend.core.recording import BadRecording
from markermend.formats.reading import Reading
from markermend.formats.text import reader
from markermend.formats.units import LARGEST, MILLIMETRES
from support.text_files import FORMATS, make, positions


def outcome(path: Path, content: bytes) -> Reading | str:
    """The reading of a file's bytes, checked, or the reason why it was refused."""
    path.write_bytes(content)
    try:
        reading = reader.read(path, unlabelled=[r"\*\d+"], rate=None)
    except BadRecording as refusal:
        return str(refusal)
    recording = reading.recording
    assert 0 < recording.rate < np.inf and recording.frames > 0 and len(recording.markers) == len(reading.columns)
    gone = np.isnan(recording.positions)
    assert (gone.any(axis=2) == gone.all(axis=2)).all() and not gone.all()
    assert np.nanmax(np.abs(recording.positions)) < LARGEST * MILLIMETRES[reading.unit]
    assert sum(reading.missing.values()) == gone.all(axis=2).sum()
    return reading


def patch_one(path: Path, reading: Reading) -> None:
    """Change one sample of a file and read it back: that sample and no other is different."""
    recording = reading.recording
    wanted, changed = recording.positions.copy(), np.zeros(recording.missing.shape, bool)
    row, marker = np.argwhere(~recording.missing)[-1]
    wanted[row, marker], changed[row, marker] = (12.5, -700.25, 1000), True
    target = path.with_name("patched.txt")
    reader.patch(path, target, format=reading.format, positions=wanted, changed=changed, columns=reading.columns)
    again = reader.read(target, unlabelled=[r"\*\d+"], rate=recording.rate)
    np.testing.assert_allclose(again.recording.positions, wanted, rtol=0, atol=1e-9)


@pytest.mark.parametrize("format", FORMATS)
def test_truncated_anywhere(tmp_path: Path, format: str) -> None:
    content = make(format, positions(frames=12))
    read = 0
    for stop in np.random.default_rng(3).integers(0, len(content), 60).tolist():
        result = outcome(tmp_path / "cut.txt", content[:stop])
        assert isinstance(result, Reading) or len(result) > 20
        read += isinstance(result, Reading)
    assert read > 5


@pytest.mark.parametrize("format", FORMATS)
def test_bytes_replaced_at_random(tmp_path: Path, format: str) -> None:
    content = np.frombuffer(make(format, positions(frames=12)), np.uint8)
    rng = np.random.default_rng(4)
    readings = []
    for count in rng.integers(1, 40, 60).tolist():
        damaged = content.copy()
        damaged[rng.integers(0, len(content), count)] = rng.integers(0, 256, count)
        readings.append(outcome(tmp_path / "noise.txt", damaged.tobytes()))
    assert sum(isinstance(reading, Reading) for reading in readings) > 5


@pytest.mark.parametrize("format", FORMATS)
def test_cells_replaced_by_hostile_text(tmp_path: Path, format: str) -> None:
    hostile = [
        b"=HYPERLINK()",
        b"<script>",
        b"9" * 400,
        b"-",
        b"1e999",
        b"0x1F",
        b'"',
        b'""',
        b"\x00",
        b"\xff",
        b"1,5",
        b"\r",
        b"",
    ]
    delimiter = b"\t" if format in ("trc", "qtm") else b","
    cells = make(format, positions(frames=12)).split(delimiter)
    rng = np.random.default_rng(6)
    readings = []
    for _ in range(60):
        changed = list(cells)
        for i in rng.integers(0, len(cells), 6).tolist():
            changed[i] = hostile[rng.integers(len(hostile))]
        readings.append(outcome(tmp_path / "hostile.txt", delimiter.join(changed)))
        if isinstance(readings[-1], Reading):
            patch_one(tmp_path / "hostile.txt", readings[-1])
    assert sum(isinstance(reading, Reading) for reading in readings) > 5


def test_noise_is_refused(tmp_path: Path) -> None:
    rng = np.random.default_rng(7)
    for size in (1, 10, 1000, 100_000):
        assert isinstance(outcome(tmp_path / "noise.trc", rng.integers(0, 256, size, np.uint8).tobytes()), str)
    assert isinstance(outcome(tmp_path / "noise.csv", b",x" * 100_000), str)
    assert isinstance(outcome(tmp_path / "noise.csv", b'"' * 1_000_000), str)
