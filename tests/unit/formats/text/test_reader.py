"""Every text format: what is read, what a patch writes, and what it leaves alone."""

from pathlib import Path

import numpy as np
import pytest

from markermend.core.recording import BadRecording
from markermend.formats.comparison import compare
from markermend.formats.reading import Reading
from markermend.formats.text import reader
from support.text_files import FORMATS, MARKERS, make, positions

PATTERNS = [r"\*\d+"]


def read(folder: Path, content: bytes, *, name: str = "walk.txt", rate: float | None = None) -> Reading:
    path = folder / name
    path.write_bytes(content)
    return reader.read(path, unlabelled=PATTERNS, rate=rate)


@pytest.mark.parametrize("end", ["\r\n", "\n", "\r"])
@pytest.mark.parametrize("format", FORMATS)
def test_read(tmp_path: Path, format: str, end: str) -> None:
    values = positions()
    reading = read(tmp_path, make(format, values, end=end))
    assert reading.format == format
    assert [name.rpartition(":")[2] for name in reading.recording.markers] == list(MARKERS)
    np.testing.assert_allclose(reading.recording.positions, values, rtol=0, atol=1e-9)
    assert (reading.recording.rate, reading.recording.first_frame) == (100.0, 101)
    assert reading.unit == ("m" if format == "motive" else "mm")
    assert reading.missing == {"zero" if format == "qtm" else "blank": 4}
    assert reading.warnings == ()
    assert reading.unlabelled == (("Unlabeled:7",) if format == "motive" else ())
    assert reading.model_outputs == (("Body",) if format == "motive" else ())


@pytest.mark.parametrize("format", FORMATS)
def test_patch_changes_the_cells_of_changed_samples_and_nothing_else(tmp_path: Path, format: str) -> None:
    values = positions()
    original = b"\xef\xbb\xbf" + make(format, values)
    before = read(tmp_path, original)
    changed = np.zeros(values.shape[:2], bool)
    changed[[3, 4, 5, 29], [0, 1, 1, 3]] = True
    changed[12, 2] = True
    wanted = before.recording.positions.copy()
    wanted[changed] = np.round(np.random.default_rng(1).uniform(-999, 999, (5, 3)), 3)
    wanted[12, 2] = np.nan
    target = tmp_path / "out" / "cleaned.txt"
    result = reader.patch(
        tmp_path / "walk.txt", target, format=format, positions=wanted, changed=changed, columns=before.columns
    )
    assert (result.samples, result.refused) == (5, ())
    np.testing.assert_allclose(
        reader.read(target, unlabelled=PATTERNS, rate=None).recording.positions, wanted, rtol=0, atol=1e-9
    )
    delimiter = {"trc": b"\t", "qtm": b"\t"}.get(format, b",")
    old, new = (content.split(b"\n") for content in (original, target.read_bytes()))
    assert len(old) == len(new)
    differing = sum(
        a != b
        for x, y in zip(old, new, strict=True)
        for a, b in zip(x.split(delimiter), y.split(delimiter), strict=True)
    )
    assert differing == 15
    np.testing.assert_array_equal(before.recording.positions, read(tmp_path, original).recording.positions)


@pytest.mark.parametrize("format", FORMATS)
def test_patch_of_nothing_gives_the_same_bytes(tmp_path: Path, format: str) -> None:
    content = make(format, positions())
    reading = read(tmp_path, content)
    changed = np.zeros(reading.recording.missing.shape, bool)
    target = tmp_path / "same"
    reader.patch(
        tmp_path / "walk.txt",
        target,
        format=format,
        positions=reading.recording.positions,
        changed=changed,
        columns=reading.columns,
    )
    assert target.read_bytes() == content


def patched(
    folder: Path, content: bytes, samples: dict[tuple[int, int], list[float]], rate: float | None = None
) -> bytes:
    """What patching some samples makes of a file, given the positions by frame and marker."""
    reading = read(folder, content, rate=rate)
    wanted, changed = reading.recording.positions.copy(), np.zeros(reading.recording.missing.shape, bool)
    for where, position in samples.items():
        wanted[where], changed[where] = position, True
    result = reader.patch(
        folder / "walk.txt",
        folder / "new",
        format=reading.format,
        positions=wanted,
        changed=changed,
        columns=reading.columns,
    )
    assert result.samples + len(result.refused) == len(samples)
    return (folder / "new").read_bytes()


