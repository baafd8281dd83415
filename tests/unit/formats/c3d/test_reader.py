"""C3D files are read by the missing-sample rule, and only changed samples are written back."""

import c3d as second_reader
import ezc3d
import numpy as np
import pytest

from markermend.core.recording import BadRecording
from markermend.formats.c3d import reader
from markermend.formats.c3d.points import decode, map_points
from support.c3d_files import STORAGES, layout_of, read, section_of, trajectories, write


@pytest.mark.parametrize("storage", STORAGES)
def test_every_storage_is_read(tmp_path, storage):
    positions = trajectories()
    positions[3:7, 1] = np.nan
    analog = np.arange(20 * 5 * 3, dtype=float).reshape(20, 5, 3)
    path = write(tmp_path / "walk.c3d", positions, storage=storage, first_frame=705, analog=analog)
    reading = read(path)
    tolerance = 0 if storage.endswith("real") else layout_of(path).scale / 2 * 1.0001
    np.testing.assert_allclose(reading.recording.positions, positions, rtol=0, atol=tolerance)
    assert (reading.recording.rate, reading.recording.first_frame) == (100.0, 705)
    assert (reading.format, reading.unit, reading.columns) == ("c3d", "mm", (0, 1, 2, 3))
    assert reading.missing == {"residual": 4, "zero": 0, "not finite": 0, "out of range": 0}
    assert reading.warnings == ()


@pytest.mark.parametrize(("unit", "size", "found"), [("mm", 1000, "mm"), ("m", 1, "m"), ("", 1000, "mm"), ("", 1, "m")])
def test_units_become_mm(tmp_path, unit, size, found):
    positions = trajectories(size=size)
    reading = read(write(tmp_path / "walk.c3d", positions, unit=unit))
    np.testing.assert_allclose(reading.recording.positions, positions * (1000 if found == "m" else 1), rtol=1e-12)
    assert reading.unit == found
    assert ("states no unit" in " ".join(reading.warnings)) == (unit == "")


def test_metres_declared_as_mm_are_warned_of(tmp_path):
    reading = read(write(tmp_path / "walk.c3d", trajectories(size=1.0)))
    assert reading.unit == "mm" and "may be metres" in " ".join(reading.warnings)


@pytest.mark.parametrize(
    ("right", "up", "screen"),
    [("+X", "+Z", ("+X", "+Z")), (" -y ", "+Z", ("-Y", "+Z")), ("+X", "-X", None), ("+X", "", None), ("X", "Z", None)],
)
def test_directions_of_the_screen(tmp_path, right, up, screen):
    path = write(tmp_path / "walk.c3d", groups={"POINT": {"X_SCREEN": [right], "Y_SCREEN": [up]}})
    assert read(path).screen == screen


def test_one_unit_per_point(tmp_path):
    groups = {"POINT": {"UNITS": ["mm", "m", "deg", "mm"]}}
    positions = trajectories()
    positions[:, 1] /= 1000
    reading = read(write(tmp_path / "walk.c3d", positions, groups=groups))
    assert reading.recording.markers == ("M0", "M1", "M3") and reading.columns == (0, 1, 3)
    assert reading.model_outputs == ("M2",)
    np.testing.assert_allclose(reading.recording.positions, positions[:, [0, 1, 3]] * [[1], [1000], [1]], rtol=1e-6)


def test_unknown_unit_is_refused(tmp_path):
    with pytest.raises(BadRecording, match="furlong"):
        read(write(tmp_path / "walk.c3d", unit="furlong"))


def test_model_outputs_and_unlabelled_trajectories_are_left_alone(tmp_path):
    labels = ["Anna:LASI", "LHipAngles", "*12", "Anna:RASI", "LForce", "", "Bob:LASI"]
    groups = {"POINT": {"TYPE_GROUPS": ["ANGLES", "FORCES"], "ANGLES": ["LHipAngles"], "FORCES": ["LForce", "x"]}}
    reading = read(write(tmp_path / "walk.c3d", trajectories(markers=7), labels=labels, groups=groups))
    assert reading.recording.markers == ("Anna:LASI", "Anna:RASI", "Bob:LASI")
    assert reading.columns == (0, 3, 6)
    assert reading.model_outputs == ("LHipAngles", "LForce")
    assert reading.unlabelled == ("*12", "unnamed#1")


def test_duplicate_and_padded_labels(tmp_path):
    reading = read(write(tmp_path / "walk.c3d", labels=["LASI   ", "C7", "LASI", "C7 "]))
    assert reading.recording.markers == ("LASI", "C7", "LASI#2", "C7#2")
    assert "LASI, C7" in reading.warnings[0]


