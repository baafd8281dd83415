"""Fill the gaps that are hard, on real clean recordings and large synthetic ones, and print the outcome.

Reads: clean/ in the data folder. Writes: a table to stdout.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.hard_cases --only blackout ends

Each row is one run of scripts/fill.py in a process of its own, with the default options and those that the row
names; seconds (of a core) and peak memory are those of the process, start and files included. The mesh is inferred from
the recording with its gaps. `inside` and `inside95` are the shares of the true positions within error and error95.
"""

from __future__ import annotations

import argparse
import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from benchmarks.support import gap_cases, result_tables
from benchmarks.support.defaults import DATA, OPTIONS
from benchmarks.support.fill_runs import fill, walker, with_gaps
from benchmarks.support.gap_cases import Gap
from markermend import api
from markermend.core.recording import Recording

Load = Callable[[str], Recording]
"""Reads a clean recording by its name."""


@dataclass(frozen=True)
class Case:
    """A row: a recording without gaps, its gaps (marker, start, stop), and the options that differ from the default."""

    title: str
    whole: Recording
    gaps: list[Gap]
    options: dict[str, Any] = field(default_factory=dict)


def spread(count: int, length: int, frames: int, *, first: int = 60) -> list[int]:
    """Starts of `count` stretches of a number of frames, evenly over a recording."""
    starts: list[int] = np.linspace(first, frames - length - first, count).astype(int).tolist()
    return starts


def at_once(markers: Iterable[int], start: int, length: int) -> list[Gap]:
    """A gap at the same place in each of the markers."""
    return [(int(marker), start, start + length) for marker in markers]


