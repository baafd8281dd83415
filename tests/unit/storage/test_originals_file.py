"""Original values go through their file bit for bit, and the file names both ways of counting frames."""

import numpy as np
import pyarrow.parquet as pq

from markermend.core.originals import Originals
from markermend.storage import originals_file, stage_files

POSITIONS = np.array([[0.1 + 0.2, -0.0, 1e-300], [np.nan] * 3, [1.0, 2.0, np.nextafter(3.0, 4.0)]])
SAMPLES = Originals(
    ("B", "A", 'C"'), np.array([0, 0, 2]), np.array([4, 5, 0]), POSITIONS, np.array([1, 6, 7], np.uint8),
    ("peak", "gap", "slow+peak"), 701,
)  # fmt: skip


def test_what_is_written_is_read(tmp_path):
    originals_file.write(tmp_path / "originals.parquet", SAMPLES, {"stage": "export"})
    again = originals_file.read(tmp_path / "originals.parquet")
    assert again.positions.tobytes() == POSITIONS.tobytes()
    for name in ("marker", "frame", "origin"):
        assert np.array_equal(getattr(again, name), getattr(SAMPLES, name))
    assert (again.markers, again.classes, again.first_frame) == (SAMPLES.markers, SAMPLES.classes, 701)
    assert stage_files.read_facts(tmp_path / "originals.parquet")["stage"] == "export"


def test_people_find_both_numberings_and_names(tmp_path):
    originals_file.write(tmp_path / "originals.parquet", SAMPLES, {})
    rows = pq.ParquetFile(tmp_path / "originals.parquet").read().to_pylist()
    assert [(row["marker"], row["row"], row["frame"], row["class"], row["origin"]) for row in rows] == [
        ("B", 4, 705, "peak", "peak"),
        ("B", 5, 706, "gap", "filled"),
        ('C"', 0, 701, "slow+peak", "missing"),
    ]


def test_nothing_changed_is_a_file_with_the_same_columns(tmp_path):
    nothing = Originals(("A",), np.zeros(0, int), np.zeros(0, int), np.zeros((0, 3)), np.zeros(0, np.uint8), ())
    originals_file.write(tmp_path / "originals.parquet", nothing, {})
    assert pq.read_schema(tmp_path / "originals.parquet").remove_metadata() == originals_file.SCHEMA
    assert originals_file.read(tmp_path / "originals.parquet").positions.shape == (0, 3)
