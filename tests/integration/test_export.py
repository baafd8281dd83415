"""The export stage as a command: what it writes of a recording, and of one that was set aside."""

import csv
import json
from dataclasses import replace

import numpy as np
import pyarrow.parquet as pq
import pytest

import export
from markermend.core.changes import Change, Outcome
from markermend.core.originals import restore_originals
from markermend.core.recording import FILLED, ORIGINS, Restored, SetAside
from markermend.export.change_table import COLUMNS
from markermend.formats import files
from markermend.formats.c3d.writer import Content, write_new
from markermend.storage import atomic, change_file, originals_file, stage_files


def flags(folder, *trc, decisions=()):
    names = {
        "source": "walk.c3d", "markers": "01.parquet", "filled": "07.parquet", "record": "07_changes.parquet",
        "cleaned": "cleaned/walk.c3d", "changes": "changes.tsv", "originals": "originals.parquet",
        "certificate": "certificate.json",
    }  # fmt: skip
    named = [word for flag, name in names.items() for word in (f"--{flag}", str(folder / name))]
    return [
        *named,
        "--code",
        "c",
        "--decisions",
        json.dumps(decisions),
        "--within",
        "none",
        "--trc",
        *map(str, trc),
        "--also-trc",
        "true" if trc else "false",
        "--trc-unit",
        "mm",
        "--trc-vertical-axis",
        "+Y",
    ]


@pytest.fixture
def folder(tmp_path):
    """A recording of two markers; a peak of A was repaired, and a gap of B filled."""
    positions = np.cumsum(np.random.default_rng(5).normal(0, 2, (40, 2, 3)), axis=0) + 500
    positions[20:25, 1] = np.nan
    path = tmp_path / "walk.c3d"
    write_new(path, Content(labels=["A", "B"], positions=positions, rate=100.0, first_frame=701))
    reading = files.read(path, unlabelled=[], rate=None)
    measured = reading.recording
    source = {"name": path.name, "sha256": atomic.sha256(path), "format": "c3d", "columns": list(reading.columns)}
    stage_files.write_recording(tmp_path / "01.parquet", measured, {"recording": "walk", "source": source})
    after, origin = measured.positions.copy(), np.zeros((40, 2), np.uint8)
    after[5:7, 0] += 9.0
    origin[5:7, 0] = ORIGINS.index("peak")
    after[20:25, 1], origin[20:25, 1] = 510.0, FILLED
    error = np.where(origin == 0, 0.0, 0.5)
    common = (measured.markers, after, measured.rate, measured.first_frame, {"recording": "walk"})
    stage_files.write_recording(tmp_path / "07.parquet", Restored(*common, origin, error, 2 * error), {})
    changes = [
        Change("A", 5, 7, ("peak",), Outcome.REPAIRED, 4.0, "x", method="spline"),
        Change("B", 20, 25, ("gap",), Outcome.FILLED, method="ensemble"),
    ]
    change_file.write(tmp_path / "07_changes.parquet", changes, {})
    return tmp_path


def test_the_table_and_the_originals_say_what_was_changed(folder):
    export.main(flags(folder))
    header, *rows = (folder / "changes.tsv").read_text().splitlines()
    assert header == "\t".join(COLUMNS)
    assert [row.split("\t")[1:4] for row in rows] == [["A", "706", "707"], ["B", "721", "725"]]
    originals = originals_file.read(folder / "originals.parquet")
    certificate = json.loads((folder / "certificate.json").read_text())
    assert certificate["cleaned"] == "cleaned/walk.c3d"
    assert len(originals.frame) == certificate["changed_samples"] == 7 and originals.measured.sum() == 2
    assert pq.read_table(folder / "originals.parquet")["class"].to_pylist() == ["peak"] * 2 + ["gap"] * 5


def test_the_table_says_by_whom_and_why_a_change_was_decided(folder):
    changes = [replace(change_file.read(folder / "07_changes.parquet")[0], decisions=("accept peak",))]
    change_file.write(folder / "07_changes.parquet", changes, {})
    decided = {
        "marker": "A",
        "decision": "accept",
        "value": "peak",
        "note": "hop",
        "by": '=王\t"A"',
        "date": "2026-03-31",
    }
    export.main(flags(folder, decisions=[decided]))
    (row, *_) = csv.DictReader((folder / "changes.tsv").open(newline="", encoding="utf-8"), delimiter="\t")
    assert row["decision"] == 'accept peak (hop; =王\t"A", 2026-03-31)'


def test_what_was_ingested_comes_back_from_the_files(folder):
    export.main(flags(folder))
    measured, filled = (stage_files.read_recording(folder / f"{name}.parquet") for name in ("01", "07"))
    originals = originals_file.read(folder / "originals.parquet")
    back = restore_originals(filled.positions, filled.markers, originals)
    assert back.tobytes() == measured.positions.tobytes()


def test_a_recording_set_aside_has_no_changes(folder):
    for name in ("01", "07", "07_changes"):
        stage_files.set_aside(folder / f"{name}.parquet", "ingest", "no C3D file")
    export.main(flags(folder))
    assert (folder / "cleaned/walk.c3d").read_bytes() == (folder / "walk.c3d").read_bytes()
    assert (folder / "changes.tsv").read_text() == "\t".join(COLUMNS) + "\n"
    with pytest.raises(SetAside, match="no C3D file"):
        originals_file.read(folder / "originals.parquet")


def test_trc_holds_the_cleaned_recording_with_blanks_where_a_marker_is_missing(folder):
    export.main(flags(folder, folder / "cleaned/walk.trc"))
    cleaned, text = (
        files.read(folder / f"cleaned/walk.{end}", unlabelled=[], rate=None).recording for end in ("c3d", "trc")
    )
    assert text.markers == cleaned.markers and text.rate == cleaned.rate
    assert np.allclose(text.positions, cleaned.positions, atol=1e-3, equal_nan=True)
