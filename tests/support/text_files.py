"""Text files of each capture program, made from arrays: what the tests of the text formats read and patch."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from markermend.formats.reading import Reading
from markermend.formats.text import reader

MARKERS = ("LASI", "RASI", "C7", "T10")
"""Names of the markers in these files."""

FORMATS = ("trc", "nexus", "motive", "qtm", "csv")

MISSING_TEXT = {"qtm": "0.000"}
"""How each format writes a missing coordinate here; blank where not listed."""

UNITS = {"trc": 1.0, "nexus": 1.0, "motive": 1000.0, "qtm": 1.0, "csv": 1.0}
"""mm per unit of each file."""


def positions(frames: int = 30, markers: int = 4, seed: int = 5) -> np.ndarray:
    """Positions (frames, markers, 3) in mm, exact in three decimals of mm; two gaps in the second marker."""
    rng = np.random.default_rng(seed)
    values = np.round(rng.uniform(-2000, 2000, (frames, markers, 3)), 3)
    values[4:7, 1] = np.nan
    values[9, 1] = np.nan
    return values


def make(format: str, values: np.ndarray, *, first_frame: int = 101, rate: int = 100, end: str = "\r\n") -> bytes:
    """The bytes of a file of a format with these positions (mm, NaN = missing) of MARKERS."""
    maker = {"trc": _trc, "nexus": _nexus, "motive": _motive, "qtm": _qtm, "csv": _csv}[format]
    cells = [
        [_text(value / UNITS[format], 6 if format == "motive" else 3, MISSING_TEXT.get(format, "")) for value in row]
        for row in values.reshape(len(values), 3 * len(MARKERS)).tolist()
    ]
    numbers = range(first_frame, first_frame + len(values))
    rows = [(number, (number - first_frame) / rate, row) for number, row in zip(numbers, cells, strict=True)]
    return (end.join(maker(rows, rate, first_frame)) + end).encode()


def _text(value: float, decimals: int, missing: str) -> str:
    return missing if np.isnan(value) else f"{value:.{decimals}f}"


Rows = Sequence[tuple[int, float, list[str]]]


def _trc(rows: Rows, rate: int, first_frame: int) -> list[str]:
    return [
        "PathFileType\t4\t(X/Y/Z)\tsynthetic.trc",
        "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames",
        f"{rate}\t{rate}\t{len(rows)}\t{len(MARKERS)}\tmm\t{rate}\t{first_frame}\t{len(rows)}",
        "Frame#\tTime\t" + "".join(f"{name}\t\t\t" for name in MARKERS),
        "\t\t" + "\t".join(f"X{i}\tY{i}\tZ{i}" for i in range(1, len(MARKERS) + 1)) + "\t",
        "",
        *("\t".join([str(number), f"{time:.3f}", *row, ""]) for number, time, row in rows),
    ]


def _nexus(rows: Rows, rate: int, first_frame: int) -> list[str]:
    devices = ["Devices", "1000", ",,Plate,,", "Frame,Sub Frame,Fx,Fy,Fz", ",,N,N,N"]
    return [
        *devices,
        *(f"{number},{sub},1.5,-2.5,0" for number, _, _ in rows for sub in range(2)),
        "",
        "Trajectories",
        str(rate),
        ",," + ",,,".join(f"Ann:{name}" for name in MARKERS) + ",,",
        "Frame,Sub Frame" + ",X,Y,Z" * len(MARKERS),
        "," + ",mm,mm,mm" * len(MARKERS),
        *(",".join([str(number), "0", *row]) for number, _, row in rows),
        "",
        "Joints",
        str(rate),
        "Frame,Sub Frame,RX,RY,RZ",
        "1,0,0.5,0.25,0.125",
    ]


def _motive(rows: Rows, rate: int, first_frame: int) -> list[str]:
    count = len(MARKERS)
    solved = ["0.1", "0.2", "0.3", "0.9", "0.4", "0.5", "0.6", "0.001"]
    return [
        f"Format Version,1.21,Take Name,Take 1,Export Frame Rate,{rate}.000000,Total Exported Frames,{len(rows)},"
        "Rotation Type,Quaternion,Length Units,Meters,Coordinate Space,Global",
        "",
        ",Type" + ",Rigid Body" * 8 + ",Marker" * (3 * count + 3),
        ",Name" + ",Body" * 8 + "".join(f",Body:{name}" * 3 for name in MARKERS) + ",Unlabeled:7" * 3,
        ",ID" + ',"C,F"' * 8 + ',"A1"' * (3 * count + 3),
        "," + ",Rotation" * 4 + ",Position" * 3 + ",Error Per Marker" + ",Position" * (3 * count + 3),
        "Frame,Time,X,Y,Z,W,X,Y,Z," + ",X,Y,Z" * (count + 1),
        *(",".join([str(number), f"{time:.6f}", *solved, *row, "1.0", "", "2.0"]) for number, time, row in rows),
    ]


def _qtm(rows: Rows, rate: int, first_frame: int) -> list[str]:
    names = "\t".join(MARKERS)
    return [
        f"NO_OF_FRAMES\t{len(rows)}",
        f"NO_OF_MARKERS\t{len(MARKERS)}",
        f"FREQUENCY\t{rate}",
        "TIME_STAMP\t2026-01-19, 10:24:53.089\t2063941.2",
        "DATA_INCLUDED\t3D",
        f"MARKER_NAMES\t{names}",
        "TRAJECTORY_TYPES" + "\tMeasured" * len(MARKERS),
        "Frame\tTime\t" + "\t".join(f"{name} {axis}" for name in MARKERS for axis in "XYZ"),
        *("\t".join([str(number), f"{time:.5f}", *row]) for number, time, row in rows),
    ]


def _csv(rows: Rows, rate: int, first_frame: int) -> list[str]:
    return [
        "frame,time,emg," + ",".join(f"{name}_{axis} (mm)" for name in MARKERS for axis in "xyz"),
        *(",".join([str(number), f"{time:.4f}", "0.125", *row]) for number, time, row in rows),
    ]


def read(folder: Path, content: bytes, *, name: str = "walk.txt", rate: float | None = None) -> Reading:
    """The reading of a file with this content; names such as *17 count as unlabelled."""
    path = folder / name
    path.write_bytes(content)
    return reader.read(path, unlabelled=[r"\*\d+"], rate=rate)


def patched(
    folder: Path, content: bytes, samples: dict[tuple[int, int], list[float]], rate: float | None = None
) -> bytes:
    """What patching some samples makes of a file, given the positions by frame and marker."""
    reading = read(folder, content, rate=rate)
    wanted, changed = reading.recording.positions.copy(), np.zeros(reading.recording.missing.shape, bool)
    for where, position in samples.items():
        wanted[where], changed[where] = position, True
    result = reader.patch(
        folder / "walk.txt",
        folder / "new",
        format=reading.format,
        positions=wanted,
        changed=changed,
        columns=reading.columns,
    )
    assert result.samples + len(result.refused) == len(samples)
    return (folder / "new").read_bytes()


def assert_positions(reading: Reading, values: np.ndarray) -> None:
    """Check the positions of a reading, mm."""
    np.testing.assert_allclose(reading.recording.positions, values, rtol=0, atol=1e-9)


def short_rows(path: Path) -> Path:
    """Write a table in which rows end where nothing more was seen."""
    rows = ["Frame,Time," + ",".join(f"{name}_{axis} (mm)" for name in "ABC" for axis in "xyz")]
    rows += [f"{n},{n / 100},1{n}.0,2.0,3.0,4.0,5.{n},6.0,7.0,8.0,9.{n}" for n in range(1, 9)]
    rows[3], rows[5], rows[6] = "3,0.03,13.0,2.0,3.0", "5,0.05,15.0,2.0,3.0,4.0", "6,0.06"
    path.write_bytes("\r\n".join(rows).encode())
    return path
