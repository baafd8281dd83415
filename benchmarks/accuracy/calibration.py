"""Whether expected errors are true: fill random gaps of all clean recordings, count truths within the stated balls.

Reads: the recordings in DATA/clean.
Writes: a table to stdout: per recording and gap length, and per number of gaps, the share of samples within `error` and
`error95`; the spread of the logarithm of error / stated error, and the mean error.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.calibration --runs 8 --jobs 2

In each run some markers, chosen at random, miss the same stretch at a random place; with `--unusual`, a marker and its nearest neighbours
miss a stretch in which it moves as it seldom does, such as the step of a foot that stands nearly always. The stated shares are 68 and 95 %.
Samples of one gap go together, so a cell holds little more information than it has runs: the standard error is printed next to it,
from the spread between runs.
"""

from __future__ import annotations

import argparse
from collections import defaultdict
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import cache, partial
from pathlib import Path
from typing import NamedTuple

import numpy as np

from benchmarks.support import result_tables
from benchmarks.support.defaults import DATA, OPTIONS
from benchmarks.support.gap_cases import Changes, error_spread, fill_gapped, load, read_changes
from benchmarks.support.made_gaps import random_gaps, unusual_gaps
from markermend import api

OneRun = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Distances from the truth, error and error95 (samples, markers), mm."""

LENGTHS_S = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0)
MOST_SHARE = 0.5
"""Gaps longer than this share of a recording are not tried: too little would be left to learn from."""


@cache
def neighbours(folder: str, name: str) -> list[np.ndarray]:
    """The neighbours from which each marker is predicted, by the complete recording."""
    whole = load(folder, name)
    return api.infer_mesh([whole]).neighbour_indices(whole.markers)


class Plan(NamedTuple):
    """What one run hides: so many markers for so long, where they move unusually or anywhere; changed options of the ensemble."""

    name: str
    length_s: float
    markers: int
    seed: tuple[int, int]
    unusual: bool
    changes: Changes


def one_run(folder: str, plan: Plan) -> OneRun | None:
    """Hide a stretch of some markers and fill it; returns distances, error and error95 (samples, markers), mm, or None."""
    whole, near = load(folder, plan.name), neighbours(folder, plan.name)
    length = round(plan.length_s * whole.rate)
    if length > MOST_SHARE * whole.frames or 2 * plan.markers > len(whole.markers):
        return None
    rng = np.random.default_rng([*plan.seed, length, plan.markers])
    unusual = unusual_gaps(whole, near, length, plan.markers, rng) if plan.unusual else []
    gaps = unusual or random_gaps(whole, length, plan.markers, rng)
    if not gaps:
        return None
    filled = fill_gapped(whole, gaps, near, OPTIONS["fill"].members, plan.changes)
    place = slice(*gaps[0][1:]), [marker for marker, _, _ in gaps]
    distance = np.linalg.norm(filled.positions[place] - whole.positions[place], axis=2)
    return distance, filled.error[place], filled.error95[place]


def cell(runs: Sequence[OneRun]) -> str:
    """Shares within both balls, %, and their standard errors, from what the runs found."""
    shares = inside(runs)
    error, error95 = shares.mean(axis=0)
    spread = shares.std(axis=0, ddof=1) / np.sqrt(len(shares)) if len(shares) > 1 else (np.nan, np.nan)
    return f"{error:3.0f} ({spread[0]:2.0f}) {error95:3.0f} ({spread[1]:2.0f})"


def inside(runs: Sequence[OneRun]) -> np.ndarray:
    """Shares of the true positions within both balls (runs, 2), %."""
    return 100 * np.array([[(d <= e).mean(), (d <= e95).mean()] for d, e, e95 in runs])


def main() -> None:
    """Parse the command line, fill, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", default=DATA, type=Path, help="folder that holds clean/")
    parser.add_argument("--recordings", nargs="+", help="only these, such as Qualisys")
    parser.add_argument("--lengths", nargs="+", type=float, default=LENGTHS_S, help="of the gaps, s")
    parser.add_argument("--markers", nargs="+", type=int, default=[1, 3], help="that miss the stretch at once")
    parser.add_argument("--runs", type=int, default=4, help="per recording, length and number of markers")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--unusual", action="store_true", help="hide stretches in which markers move as they seldom do")
    parser.add_argument(
        "--set", nargs="+", default=[], metavar="KEY=VALUE", help="other options of advanced.fill.ensemble"
    )
    parser.add_argument("--jobs", type=int, default=1, help="processes, of one thread each")
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    arguments = parser.parse_args()
    clean = sorted(path.stem for path in (arguments.data / "clean").iterdir() if path.suffix in (".c3d", ".trc"))
    names = arguments.recordings or clean
    plan = [
        Plan(name, length, markers, (arguments.seed, run), arguments.unusual, read_changes(arguments.set))
        for name in names
        for length in arguments.lengths
        for markers in arguments.markers
        for run in range(arguments.runs)
    ]
    found: dict[tuple[str, float | str], list[OneRun]] = defaultdict(list)
    with ProcessPoolExecutor(arguments.jobs) as pool:
        for run, outcome in zip(plan, pool.map(partial(one_run, str(arguments.data)), plan), strict=True):
            if outcome is not None:
                for group in (run.name, f"{run.markers} gaps", "all"):
                    found[group, run.length_s].append(outcome)
                    found[group, "all"].append(outcome)
    print("% within error (standard error), within error95 (standard error); every run weighs the same")
    headings = [*arguments.lengths, "all"]
    print(f"{'recording':26}" + "".join(f"{f'{each} s' if each != 'all' else each:>18}" for each in headings))
    groups = [*names, *(f"{markers} gaps" for markers in arguments.markers), "all"]
    for name in groups:
        row = [cell(found[name, each]) if found[name, each] else "-" for each in headings]
        print(f"{name:26}" + "".join(f"{each:>18}" for each in row))
    if arguments.tsv:
        rows = [
            {"recording": name, "gap_s": each, "within_error_percent": shares[0], "within_error95_percent": shares[1]}
            for name in groups
            for each in headings
            if found[name, each]
            for shares in [inside(found[name, each]).mean(axis=0).tolist()]
        ]
        result_tables.write(arguments.tsv, rows)
    print(f"\nspread of errors{'':10}" + "".join(f"{spread(found['all', each]):18.2f}" for each in headings))
    print(f"mean error, mm{'':12}" + "".join(f"{mean_error(found['all', each]):18.2f}" for each in headings))


def spread(runs: Sequence[OneRun]) -> float:
    """Spread of the stated errors over all gaps, each marker by itself."""
    gaps = [(own[:, k], error[:, k]) for own, error, _ in runs for k in range(own.shape[1])]
    return error_spread([own for own, _ in gaps], [error for _, error in gaps])


def mean_error(runs: Sequence[OneRun]) -> float:
    """Mean distance over the samples of all runs, mm."""
    return float(np.concatenate([distance.ravel() for distance, _, _ in runs]).mean()) if runs else float("nan")


if __name__ == "__main__":
    main()
