"""Text files in any encoding of one byte or UTF-8 are split into lines and cells, byte for byte."""

from pathlib import Path

import pytest

from markermend.core.recording import BadRecording
from support.text_files import make, positions, read


def test_encodings(tmp_path: Path) -> None:
    content = make("trc", positions()).replace(b"LASI", "Hüfte".encode())
    assert read(tmp_path, content).recording.markers[0] == "Hüfte"
    assert read(tmp_path, content.decode().encode("latin-1")).recording.markers[0] == "Hüfte"
    with pytest.raises(BadRecording, match="UTF-16"):
        read(tmp_path, content.decode().encode("utf-16"))
