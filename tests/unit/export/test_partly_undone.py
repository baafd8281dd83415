"""A file in which some findings were taken back is undone further, finding by finding in any order, in every storage and format of text."""

import numpy as np
import pytest

from markermend.export.undo import NotUndone, undo
from markermend.storage import originals_file
from support import c3d_files, text_files
from support.kept_originals import anything, keep


def make(path, kind):
    """A file of a text format, or of C3D in a storage."""
    if kind in text_files.FORMATS:
        path.write_bytes(text_files.make(kind, text_files.positions()))
    else:
        residuals = np.random.default_rng(1).integers(-1, 9, (20, 4)).astype(float)
        c3d_files.write(path, storage=kind, residuals=residuals)
    return path


def findings(kept, seed):
    """A marker and a frame of each finding, in random order."""
    own = originals_file.read(kept["originals"])
    _, first = np.unique(own.finding, return_index=True)
    for at in np.random.default_rng(seed).permutation(first).tolist():
        frame = int(own.frame[at]) + own.first_frame
        yield {"markers": [own.markers[own.marker[at]]], "frames": (frame, frame)}


KINDS = [*c3d_files.STORAGES, *text_files.FORMATS]


def suffix(kind):
    return {"trc": ".trc", "qtm": ".tsv", "csv": ".csv", "nexus": ".csv", "motive": ".csv"}.get(kind, ".c3d")


@pytest.mark.parametrize("kind", KINDS)
def test_finding_by_finding_in_any_order_gives_the_original(tmp_path, kind):
    path = make(tmp_path / f"walk{suffix(kind)}", kind)
    original = path.read_bytes()
    cleaned, kept = keep(path, anything())
    for seed in range(2):
        at = cleaned
        for number, named in enumerate(findings(kept, seed)):
            done = undo(at, tmp_path / f"{seed}_{number}", **kept, **named)
            assert not done.whole or at.read_bytes() != original
            at = tmp_path / f"{seed}_{number}"
        assert number > 10 and done.whole and at.read_bytes() == original
        # The copy in the place of the next one is gone on from.
        for named in findings(kept, seed):
            done = undo(cleaned, tmp_path / f"back{seed}", **kept, **named)
        assert done.whole and (tmp_path / f"back{seed}").read_bytes() == original


@pytest.mark.parametrize("kind", KINDS)
def test_what_was_taken_back_in_part_can_be_taken_back_whole(tmp_path, kind):
    path = make(tmp_path / f"walk{suffix(kind)}", kind)
    cleaned, kept = keep(path, anything())
    undo(cleaned, tmp_path / "part", **kept, **next(findings(kept, 0)))
    assert undo(tmp_path / "part", tmp_path / "back", **kept).whole
    assert (tmp_path / "back").read_bytes() == path.read_bytes()
    assert undo(tmp_path / "back", tmp_path / "again", **kept).whole


@pytest.mark.parametrize("kind", KINDS)
def test_a_file_that_was_edited_besides_is_refused(tmp_path, kind):
    path = make(tmp_path / f"walk{suffix(kind)}", kind)
    cleaned, kept = keep(path, anything())
    one, other = list(findings(kept, 0))[:2]
    undo(cleaned, tmp_path / "part", **kept, **one)
    part, stored = (tmp_path / "part").read_bytes(), originals_file.read_bytes(kept["originals"])
    # In a sample of any finding, and before all samples.
    for place in (int(stored.start[len(stored.start) // 2]), 3):
        (tmp_path / "part").write_bytes(part[:place] + bytes([part[place] ^ 1]) + part[place + 1 :])
        with pytest.raises(NotUndone, match="part was altered after it was written"):
            undo(tmp_path / "part", tmp_path / "back", **kept, **other)
        with pytest.raises(NotUndone, match="part is another file already"):
            undo(cleaned, tmp_path / "part", **kept, **other)


def test_rows_that_lacked_cells_lack_them_again_finding_by_finding(tmp_path):
    for seed in range(10):
        path = text_files.short_rows(tmp_path / "walk.csv")
        cleaned, kept = keep(path, anything(seed, share=0.5))
        at = cleaned
        for number, named in enumerate(findings(kept, seed)):
            undo(at, tmp_path / f"{seed}_{number}", **kept, **named)
            at = tmp_path / f"{seed}_{number}"
        assert at.read_bytes() == path.read_bytes()
