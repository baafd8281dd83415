"""What was changed in a file comes back bit for bit, all of it or what is named, in every storage and every way of writing text."""

import json
import shutil

import numpy as np
import pytest

from markermend.core.changes import Change, Outcome
from markermend.core.recording import FILLED, ORIGINS, SetAside
from markermend.export import undo as undoing
from markermend.export import write_back
from markermend.export.undo import NothingNamed, NotUndone, undo
from markermend.formats import files
from markermend.storage import originals_file, stage_files
from support import c3d_files, text_files
from support.kept_originals import PEAK, SWAP, anything, keep


def assert_comes_back(path, seed=0):
    original = path.read_bytes()
    cleaned, kept = keep(path, anything(seed))
    assert cleaned.read_bytes() != original
    path.unlink()
    done = undo(cleaned, path.with_name("back"), **kept)
    assert done.whole and done.samples == kept["certificate"]["changed_samples"] > 0
    assert path.with_name("back").read_bytes() == original


@pytest.mark.parametrize("storage", c3d_files.STORAGES)
def test_a_c3d_file_comes_back_in_every_storage_with_residuals_and_what_stands_in_missing_samples(tmp_path, storage):
    rng = np.random.default_rng(1)
    residuals = rng.integers(-1, 9, (20, 4)).astype(float)
    positions = c3d_files.trajectories()
    positions[3:5, 2] = np.nan
    path = c3d_files.write(tmp_path / "walk.c3d", positions, storage=storage, residuals=residuals)
    assert_comes_back(path)


@pytest.mark.parametrize("format", text_files.FORMATS)
@pytest.mark.parametrize("end", ["\r\n", "\n", "\r"])
@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"])
def test_a_text_file_comes_back_in_every_format_with_its_line_ends_and_byte_order_mark(tmp_path, format, end, mark):
    content = mark + text_files.make(format, text_files.positions(), end=end)
    path = tmp_path / f"walk.{ {'trc': 'trc', 'qtm': 'tsv'}.get(format, 'csv') }"
    path.write_bytes(content)
    for seed in range(3):
        path.write_bytes(content)
        assert_comes_back(path, seed)


@pytest.mark.parametrize(
    "cells",
    [
        ["1.500000", "-0", "+2.5"],
        ["1e3", "2.5E-2", "007.10"],
        [" 1.5 ", "2.50", "\x0c3 "],
        ['"1.5"', '" 2.5"', "3."],
        ["NaN", "nan", "NaN"],
        ["", "", ""],
        ["", "2.5", "3"],
        ["inf", "n/a", "-"],
        ["0", "0.000", "-0.0"],
        ["123456.7", "2", "3"],
    ],
)
@pytest.mark.parametrize("last", [b"\r\n", b"\n", b""])
def test_whatever_stood_in_a_cell_comes_back(tmp_path, cells, last):
    header = "frame,time," + ",".join(f"{name}_{axis}" for name in "ABC" for axis in "xyz")
    rows = [f"{frame},{frame / 100},100.5,200.25,300,{','.join(cells)},1.25,2.25,3.25" for frame in range(1, 9)]
    rows[3] = f"4,0.04,100.5,200.25,300,11.5,12.5,13.5,{','.join(cells)}"
    path = tmp_path / "walk.csv"
    for seed in range(5):
        path.write_bytes("\n".join([header, *rows]).encode() + last)
        assert_comes_back(path, seed)


def test_a_delimiter_behind_a_blank_last_cell_goes_again(tmp_path):
    content = text_files.make("trc", text_files.positions(), end="\n").replace(b"\t\n", b"\n")
    for seed in range(5):
        (tmp_path / "walk.trc").write_bytes(content)
        assert_comes_back(tmp_path / "walk.trc", seed)


def test_rows_that_lacked_cells_lack_them_again(tmp_path):
    for seed in range(20):
        assert_comes_back(text_files.short_rows(tmp_path / "walk.csv"), seed)


def fill_all(positions, origin):
    missing = np.isnan(positions).any(axis=2)
    positions[missing], origin[missing] = 55.5, FILLED


