"""Fill made gaps of a recording alone, and with what its subject's other recordings show, on the very same gaps.

Reads: two recordings of one subject in DATA/clean (85_02, 85_12), and the session DATA/sessions/expert1.
Writes: tables to stdout: mean distance to the truth alone and pooled, their ratio, true positions within the stated balls, %, and
the spread of errors relative to stated ones.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.pooling --tsv benchmarks/results/pooling.tsv

The gaps are hidden in the recording that is filled before anything is inferred from it; the pool shows other recordings only. Both
arms have the mesh of all recordings, unless `--own-mesh` gives the first arm that of its recording alone. Only the rules of what
may be filled are lifted.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import cache, partial
from itertools import product
from pathlib import Path
from typing import NamedTuple

import numpy as np

from benchmarks.support import result_tables
from benchmarks.support.defaults import DATA, OPTIONS
from benchmarks.support.fill_runs import restored, with_gaps
from benchmarks.support.gap_cases import LIFTED, Gap
from markermend import api
from markermend.core.changes import TreatedRecording
from markermend.core.mesh import Mesh
from markermend.core.poses import Poses
from markermend.core.recording import Recording
from markermend.filling.fill import fill_gaps

BORDER = 5
"""Frames before and after a gap, at least."""


class Subject(NamedTuple):
    """A folder with recordings of a subject, the start of their names, those that are filled, and the lengths of gaps, s."""

    folder: str
    start: str
    filled: tuple[str, ...]
    lengths_s: tuple[float, ...]


SUBJECTS = {
    "85": Subject("clean", "85", ("85_02", "85_12"), (0.5, 1.0, 2.0)),
    "expert1": Subject(
        "sessions/expert1",
        "",
        ("DJ2", "walking2", "walkingTI1", "walkingTS1", "DJ1", "DJAsym1", "walking1", "walking3", "walkingTO1"),
        (0.2, 0.5, 1.0),
    ),
}
"""The subjects; of expert1 the trials to choose options on come last."""

MARKERS = (1, 3, 10)
"""Markers that miss the same stretch."""


class Arm(NamedTuple):
    """The samples of a case after filling: distances to the truth, error and error95 (gaps, n), mm; and the seconds that it took."""

    distance: np.ndarray
    error: np.ndarray
    error95: np.ndarray
    seconds: float


class Case(NamedTuple):
    """A case: recording, length of its gaps, s, number of markers, and what was filled alone and pooled."""

    recording: str
    length_s: float
    markers: int
    alone: Arm
    pooled: Arm


@cache
def recordings(folder: str, subject: str) -> dict[str, Recording]:
    """The recordings of a subject by name; a static one is left out."""
    own = SUBJECTS[subject]
    paths = [path for path in sorted(Path(folder, own.folder).glob(f"{own.start}*")) if "static" not in path.name]
    return {path.stem: api.read(path, recording=path.stem, subject=subject, kind="dynamic") for path in paths}


@cache
def poses(folder: str, subject: str) -> Poses:
    """The poses of a subject. Each recording sees those of the others only."""
    own = recordings(folder, subject)
    mesh = api.infer_mesh(list(own.values()))
    return api.sample_poses([TreatedRecording(restored(each), ()) for each in own.values()], mesh)


def made_gaps(recording: Recording, length_s: float, markers: int, seed: int) -> list[Gap] | None:
    """Gaps of markers over one stretch, all at random; None where the recording is too short."""
    length = round(length_s * recording.rate)
    if recording.frames < length + 2 * BORDER:
        return None
    rng = np.random.default_rng([seed, round(1000 * length_s), markers, recording.frames])
    start = int(rng.integers(BORDER, recording.frames - length - BORDER + 1))
    complete = np.flatnonzero(~recording.missing.any(axis=0))
    return [(int(marker), start, start + length) for marker in rng.choice(complete, markers, replace=False)]


def fill(whole: Recording, gaps: Sequence[Gap], mesh: Mesh, shown: Poses | None) -> Arm:
    """Fill the gaps of a recording."""
    options = replace(OPTIONS["fill"], **LIFTED)
    started = time.process_time()
    filled = fill_gaps(restored(with_gaps(whole, gaps)), mesh, options=options, poses=shown).recording
    seconds = time.process_time() - started
    places = [(slice(start, stop), marker) for marker, start, stop in gaps]
    distance = [np.linalg.norm(filled.positions[place] - whole.positions[place], axis=1) for place in places]
    errors, errors95 = ([field[place] for place in places] for field in (filled.error, filled.error95))
    return Arm(np.array(distance), np.array(errors), np.array(errors95), seconds)


def run(folder: str, job: tuple[str, str, float, int, int], *, own_mesh: bool) -> Case | None:
    """Fill one case alone and pooled; job: subject, recording, length of the gaps, s, markers and seed."""
    subject, name, length_s, markers, seed = job
    own = recordings(folder, subject)
    gaps = made_gaps(own[name], length_s, markers, seed)
    if gaps is None:
        return None
    gapped = with_gaps(own[name], gaps)
    mesh = api.infer_mesh([gapped if other == name else recording for other, recording in own.items()])
    alone = fill(own[name], gaps, api.infer_mesh([gapped]) if own_mesh else mesh, None)
    return Case(name, length_s, markers, alone, fill(own[name], gaps, mesh, poses(folder, subject)))


def jobs(subjects: Sequence[str], seeds: Sequence[int]) -> Iterator[tuple[str, str, float, int, int]]:
    """The cases of the subjects."""
    for subject in subjects:
        own = SUBJECTS[subject]
        for name, length_s, markers, seed in product(own.filled, own.lengths_s, MARKERS, range(*seeds)):
            yield subject, name, length_s, markers, seed


def row(cases: Sequence[Case]) -> dict[str, object]:
    """What several cases show together: mean errors, mm, and their ratio where both arms fill all gaps, and what each arm shows."""
    both = [case for case in cases if np.isfinite([case.alone.distance, case.pooled.distance]).all()]
    alone, pooled = (_mean([getattr(case, name).distance.mean() for case in both]) for name in ("alone", "pooled"))
    found: dict[str, object] = {"cases": len(cases), "gaps": sum(case.markers for case in cases)}
    found |= {"alone_mm": alone, "pooled_mm": pooled, "ratio": pooled / alone}
    for name in ("alone", "pooled"):
        found |= {f"{key}_{name}": value for key, value in summary([getattr(case, name) for case in cases]).items()}
    return found


def summary(arms: Sequence[Arm]) -> dict[str, object]:
    """Number of gaps that stay open; and of the cases without: mean error, mm, true positions within the balls, %, and spread of the
    logarithm of the ratio of true to stated errors over the gaps; and seconds for each case."""
    filled = [arm for arm in arms if np.isfinite(arm.distance).all()]
    logs = [np.log((arm.distance**2).mean(axis=1) / (arm.error**2).mean(axis=1)) / 2 for arm in filled]
    return {
        "unfilled": sum(int(np.isnan(arm.distance).any(axis=1).sum()) for arm in arms),
        "filled_mm": _mean([arm.distance.mean() for arm in filled]),
        "inside68": 100 * _mean([arm.distance <= arm.error for arm in filled]),
        "inside95": 100 * _mean([arm.distance <= arm.error95 for arm in filled]),
        "spread": float(np.concatenate(logs).std()) if logs else np.nan,
        "seconds": _mean([arm.seconds for arm in arms]),
    }


def _mean(parts: Sequence[np.ndarray] | Sequence[float]) -> float:
    """Mean over all values; NaN where there are none."""
    return float(np.concatenate([np.ravel(part) for part in parts]).mean()) if parts else np.nan


GROUPS: dict[str, Callable[[Case], tuple[object, ...]]] = {
    "recording": lambda case: (case.recording, "all", "all"),
    "length": lambda case: (case.recording, case.length_s, "all"),
    "markers": lambda case: (case.recording, "all", case.markers),
    "cell": lambda case: (case.recording, case.length_s, case.markers),
}
"""What rows are about: recording, length of the gaps, s, and number of markers."""


def rows(cases: Sequence[Case]) -> list[dict[str, object]]:
    """A row for each recording, for each length, for each number of markers, and for each length and number of markers."""
    found = []
    for key in GROUPS.values():
        for group in sorted({key(case) for case in cases}, key=str):
            about = dict(zip(("recording", "length_s", "markers"), group, strict=True))
            found.append(about | row([case for case in cases if key(case) == group]))
    return found


def main() -> None:
    """Parse the command line, fill, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", default=DATA, type=Path, help="folder that holds clean/ and sessions/")
    parser.add_argument("--subjects", nargs="+", default=list(SUBJECTS), choices=list(SUBJECTS))
    parser.add_argument("--recordings", nargs="+", help="only these are filled")
    parser.add_argument("--seeds", nargs=2, type=int, default=(10, 17), help="of the gaps: from, up to")
    parser.add_argument(
        "--own-mesh", action="store_true", help="compare with filling alone with the recording's own mesh"
    )
    parser.add_argument("--jobs", type=int, default=1, help="processes, of one thread each")
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    arguments = parser.parse_args()
    wanted = [job for job in jobs(arguments.subjects, arguments.seeds) if job[1] in (arguments.recordings or [job[1]])]
    with ProcessPoolExecutor(arguments.jobs) as pool:
        done = list(pool.map(partial(run, str(arguments.data), own_mesh=arguments.own_mesh), wanted))
    table = rows([case for case in done if case is not None])
    for line in table:
        cells = [f"{value:.3g}" if isinstance(value, float) else str(value) for value in line.values()]
        print("  ".join(f"{cell:>{len(name)}}" for name, cell in zip(line, cells, strict=True)))
    print("  ".join(table[0]))
    if arguments.tsv:
        result_tables.write(arguments.tsv, table)


if __name__ == "__main__":
    main()
