"""Writes made-up recordings for the tutorials and the pictures of this site: one data set of those below, into FOLDER.

    python docs/made_up.py gait FOLDER

gait      one subject as C3D: a static trial and walking trials, with gaps and artifacts as raw data have them
studio    two takes of a performer with a sword, as CSV of Motive: markers that are hidden for seconds
archive   subjects over two days as C3D, static trials among them, and a file that was cut off
classes   one subject as C3D: for each class of artifacts a recording that has one, named after the class

Equal seeds give equal files.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from markermend.core.recording import Recording
from markermend.formats.c3d.writer import Content, write_new
from markermend.simulation.contamination import Contamination
from markermend.simulation.marker_geometry import MarkerGeometry
from markermend.simulation.session import NOISE_MM, STATIC_S, contaminate
from markermend.simulation.walker import MeasurementErrors, make_body, walk
from markermend.simulation.walker_body import Body
from markermend.storage import atomic

DAYS = ("2024-05-03", "2024-06-12")
"""Folders of the days of the archive."""

PROP = ("Sword:Grip", "Sword:Guard", "Sword:Edge", "Sword:Tip")
"""Markers of the sword."""

HIDDEN, HIDDEN_FROM = {"LSHO": 3.0, "RWRA": 0.8, "RWRB": 0.8, "T10": 1.5}, 120
"""How long markers of the performer are hidden in each take, s, and from which frame on."""

PROP_PLACES = ((60.0, 0.0, 0.0), (140.0, 70.0, 0.0), (500.0, 20.0, 30.0), (840.0, 0.0, 0.0))
"""Where they are, mm: away from the hand, across the palm, and out of it."""


@dataclass(frozen=True)
class Plan:
    """What a data set is made with.

    Attributes
    ----------
    folder : Path
        Where the files go.
    seed : int
        Of all randomness.
    duration : float
        Of a recording that moves, s.
    """

    folder: Path
    seed: int
    duration: float

    def rng(self, *numbers: int) -> np.random.Generator:
        """Give the randomness of a part of the data set.

        Parameters
        ----------
        *numbers : int
            Of the part.

        Returns
        -------
        Generator
            The source of randomness.
        """
        return np.random.default_rng([self.seed, *numbers])


def record(
    body: Body, activities: Sequence[str], rng: np.random.Generator, *, duration: float, rate: float
) -> Recording:
    """Record a body without artifacts."""
    errors = MeasurementErrors(noise=NOISE_MM, soft_tissue=1.0)
    return walk(body=body, duration=duration, rate=rate, activities=activities, errors=errors, rng=rng).recording


def as_raw(clean: Recording, rng: np.random.Generator, *, share: float = 0.5) -> Recording:
    """A copy with gaps and artifacts; a share of 1 gives as many as are common in raw data."""
    margin = round(0.2 * clean.rate)
    copy = Contamination(clean.positions, clean.markers, margin=margin, one_at_a_time=False, rng=rng)
    contaminate(copy, rate=clean.rate, share=share * clean.frames / clean.rate / 15)
    return replace(clean, positions=copy.positions)


def write_c3d(path: Path, recording: Recording, subject: str) -> None:
    """Write a recording as C3D."""
    content = Content(
        labels=recording.markers,
        positions=recording.positions,
        rate=recording.rate,
        first_frame=recording.first_frame,
        groups={"SUBJECTS": {"USED": 1, "NAMES": [subject]}},
    )
    write_new(path, content)


def gait(plan: Plan) -> None:
    """One subject: a static trial and four walks."""
    body = make_body(rng=plan.rng(1))
    write_c3d(
        plan.folder / "S01/static.c3d", record(body, ["stand"], plan.rng(1, 0), duration=STATIC_S, rate=100.0), "S01"
    )
    for number in range(1, 5):
        rng = plan.rng(1, number)
        clean = replace(record(body, ["walk"], rng, duration=plan.duration, rate=100.0), first_frame=101)
        write_c3d(plan.folder / f"S01/walk{number}.c3d", as_raw(clean, rng), "S01")


def archive(plan: Plan) -> None:
    """Three subjects on two days: a calibration trial and two trials each; one file was cut off."""
    for number in range(1, 4):
        body, subject = make_body(rng=plan.rng(3, number)), f"P{number:03d}"
        for day, name in enumerate(DAYS):
            folder = plan.folder / subject / name
            still = record(body, ["stand"], plan.rng(3, number, day), duration=STATIC_S, rate=100.0)
            write_c3d(folder / "cal1.c3d", still, subject)
            for trial, activity in enumerate(("walk", "reach"), start=1):
                rng = plan.rng(3, number, day, trial)
                clean = record(body, [activity], rng, duration=plan.duration, rate=100.0)
                write_c3d(folder / f"{activity}.c3d", clean if number == 2 else as_raw(clean, rng), subject)
    cut = plan.folder / "P003" / DAYS[1] / "reach.c3d"
    cut.write_bytes(cut.read_bytes()[:600])


def studio(plan: Plan) -> None:
    """Two takes of a performer with a sword."""
    body = make_body(rng=plan.rng(2))
    for number, activities in enumerate((["walk", "reach"], ["reach", "exercise"]), start=1):
        rng = plan.rng(2, number)
        clean = record(body, activities, rng, duration=plan.duration, rate=120.0)
        seen = as_raw(clean, rng).positions
        for name, seconds in HIDDEN.items():
            seen[HIDDEN_FROM : HIDDEN_FROM + round(seconds * clean.rate), clean.markers.index(name)] = np.nan
        sword = carried(clean) + rng.normal(0.0, NOISE_MM, (len(seen), len(PROP), 3))
        sword[HIDDEN_FROM + 30 : HIDDEN_FROM + 90, PROP.index("Sword:Edge")] = np.nan
        names = [f"Ada:{name}" for name in clean.markers] + list(PROP)
        text = motive_csv(f"Take {number}", names, np.concatenate([seen, sword], axis=1), clean.rate)
        atomic.write_text(plan.folder / f"Ada/Take_{number:03d}.csv", text)


def carried(recording: Recording) -> np.ndarray:
    """Positions of the sword in the right hand, mm: it lies in the frame of three markers of the hand."""
    finger, index, little = (
        recording.positions[:, recording.markers.index(f"R{name}")] for name in ("FIN", "IDX", "PKY")
    )
    along = finger - recording.positions[:, recording.markers.index("RWRA")]
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    across = index - little
    across -= (across * along).sum(axis=1, keepdims=True) * along
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    axes = np.stack([along, across, np.cross(along, across)], axis=1)
    return np.asarray(finger[:, None] + np.array(PROP_PLACES) @ axes)


def motive_csv(name: str, markers: Sequence[str], positions: np.ndarray, rate: float) -> str:
    """Write a take as Motive does: metres, y up, blank where a marker is missing."""
    turned = np.stack([positions[..., 0], positions[..., 2], -positions[..., 1]], axis=-1) / 1000.0
    columns = 3 * len(markers)
    head = [
        f"Format Version,1.23,Take Name,{name},Export Frame Rate,{rate:.6f},Total Exported Frames,{len(positions)},"
        "Rotation Type,Quaternion,Length Units,Meters,Coordinate Space,Global",
        "",
        ",Type" + ",Marker" * columns,
        ",Name" + "".join(f",{marker}" * 3 for marker in markers),
        ",ID" + "".join(f",{number:04X}" * 3 for number in range(len(markers))),
        "," + ",Position" * columns,
        "Frame,Time" + ",X,Y,Z" * len(markers),
    ]
    rows = [
        f"{frame},{frame / rate:.6f}," + ",".join("" if np.isnan(value) else f"{value:.6f}" for value in row)
        for frame, row in enumerate(turned.reshape(len(turned), columns).tolist())
    ]
    return "\n".join([*head, *rows]) + "\n"


def classes(plan: Plan) -> None:
    """One subject: a recording for each class, which has one artifact of it."""
    body = make_body(rng=plan.rng(4))
    for number, (name, spoil) in enumerate(SPOILED.items()):
        rng = plan.rng(4, number)
        clean = record(body, ["walk", "reach"], rng, duration=plan.duration, rate=100.0)
        write_c3d(plan.folder / f"K01/{name}.c3d", spoil(Spoiled(clean, rng)), "K01")


@dataclass(frozen=True)
class Spoiled:
    """A recording that is about to get one artifact in its middle.

    Attributes
    ----------
    clean : Recording
        The recording.
    rng : Generator
        Source of randomness.
    """

    clean: Recording
    rng: np.random.Generator

    def add(
        self, names: Sequence[str], seconds: float | None, change: np.ndarray | Callable[[int], np.ndarray]
    ) -> Recording:
        """Add a displacement to markers, all if none is named, for a time or to the end."""
        start, stop = self.stretch(seconds)
        positions = self.clean.positions.copy()
        given = change(stop - start)[:, None] if callable(change) else change
        positions[start:stop, self.rows(names)] += given
        return replace(self.clean, positions=positions)

    def put(
        self, names: Sequence[str], seconds: float, samples: Callable[[np.ndarray, int, int], np.ndarray]
    ) -> Recording:
        """Replace a stretch of markers by what is made of the positions and its first and last row."""
        start, stop = self.stretch(seconds)
        positions = self.clean.positions.copy()
        positions[start:stop, self.rows(names)] = samples(positions[:, self.rows(names)], start, stop)
        return replace(self.clean, positions=positions)

    def relocate(self, name: str, seconds: float, size: Sequence[float]) -> Recording:
        """Move a marker for good to another place on its segment, within a time."""
        start, stop = self.stretch(None)
        m, positions = self.clean.markers.index(name), self.clean.positions.copy()
        rise = np.minimum((np.arange(stop - start) + 1) / max(1, round(seconds * self.clean.rate)), 1)
        geometry = MarkerGeometry(self.clean.positions, self.clean.markers)
        positions[start:stop, m] += geometry.turned(rise[:, None] * np.array(size), m, start)
        return replace(self.clean, positions=positions)

    def label_on(self, name: str, seconds: float, distance: Sequence[float]) -> Recording:
        """Put a label on a still reflection between two gaps."""
        start, stop = self.stretch(seconds)
        m, positions = self.clean.markers.index(name), self.clean.positions.copy()
        positions[start:stop, m] = (
            positions[start, m] + np.array(distance) + self.rng.normal(0.0, NOISE_MM, (stop - start, 3))
        )
        positions[start - 8 : start, m] = positions[stop : stop + 8, m] = np.nan
        return replace(self.clean, positions=positions)

    def stretch(self, seconds: float | None) -> tuple[int, int]:
        """Rows in the middle; without a duration, from there to the end."""
        start = self.clean.frames // 2
        return start, self.clean.frames if seconds is None else start + max(1, round(seconds * self.clean.rate))

    def rows(self, names: Sequence[str]) -> list[int]:
        """Indices of markers; of all if none is named."""
        return [self.clean.markers.index(name) for name in names or self.clean.markers]


def ramp(length: int, size: Sequence[float]) -> np.ndarray:
    """A displacement that grows to its size."""
    return np.asarray(np.linspace(1 / length, 1.0, length)[:, None] * np.array(size))


def triangle(length: int, size: Sequence[float]) -> np.ndarray:
    """A displacement that grows to its size and returns."""
    return np.asarray((1 - np.abs(np.linspace(-1, 1, length)))[:, None] * np.array(size))


def hidden(recording: Recording, marker: str, first: int, count: int) -> Recording:
    """Take samples of a marker away, counted from the middle of the recording."""
    positions, start = recording.positions.copy(), recording.frames // 2 + first
    positions[start : start + count, recording.markers.index(marker)] = np.nan
    return replace(recording, positions=positions)


def under_another_name(spoiled: Spoiled, marker: str) -> Recording:
    """Let a stretch of a marker lie under the unlabelled trajectory *12."""
    start, stop = spoiled.stretch(0.8)
    m, positions = spoiled.clean.markers.index(marker), spoiled.clean.positions.copy()
    other = np.full((len(positions), 1, 3), np.nan)
    other[start:stop, 0], positions[start - 2 : stop + 2, m] = positions[start:stop, m], np.nan
    both = np.concatenate([positions, other], axis=1)
    return replace(spoiled.clean, markers=(*spoiled.clean.markers, "*12"), positions=both)


SPOILED: Mapping[str, Callable[[Spoiled], Recording]] = {
    "swap": lambda to: to.put(["LFIN", "LWRA"], 0.6, lambda p, start, stop: p[start:stop, ::-1]),
    "foreign": lambda to: to.label_on("RFIN", 0.9, (300.0, 250.0, -200.0)),
    "unlabelled": lambda to: under_another_name(to, "LTHAP"),
    "repeat": lambda to: to.put([], 0.1, lambda p, start, stop: p[start - 1 : start]),
    "jump": lambda to: to.add([], 0.3, np.array([18.0, -12.0, 9.0])),
    "shift": lambda to: to.add([], None, np.array([15.0, -10.0, 6.0])),
    "slip": lambda to: to.add(["LFHD", "RFHD", "LBHD", "RBHD"], 0.04, np.array([4.0, 20.0, -6.0])),
    "frozen": lambda to: to.put(["C7"], 0.25, lambda p, start, stop: p[start - 1 : start]),
    "tail": lambda to: hidden(to.add(["RSHO"], 0.04, lambda n: ramp(n, (30.0, -24.0, 18.0))), "RSHO", 4, 25),
    "peak": lambda to: to.add(["LASI"], 0.03, lambda n: triangle(n + 2, (20.0, 25.0, -10.0))[1:-1]),
    "noise": lambda to: to.add(["C7"], 0.5, lambda n: to.rng.normal(0.0, 6.0, (n, 3))),
    "step": lambda to: to.add(["STRN"], 0.6, np.array([16.0, -12.0, 8.0])),
    "displaced": lambda to: to.relocate("LBHD", 0.0, (22.0, -16.0, 10.0)),
    "slow": lambda to: to.add(["T10"], 0.8, lambda n: triangle(n, (14.0, 12.0, -8.0))),
    "creep": lambda to: to.relocate("LASI", 2.0, (14.0, -10.0, 8.0)),
    "gap": lambda to: hidden(to.clean, "LKNE", 0, 60),
}
"""What makes a recording with one artifact, by the name of its class."""

DATA_SETS: Mapping[str, tuple[Callable[[Plan], None], float]] = {
    "gait": (gait, 8.0),
    "studio": (studio, 20.0),
    "archive": (archive, 5.0),
    "classes": (classes, 12.0),
}
"""What writes a data set, and how long its recordings last, s."""


def main(argv: Sequence[str] | None = None) -> None:
    """Write a data set as the command line says."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data_set", choices=DATA_SETS)
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="where the recordings go")
    parser.add_argument("--seed", type=int, default=1, help="equal seeds give equal files (default: 1)")
    parser.add_argument("--duration-s", type=float, help="length of a recording that moves, s")
    flags = parser.parse_args(argv)
    write, usual = DATA_SETS[flags.data_set]
    write(Plan(flags.folder, flags.seed, flags.duration_s or usual))


if __name__ == "__main__":
    main()