def test_a_row_keeps_its_length_while_one_of_its_added_samples_stays(tmp_path):
    path = text_files.short_rows(tmp_path / "walk.csv")
    before = path.read_bytes().split(b"\r\n")
    cleaned, kept = keep(path, fill_all)
    undo(cleaned, tmp_path / "back", **kept, markers=["B"])
    after = (tmp_path / "back").read_bytes().split(b"\r\n")
    assert after[3] == b"3,0.03,13.0,2.0,3.0,,,,55.500,55.500,55.500"
    assert after[5] == b"5,0.05,15.0,2.0,3.0,4.0,,,55.500,55.500,55.500"
    undo(cleaned, tmp_path / "others", **kept, markers=["C"])
    assert (tmp_path / "others").read_bytes().split(b"\r\n")[3] == b"3,0.03,13.0,2.0,3.0,55.500,55.500,55.500,,,"
    undo(cleaned, tmp_path / "all", **kept, markers=["?"])
    assert (tmp_path / "all").read_bytes().split(b"\r\n") == before


@pytest.mark.parametrize("name", ["walk.c3d", "walk.trc"])
def test_one_marker_is_restored_and_all_else_stays_cleaned(tmp_path, name):
    path = tmp_path / name
    if name.endswith("c3d"):
        c3d_files.write(path, labels=list(text_files.MARKERS))
    else:
        path.write_bytes(text_files.make("trc", text_files.positions()))
    cleaned, kept = keep(path, anything())
    before, after = (files.read(own, unlabelled=[], rate=None).recording for own in (path, cleaned))
    done = undo(cleaned, tmp_path / f"back{path.suffix}", **kept, markers=["C7"])
    back = files.read(tmp_path / f"back{path.suffix}", unlabelled=[], rate=None).recording
    m = before.markers.index("C7")
    assert np.array_equal(back.positions[:, m], before.positions[:, m], equal_nan=True)
    others = np.arange(len(before.markers)) != m
    assert np.array_equal(back.positions[:, others], after.positions[:, others], equal_nan=True)
    assert not done.whole and {stretch[0] for stretch in done.stretches} == {"C7"}
    assert done.samples + done.left == kept["certificate"]["changed_samples"]


def exchange(positions, origin):
    positions[5:9, :2], origin[5:9, :2] = positions[5:9, 1::-1], SWAP
    positions[7, 0], origin[7, 0] = positions[7, 0] + 30.0, PEAK
    positions[12:14, 2], origin[12:14, 2] = positions[12:14, 2] + 50.0, PEAK
    positions[18, 2], origin[18, 2] = positions[18, 2] + 50.0, PEAK


CHANGES = [
    Change("M0", 5, 9, ("swap",), Outcome.EXCHANGED, partner="M1"),
    Change("M1", 5, 9, ("swap",), Outcome.EXCHANGED, partner="M0"),
    Change("M0", 7, 8, ("peak",), Outcome.REPAIRED),
    Change("M2", 12, 14, ("peak",), Outcome.REPAIRED),
    Change("M2", 18, 19, ("peak",), Outcome.REPAIRED),
]


def test_a_finding_is_restored_as_a_whole_by_any_of_its_frames(tmp_path):
    cleaned, kept = keep(c3d_files.write(tmp_path / "walk.c3d", first_frame=701), exchange, CHANGES)
    done = undo(cleaned, tmp_path / "back.c3d", **kept, markers=["M2"], frames=(714, 716))
    assert done.stretches == (("M2", 713, 714),) and (done.samples, done.left) == (2, 9)


def test_both_markers_of_an_exchange_are_restored_with_what_was_repaired_in_it(tmp_path):
    cleaned, kept = keep(c3d_files.write(tmp_path / "walk.c3d"), exchange, CHANGES)
    done = undo(cleaned, tmp_path / "back.c3d", **kept, markers=["M0"], frames=(8, 8))
    assert done.stretches == (("M0", 6, 9), ("M1", 6, 9)) and done.left == 3


def test_a_finding_about_several_markers_is_restored_for_all(tmp_path):
    def move(positions, origin):
        positions[5:9] += 30.0
        origin[5:9] = ORIGINS.index("jump")

    changes = [Change(f"M{m}", 5, 9, ("jump",), Outcome.REPAIRED, group="all markers") for m in range(4)]
    cleaned, kept = keep(c3d_files.write(tmp_path / "walk.c3d"), move, changes)
    assert undo(cleaned, tmp_path / "back.c3d", **kept, markers=["M3"]).whole


