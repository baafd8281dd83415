"""Real text files, and files damaged at random: a sane reading or a clear refusal, never anything else."""

import time
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


def test_promises_cost_no_memory_and_no_time(tmp_path: Path) -> None:
    started = time.perf_counter()
    many = ",".join(f"m{i}_{axis}" for i in range(30_000) for axis in "xyz").encode()
    assert "far shorter" in str(outcome(tmp_path / "wide.csv", b"time," + many + b"\n" + b"1\n" * 30_000))
    assert isinstance(outcome(tmp_path / "digits.csv", b"time,A_x,A_y,A_z\n" + b"9" * 10**6 + b"x,1,2,3\n" * 2), str)
    assert time.perf_counter() - started < 5


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
    "text/127_07.csv": "names no unit",
}


@pytest.mark.data
@pytest.mark.parametrize("name", REAL)
def test_real_files(data: Path, tmp_path: Path, name: str) -> None:
    format, shape, rate, first_frame, unit, missing = REAL[name]
    path = data / name
    started = time.perf_counter()
    reading = reader.read(path, unlabelled=[r"\*\d+"], rate=60.0 if format == "csv" else None)
    assert time.perf_counter() - started < 2
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
