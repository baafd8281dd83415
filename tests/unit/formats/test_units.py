"""One table of units, one rule for files that name none, one largest coordinate, for all formats."""

from pathlib import Path

import numpy as np
import pytest

from markermend.core.recording import BadRecording
from markermend.formats import files, units
from support import c3d_files, text_files

CASES = [
    ("mm", "mm"),
    (" MM ", "mm"),
    ("Millimeters", "mm"),
    ("mill", "mm"),
    ("centimetre", "cm"),
    ("cent", "cm"),
    ("dm", "dm"),
    ("METERS", "m"),
    ("mete", "m"),
    ("inch", "in"),
    ("Feet", "ft"),
]


@pytest.mark.parametrize(("name", "unit"), CASES)
def test_names_of_units(name: str, unit: str) -> None:
    assert units.unit_of(name) == unit
    assert unit in units.MILLIMETRES


@pytest.mark.parametrize("name", ["", "deg", "furlong", "Nmm", "m/s"])
def test_what_is_no_unit_of_length(name: str) -> None:
    assert units.unit_of(name) is None


@pytest.mark.parametrize(("size", "metres"), [(0.5, True), (9.0, True), (19.0, True), (21.0, False), (800.0, False)])
def test_metres_are_recognised_by_the_size_of_95_percent_of_the_coordinates(size: float, metres: bool) -> None:
    coordinates = np.full((500, 4, 3), size)
    assert units.are_likely_metres(coordinates) == metres
    coordinates[:, 0, 0] = 0.0
    coordinates[::7, 1] = np.nan
    coordinates[::5, 2] = -1e9
    coordinates[::9, 3] = np.inf
    assert units.are_likely_metres(coordinates) == metres
    assert units.are_likely_metres(-coordinates) == metres


def test_without_coordinates_nothing_is_metres() -> None:
    for values in (np.empty((0, 3)), np.full((5, 3), np.nan), np.zeros((5, 3))):
        assert not units.are_likely_metres(values)


def values(size: float) -> np.ndarray:
    """Positions of the size, in the file's unit; single precision and three decimals hold them exactly."""
    return np.round(np.random.default_rng(5).uniform(-size, size, (30, 4, 3)) * 8) / 8


def reading(folder: Path, ending: str, positions: np.ndarray, unit: str) -> files.Reading:
    path = folder / f"walk{ending}"
    if ending == ".c3d":
        c3d_files.write(path, positions, unit=unit)
    else:
        path.write_bytes(text_files.make("trc", positions).replace(b"\t4\tmm", b"\t4\t" + unit.encode()))
    return files.read(path, unlabelled=[], rate=None)


@pytest.mark.parametrize("ending", [".c3d", ".trc"])
@pytest.mark.parametrize(
    ("size", "unit", "used"), [(900, "", "mm"), (15, "", "m"), (2, "cent", "cm"), (3, "METERS", "m")]
)
def test_all_formats_follow_the_same_rules(tmp_path: Path, ending: str, size: float, unit: str, used: str) -> None:
    positions = values(size)
    positions[3, 1] = units.LARGEST
    positions[4, 2, 0] = -0.99 * units.LARGEST
    found = reading(tmp_path, ending, positions, unit)
    assert found.unit == used
    assert found.missing["out of range"] == 1 and found.recording.missing.sum() == 1
    positions[3, 1] = np.nan
    np.testing.assert_allclose(found.recording.positions, positions * units.MILLIMETRES[used], rtol=1e-9)


@pytest.mark.parametrize("ending", [".c3d", ".trc"])
def test_small_coordinates_in_mm_are_warned_of(tmp_path: Path, ending: str) -> None:
    assert "may be metres" in " ".join(reading(tmp_path, ending, values(2), "mm").warnings)
    assert reading(tmp_path, ending, values(900), "mm").warnings == ()


@pytest.mark.parametrize("ending", [".c3d", ".trc"])
def test_an_unknown_unit_is_refused(tmp_path: Path, ending: str) -> None:
    with pytest.raises(BadRecording, match="furlong"):
        reading(tmp_path, ending, values(900), "furlong")
