"""The real C3D files: clean, raw, in six storages, and odd."""

import sys

import c3d as second_reader
import numpy as np
import pytest

from markermend.core.recording import BadRecording
from markermend.formats import files
from markermend.formats.c3d.data_layout import locate
from support.c3d_files import STORAGES, UNLABELLED, section_of
from support.ezc3d_strings import strings_by_ezc3d

pytestmark = [pytest.mark.data, pytest.mark.filterwarnings("ignore::UserWarning:c3d")]


def read(path):
    return files.read(path, unlabelled=UNLABELLED, rate=None)


def test_six_storages_hold_the_same_trial(data):
    readings = {storage: read(data / f"bytes/{storage}.c3d") for storage in STORAGES}
    path = data / "bytes/pc_int.c3d"
    scale = locate(section_of(path), path.stat().st_size, path.name).scale
    expected = readings["pc_real"]
    for storage, reading in readings.items():
        assert reading.recording.markers == expected.recording.markers
        assert reading.missing == expected.missing
        tolerance = 1e-4 if storage.endswith("real") else scale * 1.001
        np.testing.assert_allclose(reading.recording.positions, expected.recording.positions, rtol=0, atol=tolerance)


@pytest.mark.parametrize(
    ("name", "frames", "markers", "rate", "first", "unit"),
    [
        ("clean/85_02", 810, 41, 120, 1, "mm"),
        ("clean/85_12", 4499, 41, 120, 1, "mm"),
        ("clean/HDM_mm_01-02_03_120", 3990, 41, 120, 1, "mm"),
        ("clean/Qualisys", 340, 55, 200, 705, "mm"),
        ("raw/kinematics_tennis_serve", 1092, 39, 50, 1, "m"),
    ],
)
def test_clean_recordings_are_complete(data, name, frames, markers, rate, first, unit):
    reading = read(data / f"{name}.c3d")
    recording = reading.recording
    assert (recording.frames, len(recording.markers), recording.rate) == (frames, markers, rate)
    assert (recording.first_frame, reading.unit, reading.warnings) == (first, unit, ())
    assert not recording.missing.any()


def test_known_gaps(data):
    kneel = read(data / "clean/KneeltoProne01.c3d").recording
    counts = dict(zip(kneel.markers, kneel.missing.sum(axis=0).tolist(), strict=True))
    assert {marker: count for marker, count in counts.items() if count} == {"RAC": 153, "RFTM": 5}
    serve = read(data / "raw/kinematics_tennis_serve_nan.c3d").recording
    spans = [(134, 148), (192, 196), (331, 339), (373, 386), (498, 521)]
    spans += [(549, 556), (660, 702), (735, 747), (862, 873), (917, 928)]
    expected = np.zeros(serve.missing.shape, bool)
    for start, stop in spans:
        expected[start:stop, serve.markers.index("Derrick:RSHO")] = True
    np.testing.assert_array_equal(serve.missing, expected)


def test_unlabelled_trajectories_of_hdm(data):
    reading = read(data / "clean/HDM_mm_01-02_03_120.c3d")
    assert reading.unlabelled == ("*0", "*1", "*2") and reading.columns[:2] == (3, 4)


@pytest.mark.parametrize(
    "name",
    [f"bytes/{storage}" for storage in STORAGES] + ["raw/nick_freeform_001", "raw/UNIPD_Walking2", "clean/Qualisys"],
)
def test_the_second_reader_agrees(data, name):
    reading = read(data / f"{name}.c3d")
    with open(data / f"{name}.c3d", "rb") as file:
        theirs = np.array([points for _, points, _ in second_reader.Reader(file).read_frames()])
    theirs = theirs[:, list(reading.columns)]
    missing = (theirs[..., 3] < 0) | (theirs[..., :3] == 0).all(axis=2)
    np.testing.assert_array_equal(reading.recording.missing, missing)
    np.testing.assert_allclose(reading.recording.positions[~missing], theirs[~missing][:, :3], atol=2e-4)


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("Empty", "is empty"),
        ("simple", "no C3D parameter section"),
        ("gait-raw", "is not a C3D file"),
        ("C3DRotationExample", "no 3-D data"),
        ("1.5mps_05", "no 3-D data"),
    ],
)
def test_odd_files_are_refused_with_name_and_reason(data, name, reason):
    with pytest.raises(BadRecording, match=rf"{name}\.c3d.*{reason}"):
        read(data / f"odd/{name}.c3d")


