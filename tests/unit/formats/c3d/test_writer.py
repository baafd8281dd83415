"""New C3D files: two other readers find in them what was put in."""

import warnings

import c3d
import ezc3d
import numpy as np
import pytest

from markermend.formats.c3d.writer import STORAGES, Content, write_new


def trial(frames, markers, *, seed=1):
    positions = np.random.default_rng(seed).normal(0, 500, (frames, markers, 3))
    positions[3:9, 1] = np.nan
    return positions, [f"M{m:03d}" for m in range(markers)]


def read_with_c3d(path):
    with warnings.catch_warnings(), open(path, "rb") as file:
        warnings.simplefilter("ignore")
        reader = c3d.Reader(file)
        frames = [(points.copy(), samples.copy()) for _, points, samples in reader.read_frames()]
        return reader, np.array([points for points, _ in frames]), np.array([samples.T for _, samples in frames])


def tolerance(storage, positions):
    """Half a step of the integer scale, or single precision."""
    extent = np.nanmax(np.abs(positions))
    return extent / 32000 * 0.51 if storage.endswith("int") else extent * 2.0**-23


@pytest.mark.parametrize("storage", STORAGES)
@pytest.mark.parametrize("unit", ["mm", "m"])
def test_c3d_reads_equal_values(tmp_path, storage, unit):
    positions, labels = trial(40, 5)
    positions *= 0.001 if unit == "m" else 1.0
    analog = np.random.default_rng(2).normal(0, 3, (40, 4, 3))
    groups = {"SUBJECTS": {"NAMES": ["S01"], "USED": 1}, "POINT": {"DESCRIPTIONS": ["of a test"] * 5}}
    path = tmp_path / "a.c3d"
    content = Content(labels, positions, 120.0, 705, storage, unit, analog=analog, groups=groups)
    write_new(path, content)
    reader, points, samples = read_with_c3d(path)
    missing = np.isnan(positions).any(axis=2)
    assert [label.strip() for label in reader.point_labels] == labels
    assert (reader.first_frame, reader.last_frame, reader.point_rate) == (705, 744, 120.0)
    assert reader.get("POINT:UNITS").string_value.strip() == unit
    assert [name.strip() for name in reader.get("SUBJECTS:NAMES").string_array] == ["S01"]
    assert reader.get("POINT:DATA_START").uint16_value == reader.header.data_block
    assert np.array_equal(points[:, :, 3] < 0, missing)
    assert not points[missing][:, :3].any()
    assert np.abs(points[:, :, :3] - positions)[~missing].max() <= tolerance(storage, positions)
    assert np.abs(samples - analog).max() < (1e-3 if storage.endswith("int") else 1e-6)


@pytest.mark.parametrize("storage", ["pc_int", "pc_real", "dec_int", "dec_real"])
def test_ezc3d_reads_equal_values(tmp_path, storage):
    positions, labels = trial(40, 5)
    analog = np.random.default_rng(2).normal(0, 3, (40, 4, 3))
    groups = {"EVENT": {"USED": 2, "LABELS": ["Foot Strike", "Foot Off"], "TIMES": np.array([[0.0, 0.0], [0.1, 0.2]])}}
    path = tmp_path / "a.c3d"
    write_new(
        path, Content(labels=labels, positions=positions, rate=100.0, storage=storage, analog=analog, groups=groups)
    )
    read = ezc3d.c3d(str(path))
    points = read["data"]["points"][:3].transpose(2, 1, 0)
    missing = np.isnan(positions).any(axis=2)
    assert read["parameters"]["POINT"]["LABELS"]["value"] == labels
    assert read["parameters"]["EVENT"]["LABELS"]["value"] == ["Foot Strike", "Foot Off"]
    np.testing.assert_allclose(read["parameters"]["EVENT"]["TIMES"]["value"], groups["EVENT"]["TIMES"], rtol=1e-6)
    assert np.abs(points - positions)[~missing].max() <= tolerance(storage, positions)
    samples = read["data"]["analogs"][0].T.reshape(40, 4, 3)
    assert np.abs(samples - analog).max() < (1e-3 if storage.endswith("int") else 1e-6)


@pytest.mark.parametrize("storage", STORAGES)
def test_residuals_come_back_within_their_step(tmp_path, storage):
    positions = np.random.default_rng(3).normal(0, 500, (20, 4, 3))
    residuals = np.random.default_rng(4).uniform(0, 5, (20, 4))
    residuals[5, 2] = -1
    write_new(
        tmp_path / "a.c3d", Content(labels="ABCD", positions=positions, rate=50.0, storage=storage, residuals=residuals)
    )
    _, points, _ = read_with_c3d(tmp_path / "a.c3d")
    present = residuals >= 0
    assert np.abs(points[:, :, 3] - residuals)[present].max() < np.abs(positions).max() / 32000
    assert np.argwhere(points[:, :, 3] < 0).tolist() == [[5, 2]]


def test_more_than_255_labels_go_on_in_labels2(tmp_path):
    positions, labels = trial(10, 600)
    write_new(tmp_path / "a.c3d", Content(labels=labels, positions=positions, rate=100.0))
    point = ezc3d.c3d(str(tmp_path / "a.c3d"))["parameters"]["POINT"]
    assert [len(point[name]["value"]) for name in ("LABELS", "LABELS2", "LABELS3")] == [255, 255, 90]
    assert point["LABELS"]["value"] + point["LABELS2"]["value"] + point["LABELS3"]["value"] == labels
    _, points, _ = read_with_c3d(tmp_path / "a.c3d")
    np.testing.assert_allclose(points[0, :, :3], positions[0], rtol=1e-6)


def test_more_than_65535_frames(tmp_path):
    positions = np.linspace(1, 900, 70000 * 3).reshape(70000, 1, 3)
    write_new(tmp_path / "a.c3d", Content(labels=["A"], positions=positions, rate=1000.0))
    with open(tmp_path / "a.c3d", "rb") as file:
        assert c3d.Reader(file).frame_count == 70000
    points = ezc3d.c3d(str(tmp_path / "a.c3d"))["data"]["points"]
    np.testing.assert_allclose(points[:3, 0].T, positions[:, 0], rtol=1e-6)


def test_equal_arguments_give_equal_bytes(tmp_path):
    positions, labels = trial(30, 4)
    for name in ("a", "b"):
        write_new(tmp_path / name, Content(labels=labels, positions=positions, rate=100.0))
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()


def test_what_does_not_fit_is_refused(tmp_path):
    positions, labels = trial(30, 4)
    with pytest.raises(ValueError, match="do not fit 3 labels"):
        write_new(tmp_path / "a", Content(labels=labels[:3], positions=positions, rate=100.0))
    with pytest.raises(ValueError, match="blocks"):
        write_new(
            tmp_path / "a",
            Content(labels=[f"{n:0200d}" for n in range(4)] * 200, positions=np.zeros((1, 800, 3)), rate=1),
        )
    assert not list(tmp_path.iterdir())