def test_more_than_255_labels(tmp_path):
    labels = [f"M{m}" for m in range(600)]
    positions = trajectories(3, 600)
    reading = read(write(tmp_path / "crowd.c3d", positions, labels=labels))
    assert reading.recording.markers == tuple(labels) and reading.warnings == ()
    np.testing.assert_array_equal(reading.recording.positions, positions)


def test_more_and_fewer_labels_than_points(tmp_path):
    more = {"POINT": {"LABELS": ["A", "B", "C", "D", "E"]}}
    reading = read(write(tmp_path / "more.c3d", groups=more))
    assert reading.recording.markers == tuple("ABCD") and "5 labels for 4 points" in reading.warnings[0]
    reading = read(write(tmp_path / "fewer.c3d", groups={"POINT": {"LABELS": ["A", "B", "C"]}}))
    assert reading.recording.markers == tuple("ABC") and reading.unlabelled == ("unnamed#1",)
    assert "Only 3 labels for 4 points" in reading.warnings[0]


def edit(path, target, frames, markers, **where):
    """Change samples of a file: (n, 3) positions as given, NaN for missing."""
    reading = read(path)
    positions = reading.recording.positions.copy()
    changed = np.zeros(positions.shape[:2], bool)
    positions[frames, markers], changed[frames, markers] = where["to"], True
    return reader.patch(path, target, positions=positions, changed=changed, columns=reading.columns), positions


@pytest.mark.parametrize("storage", STORAGES)
@pytest.mark.parametrize("unit", ["mm", "m"])
def test_patch_changes_only_the_changed_samples(tmp_path, storage, unit):
    positions = trajectories(size=1000 if unit == "mm" else 1)
    positions[3, 1] = np.nan
    labels = ["A", "*1", "B", "C"]
    analog = np.ones((20, 2, 3))
    path = write(tmp_path / "a.c3d", positions, labels=labels, storage=storage, unit=unit, analog=analog)
    target = tmp_path / "b.c3d"
    to = np.array([[123.456, -0.25, 999.0], [np.nan] * 3, [500.0, 500.0, 500.0]])
    result, wanted = edit(path, target, [3, 5, 19], [1, 2, 0], to=to)
    assert (result.samples, result.refused) == (3, ())
    layout = layout_of(path)
    width = 16 if layout.real else 8
    allowed = {
        layout.start + frame * layout.stride + point * width + byte
        for frame, point in [(3, 2), (5, 3), (19, 0)]
        for byte in range(width)
    }
    before, after = (np.frombuffer(p.read_bytes(), np.uint8) for p in (path, target))
    differing = np.flatnonzero(before != after)
    assert len(before) == len(after) and differing.size > 0 and set(differing.tolist()) <= allowed
    reading = read(target)
    scale = 1000 if unit == "m" else 1
    tolerance = 1e-4 if layout.real else layout.scale * scale / 2 * 1.0001
    np.testing.assert_allclose(reading.recording.positions, wanted, rtol=0, atol=tolerance)
    coding = section_of(target).coding
    written, word4 = decode(map_points(target, layout, coding), layout, coding)
    assert word4[3, 2] == 0 and word4[19, 0] == 0 and word4[5, 3] == -1
    np.testing.assert_array_equal(written[5, 3], [0, 0, 0])


@pytest.mark.filterwarnings("ignore:No analog data")
@pytest.mark.parametrize("storage", STORAGES)
def test_other_readers_open_a_patched_file(tmp_path, storage):
    path, target = write(tmp_path / "a.c3d", storage=storage), tmp_path / "b.c3d"
    edit(path, target, [4, 6], [1, 2], to=[[300.0, 400.0, 500.0], [np.nan] * 3])
    expected = read(target).recording.positions
    with open(target, "rb") as file:
        frames = [points for _, points, _ in second_reader.Reader(file).read_frames()]
    theirs = np.array(frames)
    seen = theirs[..., 3] >= 0
    np.testing.assert_array_equal(seen, ~np.isnan(expected[..., 0]))
    np.testing.assert_allclose(theirs[seen][:, :3], expected[seen], atol=1e-3)
    if not storage.startswith("sgi"):
        points = np.moveaxis(ezc3d.c3d(str(target))["data"]["points"][:3], 0, 2)
        np.testing.assert_allclose(points.transpose(1, 0, 2)[seen], expected[seen], atol=1e-3)


def test_patch_without_changes_is_a_copy(tmp_path):
    path, target = write(tmp_path / "a.c3d"), tmp_path / "b.c3d"
    recording = read(path).recording
    none = np.zeros((20, 4), bool)
    result = reader.patch(path, target, positions=recording.positions, changed=none, columns=range(4))
    assert result.samples == 0 and target.read_bytes() == path.read_bytes()
    with pytest.raises(ValueError, match="do not fit"):
        reader.patch(path, target, positions=recording.positions[1:], changed=none, columns=range(4))
