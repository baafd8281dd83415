"""The data set of the fault test: three short recordings of two subjects, two as C3D and one as CSV, with gaps and artifacts.

Writes: FOLDER/S01/walk.c3d, FOLDER/S01/turn.c3d, FOLDER/S02/reach.csv.
"""

from pathlib import Path

import numpy as np

from markermend.formats.c3d.writer import Content, write_new

MARKERS = tuple(f"M{number}" for number in range(6))
RATE, FRAMES = 100.0, 160
NAMES = ("S01/walk.c3d", "S01/turn.c3d", "S02/reach.csv")


def write_data_set(folder: Path) -> None:
    """Write the recordings."""
    for seed, name in enumerate(NAMES):
        write_original(folder / name, seed=seed)


def write_original(path: Path, *, seed: int) -> None:
    """Write a recording in the format of its suffix; equal seeds give equal bytes."""
    path.parent.mkdir(parents=True, exist_ok=True)
    positions = np.round(contaminated(seed), 3)
    if path.suffix == ".c3d":
        write_new(path, Content(labels=MARKERS, positions=positions, rate=RATE))
    else:
        path.write_text("\n".join(_csv(positions)) + "\n", encoding="utf-8")


def contaminated(seed: int) -> np.ndarray:
    """A rigid cluster that turns and wanders, (frames, markers, 3) in mm, with a gap and an artifact of most classes."""
    rng = np.random.default_rng(seed)
    time = np.arange(FRAMES) / RATE
    angle = 1.5 * np.sin(2 * time + seed)
    turn = np.moveaxis(np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]), 2, 0)
    # Subjects share a cluster: the recordings of one are filled from each other.
    cluster = np.random.default_rng(99).uniform(-200, 200, (len(MARKERS), 3))
    positions = np.repeat(cluster[None], FRAMES, axis=0)
    positions[..., :2] = np.einsum("fij,mj->fmi", turn, cluster[:, :2])
    positions += 300 * np.stack([np.sin(time), np.cos(1.3 * time), 0.2 * np.sin(3 * time)], axis=1)[:, None]
    positions += rng.normal((0, 0, 1000), 0.1, positions.shape)
    positions[20, 2] += 60  # a peak
    positions[30:50, 3] += rng.normal(0, 15, (20, 3))  # noise
    positions[60:75, 4, 0] += 40  # a step
    positions[85:100, 0] = positions[85, 0]  # a frozen marker
    positions[105:120, [1, 2]] = positions[105:120, [2, 1]]  # exchanged labels
    positions[125:137, 1] = np.nan  # a gap
    return positions


def _csv(positions: np.ndarray) -> list[str]:
    """The lines of a table with a row per frame, NaN blank."""
    cells = positions.reshape(FRAMES, -1).tolist()
    header = ",".join(["frame", "time", *(f"{marker}_{axis} (mm)" for marker in MARKERS for axis in "xyz")])
    rows = [["" if np.isnan(value) else f"{value:.3f}" for value in row] for row in cells]
    return [header, *(",".join([str(f + 1), f"{f / RATE:.4f}", *row]) for f, row in enumerate(rows))]
