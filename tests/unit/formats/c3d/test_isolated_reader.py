"""Whatever becomes of ezc3d, the process that asked it goes on."""

import os

from markermend.formats.c3d import isolated_reader
from markermend.formats.c3d.isolated_reader import strings_by_ezc3d
from support.c3d_files import write


def test_strings_are_read(tmp_path):
    content = write(tmp_path / "walk.c3d", labels=["LASI", "Knie innen", "Gürtel", "C7  "]).read_bytes()
    strings = strings_by_ezc3d(content)
    assert strings["POINT"]["LABELS"] == ["LASI", "Knie innen", "Gürtel", "C7"]
    assert "USED" not in strings["POINT"]
    assert strings_by_ezc3d(content.replace("Gü".encode(), b"G\xfc "))["POINT"]["LABELS"][2] == "Gü rtel"


def test_what_ezc3d_cannot_read_has_no_strings(tmp_path):
    content = write(tmp_path / "walk.c3d").read_bytes()
    assert strings_by_ezc3d(b"") == {}
    assert strings_by_ezc3d(content[:700]) == {}
    assert strings_by_ezc3d(write(tmp_path / "sgi.c3d", storage="sgi_real").read_bytes()) == {}


def test_a_failure_costs_the_strings_only(monkeypatch):
    monkeypatch.setattr(isolated_reader, "_read", lambda _: os.abort())
    assert strings_by_ezc3d(b"x") == {}
    monkeypatch.setattr(isolated_reader, "_read", lambda _: {"POINT": {"LABELS": ["A"]}})
    assert strings_by_ezc3d(b"x") == {"POINT": {"LABELS": ["A"]}}
