"""A damaged recording after repair and filling: every change is named, and its original values bring back what was measured."""

import numpy as np
import pytest

from markermend.core.applied_changes import applied_changes
from markermend.core.changes import Outcome
from markermend.core.originals import find_originals, restore_originals
from markermend.core.recording import changed
from markermend.storage import change_file, originals_file, stage_files
from markermend.storage.original_bytes import OriginalBytes
from support import fillings
from support.repairs import mend
from support.treated import treated


@pytest.fixture(scope="module")
def cleaned(contaminated):
    """The recording as measured, and after repair of what is known to be wrong with it, and filling."""
    near = fillings.neighbours(contaminated.recording.positions)
    repaired = mend(contaminated.recording, contaminated.events, near=near, max_repair_s=0.3)
    filled = treated(fillings.fill(repaired, near, members=["spline"], averaging={"pseudo_gaps": 1}, max_gap_s=None))
    return contaminated.recording, filled, (*repaired.changes, *filled.changes)


def test_every_kind_of_change_is_there(cleaned):
    _, _, changes = cleaned
    assert {change.outcome for change in changes} >= {"repaired", "exchanged", "filled", "blanked"}


def test_every_sample_that_differs_is_named(cleaned):
    measured, result, changes = cleaned
    named = np.zeros(measured.missing.shape, bool)
    for change in applied_changes(measured, result, changes):
        named[change.start : change.stop, measured.markers.index(change.marker)] = True
        assert change.outcome is not Outcome.LEFT and change.samples > 0
    assert named[changed(measured, result)].all()


def test_the_files_bring_back_what_was_measured(cleaned, tmp_path):
    measured, result, changes = cleaned
    stage_files.write_recording(tmp_path / "07_filled.parquet", result, {})
    change_file.write(tmp_path / "07_changes.parquet", changes, {})
    applied = applied_changes(measured, result, change_file.read(tmp_path / "07_changes.parquet"))
    found = find_originals(measured, result, applied)
    assert "" not in found.classes
    none = np.zeros(0, int)
    stored = OriginalBytes(none, none, none, (), (), np.zeros(0, bool))
    originals_file.write(tmp_path / "originals.parquet", found, stored, {})
    read = stage_files.read_recording(tmp_path / "07_filled.parquet")
    originals = originals_file.read(tmp_path / "originals.parquet")
    assert originals.measured.sum() == (changed(measured, result) & ~measured.missing).sum() > 0
    back = restore_originals(read.positions, read.markers, originals)
    assert back.tobytes() == measured.positions.tobytes()
