"""Original values go through their file bit for bit, and the file names both ways of counting frames."""

import numpy as np
import pyarrow.parquet as pq

from markermend.core.originals import Originals
from markermend.storage import originals_file, stage_files
from markermend.storage.original_bytes import OriginalBytes

POSITIONS = np.array([[0.1 + 0.2, -0.0, 1e-300], [np.nan] * 3, [1.0, 2.0, np.nextafter(3.0, 4.0)]])
SAMPLES = Originals(
    ("B", "A", 'C"'), np.array([0, 0, 2]), np.array([4, 5, 0]), POSITIONS, np.array([1, 6, 7], np.uint8),
    ("peak", "gap", "slow+peak"), np.array([0, 2, 1]), 701,
)  # fmt: skip
STORED = OriginalBytes(
    np.array([0, 2, 2]),
    np.array([10, 90, 95]),
    np.array([14, 95, 96]),
    (b"1.50", b"", b"\x00\xff"),
    (b"1.60", b"\x00", b","),
    np.array([False, False, True]),
)


def test_what_is_written_is_read(tmp_path):
    originals_file.write(tmp_path / "originals.parquet", SAMPLES, STORED, {"stage": "export"})
    again = originals_file.read(tmp_path / "originals.parquet")
    assert again.positions.tobytes() == POSITIONS.tobytes()
    for name in ("marker", "frame", "origin", "finding"):
        assert np.array_equal(getattr(again, name), getattr(SAMPLES, name))
    assert (again.markers, again.classes, again.first_frame) == (SAMPLES.markers, SAMPLES.classes, 701)
    assert stage_files.read_facts(tmp_path / "originals.parquet")["stage"] == "export"


def test_bytes_are_read_as_they_were_by_their_samples(tmp_path):
    originals_file.write(tmp_path / "originals.parquet", SAMPLES, STORED, {})
    again = originals_file.read_bytes(tmp_path / "originals.parquet")
    for name in ("sample", "start", "stop", "padding"):
        assert np.array_equal(getattr(again, name), getattr(STORED, name))
    assert (again.content, again.written) == (STORED.content, STORED.written)
    first = pq.ParquetFile(tmp_path / "originals.parquet").read().to_pylist()[0]
    assert first["bytes"] == [{"start": 10, "stop": 14, "content": b"1.50", "written": b"1.60", "padding": False}]


def test_people_find_both_numberings_and_names(tmp_path):
    originals_file.write(tmp_path / "originals.parquet", SAMPLES, STORED, {})
    rows = pq.ParquetFile(tmp_path / "originals.parquet").read().to_pylist()
    assert [(row["marker"], row["row"], row["frame"], row["class"], row["origin"]) for row in rows] == [
        ("B", 4, 705, "peak", "peak"),
        ("B", 5, 706, "gap", "filled"),
        ('C"', 0, 701, "slow+peak", "missing"),
    ]


def test_nothing_changed_is_a_file_with_the_same_columns(tmp_path):
    none = np.zeros(0, int)
    nothing = Originals(("A",), none, none, np.zeros((0, 3)), np.zeros(0, np.uint8), (), none)
    stored = OriginalBytes(none, none, none, (), (), np.zeros(0, bool))
    originals_file.write(tmp_path / "originals.parquet", nothing, stored, {})
    assert pq.read_schema(tmp_path / "originals.parquet").remove_metadata() == originals_file.SCHEMA
    assert originals_file.read(tmp_path / "originals.parquet").positions.shape == (0, 3)
    assert originals_file.read_bytes(tmp_path / "originals.parquet").content == ()
