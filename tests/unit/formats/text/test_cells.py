"""Cells that hold no number are missing for a stated reason, and rows are read in blocks."""

import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from markermend.core.recording import BadRecording
from markermend.formats.text import cells
from support.text_files import make, positions, read


@pytest.mark.parametrize(
    ("cells", "clause"),
    [
        (b",,", "blank"),
        (b"1,,3", "blank"),
        (b"NaN,nan,NAN", "not finite"),
        (b"inf,1,2", "not finite"),
        (b"0,0.000,-0.0", "zero"),
        (b"=cmd(),1,2", "not a number"),
        (b"<b>1</b>,1,2", "not a number"),
        (b"1_0,1_0,1_0", "not a number"),
        (b"1e300,1,2", "out of range"),
        (b"9" * 1_000_000 + b",1,2", "not finite"),
        (b"1" * 1_000_000 + b"x,1,2", "not a number"),
    ],
)
def test_missing_samples_by_clause(tmp_path: Path, cells: bytes, clause: str) -> None:
    content = b"time,A_x,A_y,A_z\n0.00,100,200,300\n0.01," + cells + b"\n0.02,100,200,300\n"
    reading = read(tmp_path, content)
    assert reading.missing == {clause: 1}
    np.testing.assert_array_equal(reading.recording.missing[:, 0], [False, True, False])


def test_a_file_cut_off_within_a_number_loses_that_number(tmp_path: Path) -> None:
    content = make("qtm", positions())
    reading = read(tmp_path, content[: content.rindex(b"\t", 0, -20) - 2])
    assert reading.recording.missing[-1, -1]
    assert any("lack cells" in warning for warning in reading.warnings)


def test_rows_in_blocks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    content = make("trc", positions())
    whole = read(tmp_path, content)
    monkeypatch.setattr("markermend.formats.text.cells.ROWS_AT_A_TIME", 7)
    np.testing.assert_array_equal(read(tmp_path, content).recording.positions, whole.recording.positions)


def test_rows_that_cannot_hold_what_the_header_promises_are_not_split(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    titles = ",".join(f"m{i}_{axis}" for i in range(3000) for axis in "xyz").encode()
    content = b"time," + titles + b"\n" + b"1\n" * 3000
    monkeypatch.setattr(cells, "split", lambda *_: pytest.fail("a row was split"))
    with pytest.raises(BadRecording, match="far shorter"):
        read(tmp_path, content)


def test_reading_takes_memory_in_proportion_to_the_file(tmp_path: Path) -> None:
    content = b"time,A_x,A_y,A_z\n" + b"9" * 10**6 + b"x,1,2,3\n" * 2
    tracemalloc.start()
    try:
        with pytest.raises(BadRecording):
            read(tmp_path, content)
        assert tracemalloc.get_traced_memory()[1] < 20 * len(content)
    finally:
        tracemalloc.stop()
