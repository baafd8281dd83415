"""One table of units, one rule for files that name none, one largest coordinate, for all formats."""

from pathlib import Path

import numpy as np
import pytest

from markermend.core.recording import BadRecording
from markermend.formats import files, units
from markermend.formats.notes import Note
from support import c3d_files, text_files

CASES = [
    ("mm", "mm"),
    (" MM ", "mm"),
    ("[mm]", "mm"),
    ("(m)", "m"),
    ("mm.", "mm"),
    ("Millimeters", "mm"),
    ("mill", "mm"),
    ("centimetre", "cm"),
    ("cent", "cm"),
    ("dm", "dm"),
    ("METERS", "m"),
    ("mete", "m"),
    ("metr", "m"),
    ("Meter", "m"),
    ("metres", "m"),
    ("inch", "in"),
    ("Feet", "ft"),
    ("foot", "ft"),
]


@pytest.mark.parametrize(("name", "unit"), CASES)
def test_names_of_units(name: str, unit: str) -> None:
    assert units.unit_of(name) == unit
    assert unit in units.MILLIMETRES


@pytest.mark.parametrize("name", ["", "deg", "furlong", "Nmm", "m/s"])
def test_what_is_no_unit_of_length(name: str) -> None:
    assert units.unit_of(name) is None


def assumed(coordinates: np.ndarray) -> str:
    """The unit of a file that states none."""
    (unit,), warnings = units.settle([None], given=None, coordinates=coordinates)
    (text,) = warnings
    assert text.startswith("The file states no unit")
    return unit


@pytest.mark.parametrize(("size", "unit"), [(0.5, "m"), (9.0, "m"), (19.0, "m"), (21.0, "mm"), (800.0, "mm")])
def test_metres_are_recognised_by_the_size_of_95_percent_of_the_coordinates(size: float, unit: str) -> None:
    coordinates = np.full((500, 4, 3), size)
    assert assumed(coordinates) == unit
    coordinates[:, 0, 0] = 0.0
    coordinates[::7, 1] = np.nan
    coordinates[::5, 2] = -1e9
    coordinates[::9, 3] = np.inf
    assert assumed(coordinates) == unit
    assert assumed(-coordinates) == unit


@pytest.mark.parametrize(("size", "doubt"), [(0.5, True), (150.0, True), (250.0, False), (1e5, False)])
def test_what_cannot_be_metres_is_millimetres_without_a_warning(size: float, doubt: bool) -> None:
    _, (text,) = units.settle([None], given=None, coordinates=np.full((9, 3), size))
    assert isinstance(text, Note) != doubt


def test_without_coordinates_millimetres_are_assumed() -> None:
    for values in (np.empty((0, 3)), np.full((5, 3), np.nan), np.zeros((5, 3))):
        assert assumed(values) == "mm"


def test_each_trajectory_has_its_unit_and_the_recordings_table_takes_precedence() -> None:
    coordinates = np.full((9, 3, 3), 300.0)
    assert units.settle(["mm", "cm", "mm"], given=None, coordinates=coordinates) == (["mm", "cm", "mm"], [])
    assert units.settle([None, None], given="in", coordinates=coordinates) == (["in", "in"], [])
    assert units.settle(["mm", "cm"], given="cm", coordinates=coordinates) == (
        ["cm", "cm"],
        ["The file's unit is mm; cm of the recordings table is used."],
    )


def values(size: float) -> np.ndarray:
    """Positions of the size, in the file's unit; single precision and three decimals hold them exactly."""
    return np.round(np.random.default_rng(5).uniform(-size, size, (30, 4, 3)) * 8) / 8


def reading(folder: Path, ending: str, positions: np.ndarray, unit: str, given: str | None = None) -> files.Reading:
    path = folder / f"walk{ending}"
    if ending == ".c3d":
        c3d_files.write(path, positions, unit=unit)
    else:
        path.write_bytes(text_files.make("trc", positions).replace(b"\t4\tmm", b"\t4\t" + unit.encode()))
    return files.read(path, unlabelled=[], rate=None, unit=given)


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
def test_implausible_units_are_warned_of(tmp_path: Path, ending: str) -> None:
    assert "may be metres" in " ".join(reading(tmp_path, ending, values(2), "mm").warnings)
    assert "may be millimetres" in " ".join(reading(tmp_path, ending, values(900), "m").warnings)
    assert reading(tmp_path, ending, values(900), "mm").warnings == ()
    assert reading(tmp_path, ending, values(900), "cm").warnings == ()


@pytest.mark.parametrize("ending", [".c3d", ".trc"])
def test_an_unknown_unit_is_refused(tmp_path: Path, ending: str) -> None:
    with pytest.raises(BadRecording, match="furlong"):
        reading(tmp_path, ending, values(900), "furlong")
    with pytest.raises(BadRecording, match=r"in \(inch\) or ft \(feet\)"):
        reading(tmp_path, ending, values(900), "yard")


@pytest.mark.parametrize("ending", [".c3d", ".trc"])
@pytest.mark.parametrize("stated", ["", "mm"])
def test_the_unit_of_the_recordings_table_holds_for_reading_and_writing(
    tmp_path: Path, ending: str, stated: str
) -> None:
    positions = values(30)
    found = reading(tmp_path, ending, positions, stated, given="in")
    assert found.unit == "in"
    np.testing.assert_allclose(found.recording.positions, positions * 25.4, rtol=1e-9)
    assert found.warnings == (() if not stated else ("The file's unit is mm; in of the recordings table is used.",))
    changed = np.zeros(positions.shape[:2], bool)
    changed[7, 2] = True
    wanted = np.where(changed[..., None], 254.0, found.recording.positions)
    target = tmp_path / f"cleaned{ending}"
    result = files.write_back(
        tmp_path / f"walk{ending}",
        target,
        format=found.format,
        positions=wanted,
        changed=changed,
        columns=found.columns,
        unit="in",
    )
    again = files.read(target, unlabelled=[], rate=None, unit="in").recording.positions
    assert result.samples == 1
    np.testing.assert_allclose(again[7, 2], 254.0, rtol=0, atol=1e-9)
    np.testing.assert_array_equal(again[~changed], found.recording.positions[~changed])
