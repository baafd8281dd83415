"""Time the training of networks side by side against one after the other, on markers of a synthetic person.

Writes: a table to stdout.

    OMP_NUM_THREADS=1 PYTHONPATH=scripts .venv/bin/python -m benchmarks.runtime.networks --epochs 30

Options are those of config/config.yaml but for the epochs: time is proportional to them, and the ratio does not depend
on them. Each number of networks is trained both ways in turn, on the same gaps; the last column is the largest distance
between the predictions of the two, mm.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
import torch

from markermend.options.prediction.neural_network import NeuralNetworkOptions
from markermend.prediction.neural_network.predictor import KINDS, Network
from markermend.prediction.scene import Scene
from markermend.simulation.walker import MeasurementErrors, walk
from markermend.simulation.walker_body import make_body

DEFAULT = NeuralNetworkOptions()
GAP = (500, 600)
Place = tuple[np.ndarray, list[np.ndarray]]
"""Positions (frames, markers, 3) and the neighbours of each marker."""


def positions(markers: int) -> Place:
    """A person for 15 s, with a gap of 1 s in each of the first markers, and the neighbours of each marker."""
    rng = np.random.default_rng(1)
    person = walk(
        body=make_body(rng=rng),
        duration=15.0,
        rate=100.0,
        activities=["exercise", "walk"],
        errors=MeasurementErrors(noise=0.2, soft_tissue=1.0),
        rng=rng,
    ).recording.positions
    distance = np.linalg.norm(person[::20, :, None] - person[::20, None], axis=3)
    spread = distance.std(axis=0) + 1e9 * np.eye(len(distance[0]))
    gapped = person.copy()
    gapped[GAP[0] : GAP[1], :markers] = np.nan
    return gapped, [np.argsort(row, kind="stable")[:-1] for row in spread]


def trained(network: Network, place: Place, jobs: Iterable[Sequence[int]]) -> tuple[float, np.ndarray]:
    """Train the jobs (lists of markers) one after the other in a fresh scene; the seconds, and what all markers get."""
    scene = Scene(place[0], 100.0, place[1])
    started = time.perf_counter()
    for markers in jobs:
        network.train([(scene, marker) for marker in markers])
    seconds = time.perf_counter() - started
    return seconds, np.stack([network.predict(scene, marker, *GAP).positions for markers in jobs for marker in markers])


def main() -> None:
    """Parse the command line, train, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=list(KINDS))
    parser.add_argument("--networks", nargs="+", type=int, default=[1, 8, 32], help="how many are trained at once")
    parser.add_argument("--epochs", type=int, default=30)
    parser.add_argument("--frames", type=int, default=DEFAULT.max_training_frames, help="training frames, at most")
    arguments = parser.parse_args()
    batch = max(arguments.networks)
    options = replace(DEFAULT, epochs=arguments.epochs, max_training_frames=arguments.frames, batch_networks=batch)
    print(f"{torch.cuda.get_device_name() if torch.cuda.is_available() else 'CPU'}, {torch.get_num_threads()} threads")
    print(f"{options.max_training_frames} frames, {options.epochs} epochs\n")
    print(f"{'kind':16} {'networks':>8} {'at once, s':>11} {'one by one, s':>14} {'ratio':>6} {'apart, mm':>10}")
    for kind in arguments.kinds:
        network = Network(kind, options)
        network.train([(Scene(*positions(1)[:1], 100.0, positions(1)[1]), 0)])
        for number in arguments.networks:
            place = positions(number)
            once, together = trained(network, place, [range(number)])
            single, other = trained(network, place, [[marker] for marker in range(number)])
            apart = np.nanmax(np.linalg.norm(together - other, axis=2), initial=0)
            print(f"{kind:16} {number:8} {once:11.2f} {single:14.2f} {single / once:6.1f} {apart:10.3f}", flush=True)


if __name__ == "__main__":
    main()
