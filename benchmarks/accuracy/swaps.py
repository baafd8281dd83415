"""Swap labels in clean recordings, find the swaps and undo them, and print how often that was exact.

Reads: the clean recordings named on the command line, the workflow's config.
Writes: tables to stdout: by kind of swap and distance of the markers, and for pairs by length, how many were found with
the right partners over the right frames, and undone bit for bit; and how many were found that are none, there and in the
recordings as they are.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.swaps ../shared/data/clean/*

Kinds: a pair; a pair that never swaps back; a pair of which the other marker is missing meanwhile; three markers in a
ring. Distances are medians over the recording, of a ring that of its first two.
"""

from __future__ import annotations

import argparse
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks.support import result_tables
from benchmarks.support.defaults import OPTIONS
from markermend import api
from markermend.core.labels import undo_exchanges
from markermend.detection.labels import find_labels
from markermend.prediction.scene import Scene

LENGTHS = (1, 2, 3, 5, 10, 50, 200)
BANDS = (60.0, 150.0, 400.0, np.inf)
"""Upper ends of the classes of distance, mm."""
KINDS = ("pair", "lasting", "missing", "ring")
MARGIN = 5
"""Frames without gaps on either side of a swap."""


def read(path: Path) -> tuple[tuple[str, ...], Scene]:
    """The markers and the scene of a recording, with its own mesh."""
    recording = api.read(path)
    mesh = api.infer_mesh([recording])
    return recording.markers, Scene.of(recording, mesh)


def swap(
    positions: np.ndarray, distance: np.ndarray, kind: str, length: int, within: float, rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray, list[int], int, int] | None:
    """Swapped positions, what they are without the swap, the markers in their order, and the frames; None without room."""
    frames = len(positions)
    pairs = np.argwhere(distance < within)
    if not len(pairs) or frames < 3 * length:
        return None
    ring = rng.permutation(pairs[rng.integers(len(pairs))]).tolist()
    start = int(rng.integers(MARGIN, frames - length - MARGIN))
    start, stop = (
        (int(rng.integers(2 * frames // 3, frames - MARGIN)), frames) if kind == "lasting" else (start, start + length)
    )
    if kind == "ring":
        near = np.argsort(np.nan_to_num(distance[ring[0]], nan=np.inf))
        ring.append(int(next(m for m in near if m not in ring)))
    if np.isnan(positions[start - MARGIN : stop + MARGIN, ring]).any():
        return None
    original, swapped = positions.copy(), positions.copy()
    swapped[start:stop, np.roll(ring, -1)] = positions[start:stop, ring]
    if kind == "missing":
        swapped[start:stop, ring[0]] = np.nan
        original[start:stop, ring[1]] = np.nan
    return swapped, original, ring, start, stop


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recordings", type=Path, nargs="+", help="clean recordings")
    parser.add_argument("--trials", type=int, default=12, help="swaps of each kind and length in each recording")
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=KINDS, help="kinds of swaps")
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    arguments = parser.parse_args()
    tried: Counter[tuple[str, int, int]] = Counter()
    right: Counter[tuple[str, int, int]] = Counter()
    false = in_clean = 0
    for path in arguments.recordings:
        markers, scene = read(path)
        in_clean += len(find_labels(scene, markers=markers, options=OPTIONS["labels"]).events)
        some = scene.positions[:: max(1, len(scene.positions) // 50)]
        distance = np.nanmedian(np.linalg.norm(some[:, :, None] - some[:, None], axis=3), axis=0)
        np.fill_diagonal(distance, np.nan)
        for kind in arguments.kinds:
            for length in LENGTHS if kind != "lasting" else LENGTHS[:1]:
                for trial in range(arguments.trials):
                    rng = np.random.default_rng([KINDS.index(kind), length, trial])
                    case = swap(scene.positions, distance, kind, length, BANDS[trial % len(BANDS)], rng)
                    if case is None:
                        continue
                    positions, original, ring, start, stop = case
                    found = find_labels(
                        replace(scene, positions=positions), markers=markers, options=OPTIONS["labels"]
                    ).events
                    onward = [*ring[1:], ring[0]]
                    truth = {(markers[m], start, stop, markers[n]) for m, n in zip(ring, onward, strict=True)}
                    stated = {(event.marker, event.start, event.stop, event.partner) for event in found}
                    key = kind, int(np.searchsorted(BANDS, distance[ring[0], ring[1]])), length
                    tried[key] += 1
                    same = np.array_equal(undo_exchanges(positions, found, markers), original, equal_nan=True)
                    right[key] += truth == stated and same
                    false += len(stated - truth)
    for kind in arguments.kinds:
        lengths = LENGTHS if kind != "lasting" else LENGTHS[:1]
        heads = [f"{length:>9}" for length in lengths] if kind != "lasting" else ["   to end"]
        print(f"{kind + ': mm, frames':>18}" + "".join(heads))
        for band, high in enumerate(BANDS):
            cells = [f"{right[kind, band, length]}/{tried[kind, band, length]}" for length in lengths]
            print(f"{'up to ' + format(high, 'g'):>18}" + "".join(f"{cell:>9}" for cell in cells))
    if arguments.tsv:
        result_tables.write(
            arguments.tsv,
            [
                {
                    "kind": kind,
                    "distance_below_mm": f"{high:g}",
                    "frames": "to end" if kind == "lasting" else length,
                    "undone": right[kind, band, length],
                    "tried": tried[kind, band, length],
                }
                for kind in arguments.kinds
                for band, high in enumerate(BANDS)
                for length in (LENGTHS if kind != "lasting" else LENGTHS[:1])
            ],
        )
    print(f"false events: {false} next to swaps, {in_clean} in the recordings as they are")


if __name__ == "__main__":
    main()
