"""The rate comes from the recordings table, the header or the times, in this order."""

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
