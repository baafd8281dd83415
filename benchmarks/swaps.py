"""Swap labels in clean recordings, find the swaps and undo them, and print how often that was exact.

Reads: the clean recordings named on the command line, the workflow's config.
Writes: a table to stdout: by distance of the two markers and by length of the swap, how many were found with partner
and exact bounds, and undone bit for bit; and how many were found that are none, there and in the recordings as they are.

    PYTHONPATH=scripts .venv/bin/python benchmarks/swaps.py ../shared/data/clean/*
"""

import argparse
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import yaml

from markermend import mesh_inference, mesh_statistics
from markermend.contamination import Contamination
from markermend.damage import integers
from markermend.formats import files
from markermend.predictors import Scene
from markermend.swaps import SwapSettings, detect_swaps, undone

PROJECT = Path(__file__).resolve().parents[1]
LENGTHS = (1, 2, 3, 5, 10, 50, 200)
BANDS = (60.0, 150.0, 400.0, np.inf)
"""Upper ends of the distances that are told apart, mm."""


def read(path: Path, config: dict) -> tuple[tuple[str, ...], Scene]:
    """The markers and the scene of a recording, with its own mesh."""
    recording = files.read(path, unlabelled=config["ingest"]["unlabelled"], rate=None).recording
    recording = replace(recording, facts={"recording": path.stem})
    settings = {key: value for key, value in config["mesh"].items() if key not in ("files", "marker_overlap")}
    mesh = mesh_inference.infer_mesh([mesh_statistics.thin(recording, frames=settings["frames"])], **settings)
    return recording.markers, Scene(recording.positions, recording.rate, mesh.neighbour_indices(recording.markers))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recordings", type=Path, nargs="+", help="clean recordings")
    parser.add_argument("--trials", type=int, default=30, help="swaps of each length in each recording")
    arguments = parser.parse_args()
    config = yaml.safe_load((PROJECT / "config/config.yaml").read_text(encoding="utf-8"))
    settings = SwapSettings(**config["swaps"])
    tried: Counter[tuple[int, int]] = Counter()
    right: Counter[tuple[int, int]] = Counter()
    false = in_clean = 0
    for path in arguments.recordings:
        markers, scene = read(path, config)
        in_clean += len(detect_swaps(scene, markers=markers, settings=settings))
        for length in (length for length in LENGTHS if 3 * length < len(scene.positions)):
            for trial in range(arguments.trials):
                rng = np.random.default_rng([length, trial])
                harm = Contamination(scene.positions, markers, margin=2, alone=True, rng=rng)
                band = trial % len(BANDS)
                try:
                    harm.swap(length=integers(length, length), within=BANDS[band], count=1)
                except ValueError:
                    continue
                one, other = harm.artifacts[0].marker, harm.artifacts[0].partner
                a, b = markers.index(one), markers.index(str(other))
                apart = np.nanmedian(np.linalg.norm(scene.positions[:, a] - scene.positions[:, b], axis=1))
                key = int(np.searchsorted(BANDS, apart)), length
                found = detect_swaps(replace(scene, positions=harm.positions), markers=markers, settings=settings)
                truth = {(event.marker, event.start, event.stop, event.partner) for event in harm.events["steps"]}
                told = {(event.marker, event.start, event.stop, event.partner) for event in found}
                mended = undone(harm.positions, found, markers)
                tried[key] += 1
                right[key] += truth == told and np.array_equal(mended, scene.positions, equal_nan=True)
                false += len(told - truth)
    print(f"{'mm apart, frames':>18}" + "".join(f"{length:>9}" for length in LENGTHS))
    for band, high in enumerate(BANDS):
        cells = [f"{right[band, length]}/{tried[band, length]}" for length in LENGTHS]
        print(f"{'up to ' + format(high, 'g'):>18}" + "".join(f"{cell:>9}" for cell in cells))
    print(f"false events: {false} beside swaps, {in_clean} in the recordings as they are")


if __name__ == "__main__":
    main()
