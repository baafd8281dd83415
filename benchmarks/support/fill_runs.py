"""What the benchmarks of the fill stage share: recordings with gaps, and the stage run on them in a process of its own."""

from __future__ import annotations

import os
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np

from benchmarks.support.defaults import OPTIONS, PROJECT
from benchmarks.support.gap_cases import Gap
from markermend import api
from markermend.core.changes import Change
from markermend.core.recording import MEASURED, MISSING, Recording, Restored
from markermend.options.flags import write_flags
from markermend.simulation.walker import MeasurementErrors, walk
from markermend.simulation.walker_body import make_body
from markermend.storage import change_file, mesh_file, stage_files

WATCH = """
import resource, subprocess, sys
subprocess.run(sys.argv[1:], check=True)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(used.ru_utime + used.ru_stime, used.ru_maxrss / 1024)
"""
"""Runs a command, prints the seconds of a core that it took and its peak memory, MB.

A process starts with its parent's peak, so it needs a parent that is small.
"""

FILES = {
    "repaired": "06_repaired.parquet", "repairs": "06_changes.parquet", "mesh": "mesh.json",
    "filled": "07_filled.parquet", "changes": "07_changes.parquet",
}  # fmt: skip
"""The stage's files by their flags."""

TAKE_S = 60.0
"""Length of a take of the synthetic person, s."""


@dataclass(frozen=True)
class Run:
    """A recording after the fill stage with what was done to its gaps, and what the process took: seconds of a core, start
    included, and MB at most.
    """

    filled: Restored
    changes: tuple[Change, ...]
    seconds: float
    megabytes: float


def fill(recording: Recording, **options: Any) -> Run:
    """Infer the mesh of a recording with gaps and run scripts/fill.py on it, with some options changed."""
    recording = replace(recording, facts={"recording": "benchmark", "kind": "dynamic"})
    own = replace(OPTIONS["fill"], **options)
    with tempfile.TemporaryDirectory() as folder:
        files = {name: Path(folder, file) for name, file in FILES.items()}
        stage_files.write_recording(files["repaired"], restored(recording), {})
        change_file.write(files["repairs"], [], {})
        mesh_file.write(files["mesh"], [api.infer_mesh([recording])], {})
        flags = [f"--{name}={path}" for name, path in files.items()]
        seconds, megabytes = stage("fill", [*flags, "--decisions=[]", "--code=", "--poses"], own)
        filled = stage_files.read_recording(files["filled"])
        assert isinstance(filled, Restored)
        return Run(filled, change_file.read(files["changes"]), seconds, megabytes)


def stage(name: str, flags: Sequence[str | Path], options: Any) -> tuple[float, float]:
    """Run the script of a stage in a process of its own; gives seconds of a core, start included, and MB at most."""
    script: list[str | Path] = [
        sys.executable,
        PROJECT / f"scripts/{name}.py",
        *flags,
        *shlex.split(write_flags(options)),
    ]
    done = subprocess.run([sys.executable, "-c", WATCH, *script], capture_output=True, text=True, check=False)
    if done.returncode or "Warning" in done.stderr or "set aside" in done.stderr:
        raise RuntimeError(done.stderr[-2000:])
    seconds, megabytes = map(float, done.stdout.split())
    return seconds, megabytes


def restored(recording: Recording) -> Restored:
    """A recording as repair hands it on: nothing repaired."""
    missing = recording.missing
    error = np.where(missing, np.nan, 0.0)
    origin = np.where(missing, MISSING, MEASURED).astype(np.uint8)
    return Restored(**vars(recording), origin=origin, error=error, error95=error)


def with_gaps(recording: Recording, gaps: Iterable[Gap]) -> Recording:
    """The recording without the samples in the gaps (marker, start, stop)."""
    positions = recording.positions.copy()
    for marker, start, stop in gaps:
        positions[start:stop, marker] = np.nan
    return replace(recording, positions=positions)


@cache
def walker(frames: int, markers: int, rate: float = 100.0, seed: int = 1) -> Recording:
    """A synthetic person with any number of markers in changing activities: takes of a minute, joined while standing.

    Markers beyond the walker's 51 sit within some centimetres of these.
    """
    rng = np.random.default_rng(seed)
    body = make_body(rng=rng)
    on = np.resize(np.arange(len(body.markers)), markers)
    apart = np.where(np.arange(markers) < len(body.markers), 0.0, 30.0)[:, None]
    body = replace(
        body,
        markers=tuple(f"{body.markers[place]}{number}" for number, place in enumerate(on)),
        marker_segments=body.marker_segments[on],
        marker_offsets=body.marker_offsets[on] + apart * rng.normal(0.0, 1.0, (markers, 3)),
        tissue=body.tissue[on],
        compliance=body.compliance[on],
    )
    positions = np.empty((0, markers, 3))
    while len(positions) < frames:
        activities = ["stand", *rng.permutation(["walk", "reach", "sit", "exercise", "walk"]).tolist()]
        take = walk(
            body=body,
            duration=TAKE_S,
            rate=rate,
            activities=activities,
            errors=MeasurementErrors(noise=0.2, soft_tissue=1.0),
            rng=rng,
        )
        begin, end = [bout[1:] for bout in take.bouts if bout[0] == "stand"][-1]
        own = take.recording.positions[: round((begin + end) / 2 * rate)]
        positions = np.concatenate([positions, continued(own, positions[-1]) if len(positions) else own])
    positions = positions[:frames].copy()
    return Recording(body.markers, positions, rate)


def continued(positions: np.ndarray, last: np.ndarray) -> np.ndarray:
    """The positions (frames, markers, 3) turned about the vertical and moved so that they go on from `last` (markers, 3)."""
    plane, there = (points[..., 0] + 1j * points[..., 1] for points in (positions, last))
    middle = plane[0].mean()
    turn = np.vdot(plane[0] - middle, there - there.mean())
    plane = (plane - middle) * turn / abs(turn) + there.mean()
    return np.stack([plane.real, plane.imag, positions[..., 2]], axis=-1)
