"""The files between stages: what is written is read back bit for bit, bytes are deterministic, notes are recognised."""

import subprocess
import sys

import numpy as np
import pytest

from markermend.core.events import Event
from markermend.core.recording import FILLED, MISSING, ORIGINS, Recording, Restored, SetAside
from markermend.storage import atomic, stage_files
from support.paths import PROJECT

FACTS = {"stage": "ingest", "options": {"rate": None}, "inputs": {"source": "ab"}}


def made(restored=False):
    rng = np.random.default_rng(0)
    markers = ("LASI", 'a "b".x', "Kn\u00f6chel", "<b>")
    positions = rng.normal(0, 1000, (20, 4, 3))
    positions[3:6, 1] = np.nan
    common = (markers, positions, 120.0, 705, {"recording": "walk", "warnings": ["\u00e4"]})
    if not restored:
        return Recording(*common)
    origin = rng.integers(0, len(ORIGINS), (20, 4)).astype(np.uint8)
    origin[3:6, 1], origin[7, 2] = MISSING, FILLED
    error = rng.uniform(0, 5, (20, 4))
    error[3:6, 1] = np.nan
    return Restored(*common, origin, error, 1.5 * error)


@pytest.mark.parametrize("restored", [False, True])
def test_a_recording_comes_back_bit_for_bit(tmp_path, restored):
    recording = made(restored)
    stage_files.write_recording(tmp_path / "01.parquet", recording, FACTS)
    again = stage_files.read_recording(tmp_path / "01.parquet")
    assert type(again) is type(recording)
    assert again.markers == recording.markers
    assert again.positions.tobytes() == recording.positions.tobytes()
    assert (again.rate, again.first_frame) == (120.0, 705)
    if restored:
        assert np.array_equal(again.origin, recording.origin)
        assert again.error.tobytes() == recording.error.tobytes()
        assert again.error95.tobytes() == recording.error95.tobytes()
    assert again.facts["recording"] == "walk" and again.facts["stage"] == "ingest"
    assert again.facts["markers"] == list(recording.markers)


def test_a_recording_without_frames_or_markers_comes_back(tmp_path):
    for shape in ((0, 2, 3), (5, 0, 3), (0, 0, 3)):
        recording = Recording(("A", "B")[: shape[1]], np.empty(shape), 100.0)
        stage_files.write_recording(tmp_path / "01.parquet", recording, FACTS)
        assert stage_files.read_recording(tmp_path / "01.parquet").positions.shape == shape


def test_equal_contents_give_equal_bytes(tmp_path):
    for name in ("a", "b"):
        stage_files.write_recording(tmp_path / name, made(True), FACTS)
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()
    stage_files.write_events(tmp_path / "a", [Event("B", 1, 2, 1.0), Event("A", 3, 4, 2.0, "x", "B")], FACTS)
    stage_files.write_events(tmp_path / "b", [Event("A", 3, 4, 2.0, "x", "B"), Event("B", 1, 2, 1.0)], FACTS)
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()


def test_events_come_back_sorted(tmp_path):
    events = [Event("B", 1, 2, 1.0), Event("A", 3, 4, 2.5, "xz", "B"), Event("A", 0, 1, 1.0)]
    stage_files.write_events(tmp_path / "events", events, {"stage": "peaks"})
    assert stage_files.read_events(tmp_path / "events") == [events[2], events[1], events[0]]
    stage_files.write_events(tmp_path / "none", [], {"stage": "peaks"})
    assert stage_files.read_events(tmp_path / "none") == []


@pytest.mark.parametrize(
    ("name", "read"),
    [
        ("a.parquet", stage_files.read_recording),
        ("a.parquet", stage_files.read_events),
        ("a.json", stage_files.read_json),
    ],
)
def test_a_note_is_recognised_by_every_reader(tmp_path, name, read):
    stage_files.set_aside(tmp_path / name, "ingest", "no 3-D data")
    with pytest.raises(SetAside, match="no 3-D data") as note:
        read(tmp_path / name)
    assert note.value.stage == "ingest"


def test_a_failed_write_leaves_the_old_file_and_no_scrap(tmp_path):
    atomic.write_text(tmp_path / "a.txt", "old")
    with pytest.raises(RuntimeError), atomic.replacing(tmp_path / "a.txt") as temporary:
        temporary.write_text("half", encoding="utf-8")
        raise RuntimeError
    assert [path.name for path in tmp_path.iterdir()] == ["a.txt"]
    assert (tmp_path / "a.txt").read_text(encoding="utf-8") == "old"


def test_no_stage_imports_pandas_to_store(tmp_path):
    code = (
        "import sys, numpy as np; from pathlib import Path; from markermend.core import recording; from markermend.storage import stage_files as storage\n"
        "r = recording.Recording(('A',), np.zeros((3, 1, 3)), 100.0)\n"
        f"p = Path({str(tmp_path / 'a.parquet')!r}); storage.write_recording(p, r, {{}}); storage.read_recording(p)\n"
        "sys.exit('pandas' in sys.modules)"
    )
    scripts = PROJECT / "scripts"
    assert subprocess.run([sys.executable, "-c", code], cwd=scripts).returncode == 0
