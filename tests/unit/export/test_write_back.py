"""Export: only changed samples differ from the original, and the certificate proves it."""

import numpy as np
import pytest

from markermend.core.recording import (
    FILLED,
    MISSING,
    ORIGINS,
    BadRecording,
    Recording,
    Restored,
    SetAside,
    SourceChanged,
    changed,
)
from markermend.export import write_back
from markermend.formats import comparison, files
from markermend.formats.c3d.writer import Content, write_new
from markermend.storage import atomic
from support.platforms import posix

STORAGES = ("pc_int", "pc_real", "dec_int", "dec_real", "sgi_int", "sgi_real")


def original(path, storage_name="pc_real"):
    """A small file with a gap, an unlabelled point and analog data; returns what ingest would make of it."""
    rng = np.random.default_rng(5)
    positions = np.cumsum(rng.normal(0, 2, (50, 4, 3)), axis=0) + 500
    positions[20:25, 1] = np.nan
    write_new(
        path,
        Content(
            labels=["A", "B", "*3", "C"],
            positions=positions,
            rate=100.0,
            first_frame=701,
            storage=storage_name,
            unit="mm",
            analog=rng.normal(0, 1, (50, 2, 3)),
        ),
    )
    reading = files.read(path, unlabelled=[r"\*\d+"], rate=None)
    source = {
        "name": path.name,
        "sha256": atomic.sha256(path),
        "format": reading.format,
        "columns": list(reading.columns),
    }
    held = reading.recording
    return Recording(held.markers, held.positions, held.rate, held.first_frame, {"recording": "walk", "source": source})


def restored(measured, *, step=True, blank=True):
    """A fill on B, a step repaired on A, and samples of C blanked."""
    positions, origin = measured.positions.copy(), np.where(measured.missing, MISSING, 0).astype(np.uint8)
    error = np.where(measured.missing, np.nan, 0.0)
    positions[20:25, 1] = np.linspace(positions[19, 1], positions[25, 1], 7)[1:-1]
    origin[20:25, 1], error[20:25, 1] = FILLED, 1.5
    if step:
        positions[5:9, 0] += 12.0
        origin[5:9, 0], error[5:9, 0] = ORIGINS.index("step"), 0.5
    if blank:
        positions[30:32, 2], origin[30:32, 2], error[30:32, 2] = np.nan, MISSING, np.nan
    common = (measured.markers, positions, measured.rate, measured.first_frame, measured.facts)
    return Restored(*common, origin, error, 1.5 * error)


@pytest.mark.parametrize("name", STORAGES)
def test_only_changed_samples_differ_in_every_storage(tmp_path, name):
    measured = original(tmp_path / "walk.c3d", name)
    result = restored(measured)
    certificate = write_back.write_cleaned(tmp_path / "walk.c3d", tmp_path / "cleaned.c3d", measured, result)
    assert certificate["other_bytes_equal"] is True
    assert certificate["changed_samples"] == 5 + 4 + 2
    assert certificate["blanked_samples"] == 2
    width = 16 if name.endswith("real") else 8
    before, after = (np.frombuffer((tmp_path / f).read_bytes(), np.uint8) for f in ("walk.c3d", "cleaned.c3d"))
    assert len(before) == len(after)
    assert 0 < (before != after).sum() == certificate["changed_bytes"] <= 11 * width
    again = files.read(tmp_path / "cleaned.c3d", unlabelled=[r"\*\d+"], rate=None).recording
    np.testing.assert_allclose(again.positions, result.positions, atol=0.06, equal_nan=True)
    same = ~changed(measured, result)
    assert np.array_equal(again.positions[same], measured.positions[same], equal_nan=True)


def test_nothing_changed_gives_the_same_bytes(tmp_path):
    measured = original(tmp_path / "walk.c3d")
    error = np.where(measured.missing, np.nan, 0.0)
    origin = np.where(measured.missing, MISSING, 0).astype(np.uint8)
    common = (measured.markers, measured.positions, measured.rate, measured.first_frame, measured.facts)
    result = Restored(*common, origin, error, error)
    certificate = write_back.write_cleaned(tmp_path / "walk.c3d", tmp_path / "cleaned.c3d", measured, result)
    assert (tmp_path / "walk.c3d").read_bytes() == (tmp_path / "cleaned.c3d").read_bytes()
    assert certificate["changed_samples"] == certificate["changed_bytes"] == 0


def test_an_unnamed_change_is_refused(tmp_path):
    measured = original(tmp_path / "walk.c3d")
    result = restored(measured)
    result.positions[40, 0] += 1.0
    with pytest.raises(BadRecording, match="marked as measured differ"):
        write_back.write_cleaned(tmp_path / "walk.c3d", tmp_path / "cleaned.c3d", measured, result)
    assert not (tmp_path / "cleaned.c3d").exists()


def test_an_original_that_changed_since_ingest_is_refused(tmp_path):
    measured = original(tmp_path / "walk.c3d")
    with open(tmp_path / "walk.c3d", "ab") as file:
        file.write(b"\0")
    with pytest.raises(SourceChanged, match="has changed since"):
        write_back.write_cleaned(tmp_path / "walk.c3d", tmp_path / "cleaned.c3d", measured, restored(measured))