@pytest.mark.parametrize(
    ("name", "shape", "warning"),
    [
        ("Optotrak", (29, 54), "29 of the 1149 frames"),
        ("kyowadengyo", (152, 11), "152 frames of 11 points"),
        ("giant", (355, 29), "Every residual is -1"),
        ("giant", (355, 29), "m is assumed"),
        ("bad_parameter_section", (332, 45), "parameter section is damaged"),
        ("badParameterOffset", (111, 41), "parameter section is damaged"),
        ("duplicate_labels", (1050, 48), "several trajectories were numbered"),
    ],
)
def test_odd_files_are_read_with_a_warning(data, name, shape, warning):
    reading = read(data / f"odd/{name}.c3d")
    assert reading.recording.positions.shape[:2] == shape
    assert warning in " ".join(reading.warnings)
    steps = np.linalg.norm(np.diff(reading.recording.positions, axis=0), axis=2)
    assert np.nanmedian(steps) < 40 and np.nanmax(np.abs(reading.recording.positions)) < 6000


def test_kyowadengyo_keeps_its_first_frame_and_number_format(data):
    reading = read(data / "odd/kyowadengyo.c3d")
    assert reading.recording.first_frame == 33


@pytest.mark.parametrize(
    "name",
    [
        *(f"bytes/{storage}" for storage in STORAGES),
        "clean/Qualisys",
        "raw/kinematics_tennis_serve_nan",
        "odd/kyowadengyo",
    ],
)
def test_only_changed_samples_are_written_back(data, tmp_path, name):
    original, target = data / f"{name}.c3d", tmp_path / "cleaned.c3d"
    before = read(original)
    rng = np.random.default_rng(3)
    changed = rng.random(before.recording.missing.shape) < 0.01
    positions = np.where(changed[..., None], rng.uniform(100, 900, (*changed.shape, 3)), before.recording.positions)
    result = files.write_back(
        original, target, format="c3d", positions=positions, changed=changed, columns=before.columns
    )
    assert (result.samples, result.refused) == (changed.sum(), ())
    after = read(target)
    layout = locate(section_of(original), original.stat().st_size, original.name)
    tolerance = 1e-4 if layout.real else layout.scale / 2 * 1.001
    np.testing.assert_allclose(after.recording.positions[changed], positions[changed], rtol=0, atol=tolerance)
    np.testing.assert_array_equal(after.recording.positions[~changed], before.recording.positions[~changed])
    old, new = (np.frombuffer(path.read_bytes(), np.uint8) for path in (original, target))
    differing = np.flatnonzero(old != new) - layout.start
    frame, within = differing // layout.stride, differing % layout.stride
    point = within // (16 if layout.real else 8)
    column = {column: marker for marker, column in enumerate(before.columns)}
    assert differing.size and all(changed[f, column[p]] for f, p in zip(frame, point, strict=True))


def test_a_long_recording_is_read_by_arrays_not_by_samples(data):
    calls = []
    sys.setprofile(lambda _frame, event, _argument: calls.append(event) if event == "call" else None)
    try:
        reading = read(data / "clean/85_12.c3d")
    finally:
        sys.setprofile(None)
    assert len(calls) < reading.recording.positions.size / 50


def test_ezc3d_reads_the_same_strings(data):
    """Of every parameter that holds any; ezc3d adds empty ones, and blank strings where the file has room for none.

    Odd files are left out, since ezc3d may end the process on them.
    """
    compared = 0
    for path in sorted(path for path in data.rglob("*.c3d") if path.parent.name != "odd"):
        try:
            section, theirs = section_of(path), strings_by_ezc3d(path)
        except (BadRecording, OSError, RuntimeError, ValueError):
            continue
        for group, parameters in theirs.items():
            for name, strings in parameters.items():
                if section.sound and any(strings):
                    assert list(section.groups[group][name]) == strings or group == "EZC3D", (path.name, group, name)
                    compared += 1
    assert compared > 100