def test_a_file_that_was_edited_after_it_was_cleaned_is_refused(tmp_path):
    cleaned, kept = keep(c3d_files.write(tmp_path / "walk.c3d"), anything())
    content = bytearray(cleaned.read_bytes())
    content[-1] ^= 1
    cleaned.write_bytes(content)
    with pytest.raises(NotUndone, match=r"cleaned.c3d was altered after it was written"):
        undo(cleaned, tmp_path / "back", **kept)
    cleaned.unlink()
    with pytest.raises(NotUndone, match=r"cleaned.c3d cannot be read \(No such file"):
        undo(cleaned, tmp_path / "back", **kept)
    assert not (tmp_path / "back").exists()


def test_another_file_is_never_overwritten_and_the_same_may_be(tmp_path):
    cleaned, kept = keep(c3d_files.write(tmp_path / "walk.c3d"), anything())
    assert undo(cleaned, tmp_path / "walk.c3d", **kept).whole  # the original is still there
    with pytest.raises(NotUndone, match=r"walk.c3d is the original already: nothing is left to undo in it"):
        undo(cleaned, tmp_path / "walk.c3d", **kept, markers=["M0"])
    shutil.copy(cleaned, tmp_path / "other.c3d")
    with pytest.raises(NotUndone, match="is another file already: name another folder"):
        undo(cleaned, tmp_path / "other.c3d", **kept, markers=["M0"])
    with pytest.raises(NotUndone, match="is another file already"):
        undo(cleaned, cleaned, **kept)


def test_markers_and_frames_that_name_nothing_are_said(tmp_path):
    cleaned, kept = keep(c3d_files.write(tmp_path / "walk.c3d"), exchange, CHANGES)
    for named in ({"markers": ["M9"]}, {"frames": (900, 901)}, {"markers": ["M3"]}):
        with pytest.raises(NothingNamed, match=r"changes.tsv"):
            undo(cleaned, tmp_path / "back", **kept, **named)


def test_a_recording_in_which_nothing_was_changed_is_its_original(tmp_path):
    path = c3d_files.write(tmp_path / "walk.c3d")
    cleaned, kept = keep(path, lambda positions, origin: None)
    done = undo(cleaned, tmp_path / "back", **kept)
    assert done.whole and done.samples == 0 and (tmp_path / "back").read_bytes() == path.read_bytes()


def test_a_recording_that_was_set_aside_is_its_original_unless_it_could_not_be_read(tmp_path):
    (tmp_path / "walk.c3d").write_bytes(b"no C3D file")
    for source in ("walk.c3d", "gone.c3d"):
        note = SetAside("ingest", "no C3D file")
        certificate = write_back.pass_through(tmp_path / source, tmp_path / "cleaned.c3d", note)
        stage_files.set_aside(tmp_path / "originals.parquet", note.stage, note.reason)
        kept = {"originals": tmp_path / "originals.parquet", "certificate": certificate}
        if source == "walk.c3d":
            assert undo(tmp_path / "cleaned.c3d", tmp_path / "back", **kept).whole
            assert (tmp_path / "back").read_bytes() == b"no C3D file"
        else:
            with pytest.raises(NotUndone, match="could not be read, so there is nothing to restore"):
                undo(tmp_path / "cleaned.c3d", tmp_path / "back2", **kept)


def test_what_is_kept_may_be_missing_damaged_or_of_an_earlier_version(tmp_path):
    cleaned, kept = keep(c3d_files.write(tmp_path / "walk.c3d"), anything())
    path = kept["originals"]
    content = path.read_bytes()
    table = originals_file.read_table(path).drop_columns(["finding", "bytes"])
    originals_file.write_table(path, table, stage_files.read_facts(path))
    with pytest.raises(NotUndone, match="of an earlier version, without all bytes: clean the recording again"):
        undo(cleaned, tmp_path / "back", **kept)
    flipped = bytearray(content)
    flipped[100] ^= 1
    for damaged in (content[: len(content) // 2], flipped):
        path.write_bytes(damaged)
        with pytest.raises(NotUndone, match="missing or damaged: clean the recording again"):
            undo(cleaned, tmp_path / "back", **kept)
    path.unlink()
    with pytest.raises(NotUndone, match="missing or damaged"):
        undo(cleaned, tmp_path / "back", **kept)


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"source": "walk.c3d"}'])
def test_a_certificate_that_cannot_be_used_is_named(tmp_path, text):
    path = tmp_path / "certificate.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(NotUndone, match=r"certificate.json is missing or damaged"):
        undoing.read_certificate(path)
    path.write_text(json.dumps({"source": "a", "original_sha256": None, "cleaned_sha256": "0"}), encoding="utf-8")
    assert undoing.read_certificate(path)["source"] == "a"