def test_a_foreign_byte_is_noticed(tmp_path):
    measured = original(tmp_path / "walk.c3d")
    result = restored(measured)
    columns, differs = measured.facts["source"]["columns"], changed(measured, result)
    write_back.write_cleaned(tmp_path / "walk.c3d", tmp_path / "cleaned.c3d", measured, result)
    content = bytearray((tmp_path / "cleaned.c3d").read_bytes())
    for place in (600, len(content) - 600):
        broken = content.copy()
        broken[place] ^= 1
        (tmp_path / "broken.c3d").write_bytes(broken)
        found = comparison.compare(
            tmp_path / "walk.c3d", tmp_path / "broken.c3d", format="c3d", changed=differs, columns=columns
        )
        assert not found.other_bytes_equal


def test_a_text_file_keeps_every_other_cell(tmp_path):
    lines = ["frame,A_x,A_y,A_z,B_x,B_y,B_z,note"]
    lines += [f"{i},{i + 0.125},{2 * i + 0.5},300.25,{i + 10.0},{i + 20.0},{i + 30.0},ok" for i in range(1, 41)]
    lines[11] = "11,,,,21.0,31.0,41.0,ok"
    source = tmp_path / "walk.csv"
    source.write_bytes("\r\n".join(lines).encode())
    reading = files.read(source, unlabelled=[], rate=100.0)
    held = reading.recording
    facts = {"source": {"name": source.name, "sha256": atomic.sha256(source), "format": "csv", "columns": [0, 1]}}
    measured = Recording(held.markers, held.positions, held.rate, held.first_frame, facts)
    positions, origin = held.positions.copy(), np.where(held.missing, MISSING, 0).astype(np.uint8)
    positions[10, 0], origin[10, 0] = (11.2, 22.4, 300.0), FILLED
    error = np.zeros(origin.shape)
    result = Restored(held.markers, positions, held.rate, held.first_frame, facts, origin, error, error)
    certificate = write_back.write_cleaned(source, tmp_path / "cleaned.csv", measured, result)
    assert certificate["changed_samples"] == 1 and certificate["other_bytes_equal"]
    after = (tmp_path / "cleaned.csv").read_bytes().decode().split("\r\n")
    assert [i for i, (a, b) in enumerate(zip(lines, after, strict=True)) if a != b] == [11]
    assert after[11].startswith("11,11.2") and after[11].endswith(",21.0,31.0,41.0,ok")
    (tmp_path / "broken.csv").write_bytes((tmp_path / "cleaned.csv").read_bytes().replace(b"21.0,31.0", b"21.1,31.0"))
    differs = changed(measured, result)
    found = comparison.compare(source, tmp_path / "broken.csv", format="csv", changed=differs, columns=[0, 1])
    assert not found.other_bytes_equal


def test_a_recording_set_aside_is_passed_through(tmp_path):
    (tmp_path / "bad.c3d").write_bytes(b"not a C3D file")
    certificate = write_back.pass_through(tmp_path / "bad.c3d", tmp_path / "cleaned.c3d", SetAside("ingest", "no C3D"))
    assert (tmp_path / "cleaned.c3d").read_bytes() == b"not a C3D file"
    assert certificate["original_sha256"] == certificate["cleaned_sha256"]
    assert certificate["untouched"] == {"stage": "ingest", "reason": "no C3D"}


@pytest.mark.parametrize("kind", ["gone", pytest.param("link", marks=posix), "locked"])
def test_what_cannot_or_must_not_be_read_is_not_copied(tmp_path, monkeypatch, kind):
    folder, source = tmp_path / "study", tmp_path / "study/bad.c3d"
    folder.mkdir()
    (tmp_path / "secret").write_text("secret", encoding="utf-8")
    if kind == "link":
        source.symlink_to("../secret")
    elif kind == "locked":
        source.touch()

        checksum = atomic.sha256

        def locked(path):
            if path == source:
                raise PermissionError(13, "Permission denied", str(path))
            return checksum(path)

        monkeypatch.setattr(atomic, "sha256", locked)
    certificate = write_back.pass_through(source, tmp_path / "cleaned.c3d", SetAside("ingest", "x"), within=folder)
    assert (tmp_path / "cleaned.c3d").read_bytes() == b""
    assert certificate["original_sha256"] is None and certificate["untouched"]["reason"] == "x"


def test_an_original_that_is_gone_since_it_was_ingested_is_looked_for_again(tmp_path):
    facts = {"source": {"name": "walk.c3d", "sha256": "0" * 64, "format": "c3d", "columns": [0]}}
    measured = Recording(("A",), np.ones((3, 1, 3)), 100.0, 1, facts)
    zeros = np.zeros((3, 1))
    result = Restored(("A",), np.ones((3, 1, 3)), 100.0, 1, facts, zeros.astype(np.uint8), zeros, zeros)
    with pytest.raises(SourceChanged, match=r"walk.c3d is gone since the run began"):
        write_back.write_cleaned(tmp_path / "walk.c3d", tmp_path / "cleaned.c3d", measured, result)