def test_patch_writes_as_many_decimals_as_the_column_has(tmp_path: Path) -> None:
    content = b"time,A_x,A_y,A_z\n0.00,100.12345,1,300\n0.01,-200.5,2.5e-05,30\n0.02,,,\n"
    new = patched(tmp_path, content, {(2, 0): [1 / 3, 2 / 3, -1e-9]})
    assert new == content.replace(b"0.02,,,", b"0.02,0.33333,0.666667,0.000")


def test_patch_keeps_decimal_commas_quotes_and_blanks(tmp_path: Path) -> None:
    content = b'"time";"A_x";"A_y";"A_z"\n0,00; 100,5 ;"200,25";-300\n0,01;1,5;2,5;3,5'
    new = patched(tmp_path, content, {(0, 0): [1.5, -2.25, 3]})
    assert new == content.replace(b' 100,5 ;"200,25";-300', b' 1,500 ;"-2,250";3,000')


def test_patch_lengthens_a_short_row_only_as_far_as_needed(tmp_path: Path) -> None:
    content = b"frame,A_x,A_y,A_z,B_x,B_y,B_z\r\n1,1,2,30,4,5,60\r\n2\r\n3,1,2,30\r\n"
    new = patched(tmp_path, content, {(1, 0): [11, 12, 13], (2, 1): [np.nan] * 3}, rate=50)
    assert new == content.replace(b"\r\n2\r\n", b"\r\n2,11.000,12.000,13.000\r\n")
    changed = np.array([[False, False], [True, False], [False, True]])
    difference = compare(tmp_path / "walk.txt", tmp_path / "new", format="csv", changed=changed, columns=(0, 1))
    assert difference.other_bytes_equal


def test_patch_refuses_what_would_be_read_as_missing(tmp_path: Path) -> None:
    content = make("csv", positions())
    reading = read(tmp_path, content)
    wanted, changed = reading.recording.positions.copy(), np.zeros(reading.recording.missing.shape, bool)
    wanted[0, 0], wanted[1, 0, 1], wanted[2, 3] = 1e-5, np.nan, 1e12
    changed[[0, 1, 2, 3], [0, 0, 3, 0]] = True
    result = reader.patch(
        tmp_path / "walk.txt",
        tmp_path / "new",
        format="csv",
        positions=wanted,
        changed=changed,
        columns=reading.columns,
    )
    assert (result.samples, result.refused) == (1, ((0, 0), (1, 0), (2, 3)))


def test_patch_in_metres_writes_six_decimals(tmp_path: Path) -> None:
    content = make("motive", positions())
    before, after = content.split(b"\n"), patched(tmp_path, content, {(0, 0): [1234.56789, -1, 0]}).split(b"\n")
    assert after[7].split(b",")[10:13] == [b"1.234568", b"-0.001000", b"0.000000"]
    assert [i for i in range(len(before)) if before[i] != after[i]] == [7]


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


@pytest.mark.parametrize("format", FORMATS)
def test_a_file_without_one_seen_sample_is_refused(tmp_path: Path, format: str) -> None:
    with pytest.raises(BadRecording, match="no 3-D data"):
        read(tmp_path, make(format, np.full((5, 4, 3), np.nan)))
    with pytest.raises(BadRecording, match="no frames"):
        read(tmp_path, make(format, np.empty((0, 4, 3))))


def test_unlabelled_trajectories_are_left_alone(tmp_path: Path) -> None:
    content = make("trc", positions()).replace(b"RASI\t", b"*17\t")
    reading = read(tmp_path, content)
    assert reading.recording.markers == ("LASI", "C7", "T10")
    assert (reading.columns, reading.unlabelled, reading.missing) == ((0, 2, 3), ("*17",), {})
    with pytest.raises(BadRecording, match="no labelled marker"):
        reader.read(tmp_path / "walk.txt", unlabelled=[".*"], rate=None)


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


def test_encodings(tmp_path: Path) -> None:
    content = make("trc", positions()).replace(b"LASI", "Hüfte".encode())
    assert read(tmp_path, content).recording.markers[0] == "Hüfte"
    assert read(tmp_path, content.decode().encode("latin-1")).recording.markers[0] == "Hüfte"
    with pytest.raises(BadRecording, match="UTF-16"):
        read(tmp_path, content.decode().encode("utf-16"))
