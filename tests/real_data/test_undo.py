"""Every real recording that can be cleaned comes back bit for bit from its cleaned file, whatever program wrote it."""

from pathlib import Path

import pytest

from markermend import api
from markermend.core.recording import BadRecording
from markermend.storage.atomic import sha256
from support.kept_originals import anything, keep

NO_RATE = {".csv": 60.0}
"""Rates for formats whose files may not state any."""


def recordings(data: Path) -> list[Path]:
    """The files of all recordings, the largest last."""
    found = [path for path in data.rglob("*") if path.suffix.lower() in (".c3d", ".trc", ".csv", ".tsv")]
    assert len(found) > 50
    return sorted(found, key=lambda path: path.stat().st_size)


@pytest.mark.data
def test_any_samples_changed_in_any_file_come_back(data: Path, tmp_path: Path) -> None:
    count = 0
    for path in recordings(data):
        try:
            cleaned, kept = keep(path, anything(share=0.02), folder=tmp_path, rate=NO_RATE.get(path.suffix.lower()))
        except BadRecording:
            continue
        back = tmp_path / "back"
        assert api.undo(cleaned, back, **kept).whole, path
        assert sha256(back) == sha256(path) != sha256(cleaned), path
        back.unlink()
        count += 1
    assert count > 50


@pytest.mark.data
@pytest.mark.slow
def test_what_is_cleaned_comes_back(data: Path, tmp_path: Path) -> None:
    cleaned = tmp_path / "cleaned"
    changed = 0
    for path in recordings(data):
        try:
            recording = api.read(path, rate=NO_RATE.get(path.suffix.lower()))
        except BadRecording:
            continue
        done = api.clean(recording)
        target, originals = cleaned.with_suffix(path.suffix), tmp_path / "originals.parquet"
        certificate = api.write(done, path, target, originals=originals)
        back = tmp_path / "back"
        restored = api.undo(target, back, originals=originals, certificate=certificate)
        assert restored.whole and restored.samples == certificate["changed_samples"], path
        assert sha256(back) == sha256(path), path
        back.unlink()
        changed += certificate["changed_samples"] > 0
        print(path.relative_to(data), certificate["changed_samples"], flush=True)
    assert changed > 20
