"""Every text format: what is read, what a patch writes, and what it leaves alone."""

import re
from pathlib import Path

import numpy as np
import pytest

from markermend.core.recording import BadRecording
from markermend.formats.text import reader
from support.text_files import FORMATS, MARKERS, make, positions, read

PATTERNS = [r"\*\d+"]


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


@pytest.mark.parametrize(
    ("format", "honest", "absurd"),
    [
        ("trc", b"100\t100\t30\t4\tmm", b"100\t100\t999999999\t999999999\tmm"),
        ("qtm", b"NO_OF_FRAMES\t30", b"NO_OF_FRAMES\t999999999"),
        ("qtm", b"NO_OF_MARKERS\t4", b"NO_OF_MARKERS\t999999999"),
    ],
)
def test_of_absurd_counts_the_file_has_the_last_word(tmp_path: Path, format: str, honest: bytes, absurd: bytes) -> None:
    content = make(format, positions())
    assert content.count(honest) == 1
    reading = read(tmp_path, content.replace(honest, absurd))
    assert reading.recording.positions.shape == (30, 4, 3)
    assert "The header says 999999999" in " ".join(reading.warnings)


@pytest.mark.parametrize("format", ["trc", "qtm", "csv"])
@pytest.mark.parametrize("blank", [b" ", b"   "])
def test_cells_between_blanks_are_refused_with_the_true_reason(tmp_path: Path, format: str, blank: bytes) -> None:
    delimiter = b"," if format == "csv" else b"\t"
    content = make(format, positions(markers=4)).replace(b" (mm)", b"")
    read(tmp_path, content)
    rows = re.sub(rb"(?m)^1\d\d(%b).*$" % delimiter, lambda row: row[0].replace(delimiter, blank), content)
    for spoilt in (content.replace(delimiter, blank), rows):
        assert spoilt != content
        with pytest.raises(BadRecording, match="separated by blanks"):
            read(tmp_path, spoilt)
