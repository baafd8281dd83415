"""The rate comes from the recordings table, from evenly spaced times that contradict the header, or from the header."""

from pathlib import Path

import pytest

from markermend.core.recording import BadRecording
from support.text_files import make, positions, read

TRC = make("trc", positions())


@pytest.mark.parametrize("rate", [b"nan", b"0", b"inf", b"1e999", b"a hundred"])
def test_no_rate_anywhere_is_refused(tmp_path: Path, rate: bytes) -> None:
    content = make("trc", positions(frames=10)[:1]).replace(b"\r\n100\t", b"\r\n" + rate + b"\t")
    with pytest.raises(BadRecording, match="no usable frame rate"):
        read(tmp_path, content)
    for wrong in (0.0, -5.0, float("nan"), float("inf")):
        with pytest.raises(BadRecording, match="no usable frame rate"):
            read(tmp_path, TRC, rate=wrong)


@pytest.mark.parametrize("rate", [b"0", b"-100", b"inf", b"1e999", b""])
def test_a_rate_that_is_none_gives_way_to_the_times(tmp_path: Path, rate: bytes) -> None:
    reading = read(tmp_path, TRC.replace(b"\r\n100\t", b"\r\n" + rate + b"\t"))
    assert reading.recording.rate == 100.0
    assert read(tmp_path, TRC, rate=200.0).recording.rate == 200.0


def _timed(header: int, times: list[str]) -> bytes:
    """A TRC file whose header states a rate (Hz), with these texts as times."""
    content = make("trc", positions(frames=len(times)), rate=100)
    for row, text in enumerate(times):
        content = content.replace(f"\n{101 + row}\t{row / 100:.3f}\t".encode(), f"\n{101 + row}\t{text}\t".encode())
    return content.replace(b"\r\n100\t", f"\r\n{header}\t".encode())


@pytest.mark.parametrize(
    ("header", "times", "rate"),
    [
        (250, [f"{i / 25:.3f}" for i in range(30)], 25.0),  # a wrong header
        (100, [f"{i / 240:.3f}" for i in range(60)], 240.0),  # rounded times
        (120, [f"{i / 120:.2f}" for i in range(10)], 120.0),  # rounded so coarsely that they say 112 Hz
        (60, [f"{i / 59.94:.4f}" for i in range(30)], 60.0),  # the same rate
        (100, [f"{10 * i}" for i in range(30)], 100.0),  # milliseconds
        (100, [f"{i}" for i in range(30)], 100.0),  # frames
        (100, [f"{i / 50 if i < 20 else 9 + i / 50:.3f}" for i in range(30)], 100.0),  # a leap: no even spacing
        (100, ["0.000"] * 30, 100.0),
    ],
)
def test_evenly_spaced_times_overrule_the_header(tmp_path: Path, header: int, times: list[str], rate: float) -> None:
    reading = read(tmp_path, _timed(header, times))
    assert reading.recording.rate == rate
    assert ("which is used" in " ".join(reading.warnings)) == (rate != header)
    assert read(tmp_path, _timed(header, times), rate=77.0).recording.rate == 77.0
