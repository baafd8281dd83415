"""No stage reads a damaged file: it is made anew at once, or in the next run."""

import sys
from pathlib import Path

import pytest

from markermend.command import inputs
from markermend.command.inputs import checksums
from markermend.core.recording import BadRecording, SetAside
from markermend.storage import output_checksums
from markermend.storage.atomic import sha256

WRITE = """
import argparse, pathlib, time, types
parser = argparse.ArgumentParser()
for name in ("events", "other"):
    parser.add_argument(f"--{name}", type=pathlib.Path, nargs=None if name == "events" else "*", default=[])
parser.add_argument("--text")
STAGE = types.SimpleNamespace(parser=parser, outputs=["events", "other"])
if __name__ == "__main__":
    flags = parser.parse_args()
    time.sleep(60 * (flags.text == "never"))
    for path in (flags.events, *flags.other):
        path.write_text(flags.text)
"""


@pytest.fixture
def script(tmp_path, monkeypatch):
    """A command of the workflow that writes a text into a file."""
    monkeypatch.setattr(inputs, "workflow_folder", lambda: tmp_path / "workflow")
    path = tmp_path / "workflow/scripts/peaks.py"
    path.parent.mkdir(parents=True)
    path.write_text(WRITE)
    return str(path)


@pytest.fixture
def peaks(tmp_path, script):
    """An input whose record names a command that writes it."""
    path = tmp_path / "S01/walk/02_peaks.parquet"
    path.parent.mkdir(parents=True)
    path.write_text("peaks")
    output_checksums.write("peaks", [path], command=[sys.executable, script, "--events", str(path), "--text", "peaks"])
    return path


def flip(path: Path, bit: int = 5) -> None:
    """Change one bit, and neither size nor date."""
    content = bytearray(path.read_bytes())
    content[bit // 8] ^= 1 << bit % 8
    path.write_bytes(content)


def test_checksums_are_given_by_input(peaks):
    assert checksums(peaks, own=peaks.parent) == sha256(peaks)
    assert checksums([peaks, peaks], own=peaks.parent) == [sha256(peaks)] * 2
    assert checksums([], own=peaks.parent) == []


def test_a_file_of_which_nothing_is_recorded_is_read_as_it_is(peaks, tmp_path):
    flip(peaks)
    (peaks.parent / "logs/peaks.json").unlink()
    assert checksums(peaks, own=peaks.parent) == sha256(peaks)


@pytest.mark.parametrize("content", ["", '{"outputs": {"02_pea'])
def test_a_file_whose_record_cannot_be_read_is_made_anew_by_the_next_run(peaks, content):
    (peaks.parent / "logs/peaks.json").write_text(content)
    with pytest.raises(SetAside, match=r"02_peaks.parquet has no record that can be read") as note:
        checksums(peaks, own=peaks.parent)
    assert note.value.stage == "peaks"
    assert (peaks.parent / "failures.tsv").read_text().startswith("peaks\t")


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(BadRecording, match=r"02_peaks.parquet is not there"):
        checksums(tmp_path / "02_peaks.parquet", own=tmp_path)


@pytest.mark.parametrize("bit", range(0, 40, 5))
def test_a_damaged_file_is_made_anew(peaks, bit):
    before = sha256(peaks)
    flip(peaks, bit)
    assert checksums(peaks, own=peaks.parent) == before == sha256(peaks)
    assert not (peaks.parent / "failures.tsv").exists()


@pytest.mark.parametrize(
    "harm", ["other bytes", "fails", "another command", "another version", "elsewhere", "never ends", "unknown"]
)
def test_where_a_damaged_file_cannot_be_made_anew_the_next_run_makes_it(peaks, script, harm, tmp_path, monkeypatch):
    monkeypatch.setattr(inputs, "LONGEST_S", 2)
    own = [sys.executable, script, "--events", str(peaks)]
    command = {
        "other bytes": [*own, "--text", "other"],
        "fails": own,
        "another command": [sys.executable, "-c", WRITE, *own[2:], "--text", "peaks"],
        "another version": [*own, "--text", "peaks", "--unknown"],
        "elsewhere": [*own, "--text", "peaks", "--other", str(tmp_path / "elsewhere.txt")],
        "never ends": [*own, "--text", "never"],
        "unknown": [],
    }[harm]
    output_checksums.write("peaks", [peaks], command=command)
    flip(peaks)
    with pytest.raises(
        SetAside, match=r"02_peaks.parquet is not as peaks wrote it.*the next run makes it anew"
    ) as note:
        checksums(peaks, own=peaks.parent)
    assert note.value.stage == "peaks"
    assert (peaks.parent / "failures.tsv").read_text().split("\t")[0] == "peaks"
    assert not (tmp_path / "elsewhere.txt").exists()


def test_a_subject_does_without_its_damaged_recordings_and_is_tried_again(peaks, tmp_path):
    other, shared = peaks.with_name("02_frozen.parquet"), {"output": tmp_path / "S01/mesh.json", "stage": "mesh"}
    failures = tmp_path / "S01/failures.tsv"
    assert inputs.undamaged([peaks, other], ["a", "b"], **shared) == [peaks, other] and not failures.exists()
    assert inputs.undamaged([peaks, other], ["a", None], **shared) == [peaks]
    assert failures.read_text() == "mesh\t1 of 2 recordings are damaged\n"
    with pytest.raises(BadRecording, match="the next run makes them anew"):
        inputs.undamaged([peaks, other], [None, None], **shared)


def test_results_that_were_moved_are_not_made_where_they_were(peaks, tmp_path):
    moved = peaks.parents[1].rename(tmp_path / "S02") / "walk/02_peaks.parquet"
    flip(moved)
    with pytest.raises(SetAside):
        checksums(moved, own=moved.parent)
    assert not peaks.exists() and (moved.parent / "failures.tsv").exists()


def test_a_file_that_belongs_to_more_than_the_recording_is_left_to_the_next_run(peaks):
    flip(peaks)
    with pytest.raises(SetAside):
        checksums(peaks, own=peaks.parent / "batch")
    assert (peaks.parent / "failures.tsv").read_text().count("\n") == 1
    assert checksums(peaks, own=peaks.parents[1])


def test_what_is_missing_or_damaged_may_have_no_checksum(peaks):
    before = sha256(peaks)
    output_checksums.write("peaks", [peaks])
    flip(peaks)
    assert inputs.checksums_or_none([peaks, peaks.with_name("none")], own=peaks.parent) == [None, None]
    flip(peaks)
    assert inputs.checksums_or_none([peaks], own=peaks.parent) == [before]


def test_an_original_is_not_looked_up_among_our_records(peaks, tmp_path):
    output_checksums.write("peaks", [peaks])
    flip(peaks)
    assert inputs.original_checksum(peaks, within=None) == sha256(peaks)
    assert inputs.original_checksum(tmp_path, within=None) is None
    assert not (peaks.parent / "failures.tsv").exists()
