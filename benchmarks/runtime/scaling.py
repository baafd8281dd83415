"""How the time and memory of the fill stage grow with frames, markers and gaps, on a synthetic person.

Writes: three tables to stdout; in each one number varies and the others are those of the base case.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.runtime.scaling

Each row is scripts/fill.py with the default options in a process of its own: seconds of a core and peak memory include
its start and its files. `x` is the ratio to the row above. A gap lasts 1 s, at a random place on a random marker.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from benchmarks.support import result_tables
from benchmarks.support.fill_runs import Run, fill, walker, with_gaps
from markermend.core.changes import Outcome

BASE = {"frames": 4_000, "markers": 41, "gaps": 10}
VARIED = {"frames": (1_000, 4_000, 16_000, 64_000), "markers": (20, 41, 80, 160), "gaps": (3, 10, 30, 100)}
RATE = 100


def run(frames: int, markers: int, gaps: int) -> tuple[Run, int]:
    """Fill a number of gaps; returns the run and the number of gaps that were filled."""
    rng = np.random.default_rng(7)
    starts = rng.integers(RATE, frames - 2 * RATE, gaps).tolist()
    places = [
        (int(marker), start, start + RATE) for marker, start in zip(rng.integers(0, markers, gaps), starts, strict=True)
    ]
    done = fill(with_gaps(walker(frames, markers, RATE), places))
    return done, sum(change.outcome is Outcome.FILLED for change in done.changes)


def main() -> None:
    """Parse the command line, run, print a table for each number that varies."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--vary", nargs="+", choices=VARIED, default=list(VARIED))
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    arguments = parser.parse_args()
    rows: list[dict[str, object]] = []
    for varied in arguments.vary:
        others = ", ".join(f"{value} {name}" for name, value in BASE.items() if name != varied)
        print(f"\n{others}\n{varied:>8} {'filled':>7} {'seconds':>8} {'x':>5} {'MB':>6} {'x':>5}")
        before: tuple[float, float] | None = None
        for value in VARIED[varied]:
            done, filled = run(**{**BASE, varied: value})
            now = done.seconds, done.megabytes
            ratios = [f"{a / b:5.2f}" if before else f"{'':5}" for a, b in zip(now, before or now, strict=True)]
            print(f"{value:8} {filled:7} {now[0]:8.1f} {ratios[0]} {now[1]:6.0f} {ratios[1]}", flush=True)
            before = now
            rows.append(
                {"varied": varied, **BASE, varied: value, "filled": filled, "seconds": now[0], "megabytes": now[1]}
            )
    if arguments.tsv:
        result_tables.write(arguments.tsv, rows)


if __name__ == "__main__":
    main()
