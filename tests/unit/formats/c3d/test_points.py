"""Points are decoded by the missing-sample rule and encoded as the number format allows."""

import numpy as np
import pytest

from markermend.formats.c3d import reader
from markermend.formats.c3d.points import decode, decode_word4, map_points
from support.c3d_files import STORAGES, layout_of, read, section_of, set_word4, trajectories, write


def edit(path, target, frames, markers, **where):
    """Change samples of a file: (n, 3) positions as given, NaN for missing."""
    reading = read(path)
    positions = reading.recording.positions.copy()
    changed = np.zeros(positions.shape[:2], bool)
    positions[frames, markers], changed[frames, markers] = where["to"], True
    return reader.patch(path, target, positions=positions, changed=changed, columns=reading.columns), positions


def test_each_clause_of_the_missing_sample_rule(tmp_path):
    positions = trajectories()
    positions[2, 0], positions[3, 0] = 0.0, [0.0, 0.0, 5.0]
    path = write(tmp_path / "walk.c3d", positions)
    layout = layout_of(path)
    stored = map_points(path, layout, section_of(path).coding, writable=True)
    stored[5, 1, 3] = -1.0
    stored[6, 1, 3] = 65535.0
    stored[7, 1] = [0, 0, 0, 65535.0]
    stored[8, 1, 3] = 32767.0
    stored[9, 2, 1] = np.nan
    stored[10, 2, 0] = np.inf
    stored[11, 2, 3] = np.nan
    stored[12, 3, :3] = -1e9
    del stored
    reading = read(path)
    assert reading.missing == {"residual": 3, "zero": 1, "not finite": 3, "out of range": 1}
    expected = np.zeros((20, 4), bool)
    expected[[2, 5, 6, 7, 9, 10, 11, 12], [0, 1, 1, 1, 2, 2, 2, 3]] = True
    np.testing.assert_array_equal(reading.recording.missing, expected)
    assert (np.isnan(reading.recording.positions).all(axis=2) == expected).all()


@pytest.mark.parametrize("storage", STORAGES)
def test_word_4_is_residual_and_camera_mask(tmp_path, storage):
    path = write(tmp_path / "walk.c3d", storage=storage)
    layout, coding = layout_of(path), section_of(path).coding
    stored = map_points(path, layout, coding, writable=True)
    word = 0x5307 if layout.real else np.int16(0x5307)
    stored[4, 2, 3] = coding.encode_floats(np.array(float(word))) if layout.real else word
    residual, cameras = decode_word4(decode(stored, layout, coding)[1], layout.scale)
    assert residual[4, 2] == pytest.approx(7 * layout.scale) and cameras[4, 2] == 0x53


def test_residuals_that_are_all_negative_are_disregarded(tmp_path):
    positions = trajectories()
    positions[4, 1] = 0.0
    path = write(tmp_path / "walk.c3d", positions, residuals=np.full((20, 4), -1.0))
    reading = read(path)
    assert reading.missing == {"residual": 0, "zero": 1, "not finite": 0, "out of range": 0}
    assert "Every residual is -1" in " ".join(reading.warnings)
    set_word4(path, layout_of(path), 7, 2, 0.0, "<f")
    assert read(path).missing["residual"] == 79


@pytest.mark.parametrize("storage", STORAGES)
def test_a_repaired_sample_among_negative_residuals_does_not_make_the_others_missing(tmp_path, storage):
    path, target = tmp_path / "a.c3d", tmp_path / "b.c3d"
    write(path, trajectories(), storage=storage, residuals=np.full((20, 4), -1.0))
    edit(path, target, [7, 9], [2, 3], to=[[1.0, 2.0, 3.0], [np.nan] * 3])
    before, after = read(path).recording, read(target).recording
    differs = np.argwhere((before.positions != after.positions).any(axis=2)).tolist()
    assert differs == [[7, 2], [9, 3]] and np.argwhere(after.missing).tolist() == [[9, 3]]


def test_residuals_of_unlabelled_trajectories_count_where_those_of_markers_do(tmp_path):
    residuals = np.zeros((20, 4))
    residuals[:, 3] = -1.0
    labels = ["A", "B", "C", "*3"]
    reading = read(write(tmp_path / "a.c3d", trajectories(), labels=labels, residuals=residuals))
    assert np.isnan(reading.recording.unlabelled["*3"]).all() and not reading.recording.missing.any()
    reading = read(write(tmp_path / "b.c3d", trajectories(), labels=labels, residuals=np.full((20, 4), -1.0)))
    assert not np.isnan(reading.recording.unlabelled["*3"]).any() and not reading.recording.missing.any()


@pytest.mark.parametrize("storage", STORAGES)
def test_what_the_number_format_cannot_hold_is_refused(tmp_path, storage):
    path, target = write(tmp_path / "a.c3d", storage=storage), tmp_path / "b.c3d"
    scale, real = layout_of(path).scale, storage.endswith("real")
    beyond = 1e39 if real else 32768 * scale
    largest = 32767 * scale
    result, _ = edit(path, target, [1, 2, 3], [0, 1, 3], to=[[1.0, beyond, 1.0], [largest] * 3, [0.0] * 3])
    assert (result.samples, result.refused) == (1, ((1, 0), (3, 3)))
    before, after = read(path).recording.positions, read(target).recording.positions
    np.testing.assert_allclose(after[2, 1], largest, rtol=1e-6)
    before[2, 1] = after[2, 1]
    np.testing.assert_array_equal(after, before)