def concurrent(load: Load) -> Iterator[Case]:
    """Twenty markers miss the same second."""
    for name in ("85_02", "85_12", "HDM"):
        whole = load(name)
        chosen = np.random.default_rng(1).permutation(len(whole.markers))[:20]
        yield Case(f"20 at once, {name}", whole, at_once(chosen, whole.frames // 2, round(whole.rate)))


def segments(load: Load) -> Iterator[Case]:
    """Each segment of the mesh misses a second, one after the other: what hangs on it sees its border go, too."""
    for name in ("85_12", "STS1"):
        whole = load(name)
        found = api.infer_mesh([whole]).segments
        starts = spread(len(found), round(whole.rate), whole.frames)
        lost = [[whole.markers.index(marker) for marker in segment.markers] for segment in found]
        gone = [
            gap for each, start in zip(lost, starts, strict=True) for gap in at_once(each, start, round(whole.rate))
        ]
        yield Case(f"whole segments, {name}", whole, gone)


def neighbours(load: Load) -> Iterator[Case]:
    """A marker and its 15 nearest neighbours miss the same second, at five places."""
    whole = load("85_12")
    near = api.infer_mesh([whole]).neighbour_indices(whole.markers)
    for marker in (5, 20):
        lost = [marker, *near[marker][:15]]
        gone = [gap for start in spread(5, 120, whole.frames) for gap in at_once(lost, start, 120)]
        yield Case(f"{whole.markers[marker]} and 15 nearest", whole, gone)


def blackout(load: Load) -> Iterator[Case]:
    """All markers are lost."""
    whole = load("85_12")
    every = range(len(whole.markers))
    for seconds in (0.05, 0.1, 0.3, 1.0):
        gone = [
            gap
            for start in spread(4, round(seconds * whole.rate), whole.frames)
            for gap in at_once(every, start, round(seconds * whole.rate))
        ]
        yield Case(f"blackout {seconds} s", whole, gone)
        if seconds >= 0.3:
            names = [*OPTIONS["fill"].members, "kalman"]
            yield Case(f"blackout {seconds} s, kalman", whole, gone, {"members": names})


def rare(load: Load) -> Iterator[Case]:
    """A marker is seen for a quarter of the time."""
    whole = load("85_12")
    gone = [(9, start, start + 120) for start in range(40, whole.frames - 120, 160)]
    yield Case("seen 25 %", whole, gone)
    yield Case("seen 25 %, min_seen_share .2", whole, gone, {"min_seen_share": 0.2})


def everyone(load: Load) -> Iterator[Case]:
    """Every marker has gaps, at ever other times: not one is complete."""
    for name in ("85_12", "HDM"):
        whole = load(name)
        count, length = len(whole.markers), round(0.5 * whole.rate)
        gone = [
            (marker, start, start + length) for marker, start in enumerate(spread(count, length, whole.frames // 2))
        ]
        gone += [(m, start + whole.frames // 2, stop + whole.frames // 2) for m, start, stop in gone]
        yield Case(f"no complete marker, {name}", whole, gone)


def ends(load: Load) -> Iterator[Case]:
    """Markers come late or leave early."""
    whole = load("85_12")
    gone = [(m, 0, 60) for m in (3, 14, 30)] + [(m, whole.frames - 60, whole.frames) for m in (7, 20, 38)]
    yield Case("ends .5 s", whole, gone)
    yield Case("ends .5 s, fill_ends: true", whole, gone, {"fill_ends": True})
    late = [(m, 0, 300 + 2 * m) for m in range(len(whole.markers))]
    late += [(m, whole.frames - 300 - m, whole.frames) for m in range(len(whole.markers))]
    inner = [(m, start, start + 120) for m, start in zip((3, 9, 20, 33), spread(4, 120, 3000, first=800), strict=True)]
    yield Case("all enter and leave", whole, late + inner)


def subjects(load: Load) -> Iterator[Case]:
    """Two people and a prop in one recording; one of the people vanishes while the other has gaps."""
    first, second = load("85_12"), load("HDM")
    frames = second.frames
    prop = rigid(frames, 5, first.rate)
    whole = replace(
        first,
        markers=(*first.markers, *(f"second:{name}" for name in second.markers), *(f"prop{k}" for k in range(5))),
        positions=np.concatenate(
            [first.positions[:frames], second.positions + np.array([3000.0, 0.0, 0.0]), prop], axis=1
        ),
    )
    own = [(m, start, start + 120) for m, start in zip((3, 9, 20, 33), spread(4, 120, frames), strict=True)]
    gone = [(m, start - 120, stop + 120) for _, start, stop in own for m in range(41, 82)]
    alone = replace(first, positions=first.positions[:frames])
    yield Case("subject alone", alone, own)
    yield Case("subject while other is there", whole, own)
    yield Case("subject while other is gone", whole, own + gone)
    yield Case("prop", whole, [(82, 500, 600), (84, 550, 700), (85, 2000, 2200)])


def rigid(frames: int, markers: int, rate: float) -> np.ndarray:
    """A prop that tumbles: positions (frames, markers, 3)."""
    seconds = np.arange(frames)[:, None] / rate
    rng = np.random.default_rng(4)
    angle = seconds * [0.9] + np.sin(0.7 * seconds)
    places = rng.uniform(-80, 80, (markers, 2)) @ [1, 1j]
    plane = places * np.exp(1j * angle) + 1000 * np.sin(0.4 * seconds)
    height = np.broadcast_to(rng.uniform(500, 600, markers), plane.shape)
    return np.stack([plane.real, plane.imag, height], axis=-1) + rng.normal(0, 0.2, (frames, markers, 3))


def eight(load: Load) -> Iterator[Case]:
    """No more than eight markers: those of one arm."""
    whole = load("85_12")
    near = api.infer_mesh([whole]).neighbour_indices(whole.markers)[9][:7]
    few = replace(
        whole,
        markers=tuple(whole.markers[m] for m in (9, *near)),
        positions=whole.positions[:, [9, *near]],
    )
    gone = [(m, start, start + 120) for m, start in enumerate(spread(8, 120, whole.frames))]
    yield Case("8 markers", few, gone)
    yield Case("8 markers, 3 at once", few, at_once(range(3), 2000, 120))


def islands(load: Load) -> Iterator[Case]:
    """Gaps of a marker with one or two samples between."""
    whole = load("85_12")
    for between in (1, 2, 3):
        gone = [(9, start, start + 24) for start in range(2000, 2000 + 6 * (24 + between), 24 + between)]
        yield Case(f"{between} samples between", whole, gone)
        yield Case(f"{between} samples between, border_s 0", whole, gone, {"border_s": 0.0})


def extremes(load: Load) -> Iterator[Case]:
    """Next to nothing seen of a marker; next to no frames; nothing moves."""
    whole = load("85_12")
    lifted = {"min_seen_share": 0.0, "max_gap_s": None, "max_error_mm": None, "max_error95_mm": None}
    gone = [(9, 200, whole.frames - 200)]
    yield Case("gap of 91 %", whole, gone)
    yield Case("gap of 91 %, lifted", whole, gone, lifted)
    gone = [(9, 40, whole.frames - 10)]
    yield Case("gap of 99 %, lifted", whole, gone, lifted)
    brief = replace(whole, positions=whole.positions[:50])
    yield Case("50 frames", brief, [(9, 20, 30), (20, 25, 40)])
    brief = replace(whole, positions=whole.positions[:100])
    yield Case("100 frames", brief, [(9, 20, 30), (20, 45, 60)])
    still = np.broadcast_to(np.random.default_rng(1).uniform(0, 500, (4, 3)), (whole.frames, 4, 3))
    together = replace(
        whole,
        markers=(*whole.markers, *(f"still{k}" for k in range(4))),
        positions=np.concatenate([whole.positions, still], axis=1),
    )
    yield Case("frozen prop", together, [(41, 500, 620), (42, 2000, 2120), (43, 2060, 2200)])
    single = replace(together, markers=together.markers[:42], positions=together.positions[:, :42])
    yield Case("one frozen marker", single, [(41, 500, 620)])


def rates(load: Load) -> Iterator[Case]:
    """The same motion and the same gaps at other rates."""
    whole = load("85_12")
    path = CubicSpline(np.arange(whole.frames) / whole.rate, whole.positions)
    for rate in (50, 60, 100, 120, 200, 250, 500):
        frames = int((whole.frames - 1) / whole.rate * rate)
        resampled = replace(whole, rate=float(rate), positions=path(np.arange(frames) / rate))
        gone = [
            (m, start * rate, start * rate + rate) for m, start in zip(range(1, 41, 6), range(3, 36, 4), strict=False)
        ]
        yield Case(f"{rate} Hz", resampled, gone)


def metres(load: Load) -> Iterator[Case]:
    """A recording stored in metres."""
    whole = load("STS1")
    yield Case("in metres (STS1)", whole, [(m, 200 + 5 * m, 300 + 5 * m) for m in range(0, 50, 10)])


def large(load: Load) -> Iterator[Case]:
    """Many markers; many frames."""
    rng = np.random.default_rng(2)
    for frames, markers, count in ((5_000, 200, 60), (100_000, 60, 60)):
        gone = [
            (int(m), int(start), int(start + length))
            for m, start, length in zip(
                rng.integers(0, markers, count),
                rng.integers(200, frames - 400, count),
                rng.integers(20, 200, count),
                strict=True,
            )
        ]
        yield Case(f"{markers} markers, {frames} frames", walker(frames, markers), gone)


CASES = {
    case.__name__: case
    for case in (concurrent, segments, neighbours, blackout, rare, everyone, ends, subjects, eight, islands)
} | {case.__name__: case for case in (extremes, rates, metres, large)}


def row(case: Case) -> dict[str, Any]:
    """Fill, and describe the outcome under the columns of benchmarks/results/hard_cases.tsv."""
    gapped = with_gaps(case.whole, case.gaps)
    run = fill(gapped, **case.options)
    measured = ~gapped.missing
    assert np.array_equal(run.filled.positions[measured], gapped.positions[measured]), "a measured sample changed"
    filled = gapped.missing & ~run.filled.missing & ~case.whole.missing
    distance = np.linalg.norm((run.filled.positions - case.whole.positions)[filled], axis=1)
    inside, inside95 = (
        100 * np.mean(distance <= radius[filled]) if filled.any() else np.nan
        for radius in (run.filled.error, run.filled.error95)
    )
    left = [change.reason for change in run.changes if change.reason]
    fills = len(run.changes) - len(left)
    reasons = Counter(re.sub(r"\d+(\.\d+)?", "#", reason.text) for reason in left)
    why = "; ".join(f"{count} {reason}" for reason, count in reasons.most_common())
    error = distance.mean() if filled.any() else np.nan
    return {
        "case": case.title,
        "gaps": len(run.changes),
        "filled": fills,
        "error_mm": float(error),
        "within_error_percent": float(inside),
        "within_error95_percent": float(inside95),
        "seconds": run.seconds,
        "megabytes": run.megabytes,
        "left_open_because": why,
    }


def line(found: dict[str, Any]) -> str:
    """A row as a line of the printed table."""
    _, gaps, filled, error, inside, inside95, seconds, megabytes, why = found.values()
    return (
        f"{found['case']:34} {gaps:5} {filled:6} {gaps - filled:5} {error:8.2f} {inside:6.0f} {inside95:8.0f} "
        f"{seconds:7.1f} {megabytes:6.0f}  {why}"
    )


def main() -> None:
    """Parse the command line, run the cases, print a row for each."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", default=DATA, type=Path, help="folder that holds clean/")
    parser.add_argument("--only", nargs="+", choices=CASES, default=list(CASES), metavar="NAME", help=", ".join(CASES))
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    arguments = parser.parse_args()
    print(
        f"{'case':34} {'gaps':>5} {'filled':>6} {'left':>5} {'error mm':>8} {'inside':>6} {'inside95':>8} "
        f"{'seconds':>7} {'MB':>6}  why left"
    )
    rows = []
    for name in arguments.only:
        for case in CASES[name](lambda recording: gap_cases.load(str(arguments.data), recording)):
            rows.append(row(case))
            print(line(rows[-1]), flush=True)
    if arguments.tsv:
        result_tables.write(arguments.tsv, rows)


if __name__ == "__main__":
    main()
