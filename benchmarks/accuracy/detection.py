"""Contaminate clean recordings with known artifacts, find and repair these, and print the accuracy.

Reads: the clean recordings named on the command line, the workflow's config, benchmarks/support/confirmed_glitches.tsv.
Writes: tables to stdout, one set for each condition (amplitude, share, preset) and group of recordings, over all seeds.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.detection ../shared/data/clean/* --amplitudes 10 --shares 0.1 --jobs 2
    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.detection ../shared/data/clean/* --protocol practice --presets default --seeds 10 11 12

The contamination (see markermend.simulation.protocols) is `spatial`: a share of the time distorted, one marker at a time in a random
direction, in equal shares peaks, heavy noise, steps and slow changes of 50 samples on average; or, with `--protocol practice`, what
that leaves out. Amplitudes are normal, of 10 mm with a deviation of 4, and of 5 with 2.

Counts are of samples. Each has one class, true and found: where findings overlap, that of the detector that was first.
What frozen and tails find is a class like the others, though the published contamination has neither: a sample of a peak that
they take away is found (`any`), but as what it is not. The preset `paper`
is the published detector alone, without labels, frozen and tails. Macro F1 is over the classes that were put in. RMSE is
over the distorted samples that have a value after repair (the share that has none is printed), and, as `all`, over all.

Clean recordings hold glitches of their own. Those that were confirmed by eye (the marker leaves its path and that
predicted from its neighbours, at once and in the same way, and the neighbours do not) are listed in confirmed_glitches.tsv, frames
in the capture program's numbering. Their samples, and two on either side, count neither as clean nor as false.
"""

import argparse
import csv
import os
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np

from benchmarks.support import result_tables
from benchmarks.support.defaults import PROJECT
from benchmarks.support.detection_outcome import Outcome, figures, print_outcome
from markermend import api
from markermend.core import events
from markermend.core.artifacts import DETECTORS
from markermend.core.events import Event
from markermend.core.mesh import Mesh
from markermend.core.recording import Recording
from markermend.simulation.contamination import Contamination
from markermend.simulation.protocols import PROTOCOLS

PRESETS = ("peaks", "noise", "steps", "slow")
"""The detectors that have presets."""
GLITCHES = PROJECT / "benchmarks/support/confirmed_glitches.tsv"
BORDER = 2
"""Samples on either side of a glitch that are not counted: where it begins is a matter of taste."""
GROUPS = {"calm": ("STS1", "Qualisys", "HDM_mm_01-02_03_120"), "fast": ("85_02", "85_12")}
"""Recordings by how much goes on in them; all others are in a group by themselves."""


def contaminate(
    clean: Recording, *, amplitude: float, share: float, seed: int, protocol: str = "spatial"
) -> Contamination:
    """Contaminate a recording."""
    given = {"amplitude": amplitude, "share": share, "rng": np.random.default_rng(seed)}
    return PROTOCOLS[protocol](clean.positions, clean.markers, rate=clean.rate, **given)


@cache
def options_of(preset: str) -> api.Options:
    """The default options with a preset of the detectors; `paper` is the published detectors alone."""
    presets = {name: {"preset": preset} for name in PRESETS if (name, preset) != ("slow", "coordinates")}
    return api.Options.read({**presets, **({"detect": list(PRESETS)} if preset == "paper" else {})})


def mend(recording: Recording, mesh: Mesh, found: Mapping[str, Sequence[Event]]) -> tuple[np.ndarray, bool]:
    """Positions after repair of what was found, and whether the repair refused."""
    result = api.repair(recording, mesh, found)
    refused = bool(result.changes) and all(change.reason for change in result.changes)
    return result.recording.positions, refused


def class_of(kind: str) -> int:
    """Number of the class of an event of a detector; 0 is clean."""
    return 1 + DETECTORS.index(kind)


def classes(found: Mapping[str, Sequence[Event]], recording: Recording) -> np.ndarray:
    """Class of each sample (frames, markers): 0 clean, else 1 + its place in DETECTORS; the detector that was first wins."""
    own = [(class_of(kind), event) for kind in found for event in found[kind]]
    out = np.zeros(recording.missing.shape, int)
    for number in range(len(DETECTORS), 0, -1):
        some = [event for other, event in own if other == number]
        out[events.mask(some, recording.frames, recording.markers)] = number
    return out


def forms(contamination: Contamination, seen: np.ndarray, called: np.ndarray) -> Counter[tuple[str, str, str]]:
    """Artifacts and samples by class and form, and what was found of them. seen: which samples count; called: their classes."""
    count: Counter[tuple[str, str, str]] = Counter()
    for artifact in contamination.artifacts:
        number, m = class_of(artifact.kind), contamination.markers.index(artifact.marker)
        own = called[artifact.start : artifact.stop, m][seen[artifact.start : artifact.stop, m]]
        key = DETECTORS[number - 1], artifact.form
        count.update({(*key, "artifacts"): 1, (*key, "samples"): own.size})
        count.update({(*key, "any"): int((own > 0).sum()), (*key, "right"): int((own == number).sum())})
    return count


def glitches(path: Path, recording: Recording) -> np.ndarray:
    """Bool (frames, markers): True where a glitch of the recording itself is confirmed, and next to it."""
    out = np.zeros(recording.missing.shape, bool)
    with GLITCHES.open(encoding="utf-8", newline="") as stream:
        for row in csv.DictReader(stream, delimiter="\t"):
            if row["recording"] == path.stem and row["marker"] in recording.markers:  # others are computed points
                start = int(row["first_frame"]) - recording.first_frame - BORDER
                stop = int(row["last_frame"]) - recording.first_frame + 1 + BORDER
                out[max(0, start) : stop, recording.markers.index(row["marker"])] = True
    return out


def evaluate(clean: Recording, *, ignored: np.ndarray, presets: Sequence[str], **condition: Any) -> dict[str, Outcome]:
    """Contaminate one recording, and evaluate each preset on it.

    ignored: samples (frames, markers) that do not count. condition: see `contaminate`.
    """
    contamination = contaminate(clean, **condition)
    contaminated = replace(clean, positions=contamination.positions)
    mesh = api.infer_mesh([contaminated])
    truth, seen, out = classes(contamination.events, contaminated), ~contaminated.missing & ~ignored, {}
    perfect, _ = mend(contaminated, mesh, contamination.events)
    for preset in presets:
        found = api.detect(contaminated, mesh, options_of(preset))
        called, outcome = classes(found, contaminated), Outcome()
        np.add.at(outcome.confusion, (truth[seen], called[seen]), 1)
        outcome.forms = forms(contamination, seen, called)
        actual, outcome.refused = mend(contaminated, mesh, found)
        for stage, positions in enumerate((contaminated.positions, perfect, actual)):
            squared = ((positions - clean.positions) ** 2).sum(axis=2)
            known = seen & ~np.isnan(squared)
            for kind in range(1 + len(DETECTORS)):
                own = squared[known & (truth == kind)]
                outcome.squares[stage, kind] += own.sum(), own.size
        out[preset] = outcome
    return out


def run(path: Path, presets: Sequence[str], condition: dict[str, Any]) -> dict[str, Outcome]:
    """Judge one recording under one condition."""
    clean = api.read(path, kind="dynamic")
    return evaluate(clean, ignored=glitches(path, clean), presets=presets, **condition)


def group_of(path: Path) -> str:
    return next((name for name, recordings in GROUPS.items() if path.stem in recordings), "others")


def conditions(arguments: argparse.Namespace) -> Iterator[dict[str, Any]]:
    """What `contaminate` is asked for, but for the seed."""
    for amplitude, share in product(arguments.amplitudes, arguments.shares):
        yield {"protocol": arguments.protocol, "amplitude": amplitude, "share": share}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recordings", type=Path, nargs="+", help="clean recordings")
    parser.add_argument("--protocol", choices=PROTOCOLS, default="spatial", help="how to contaminate them")
    parser.add_argument("--amplitudes", type=float, nargs="+", default=[5, 10], help="mean amplitudes, mm")
    parser.add_argument(
        "--shares", type=float, nargs="+", default=[0.05, 0.1, 0.2], help="shares of the time distorted"
    )
    parser.add_argument("--presets", nargs="+", default=["default", "paper"], help="presets of the detectors")
    parser.add_argument("--seeds", type=int, nargs="+", default=[0], help="seeds; one contamination each")
    parser.add_argument("--each", action="store_true", help="print the tables of each recording too")
    parser.add_argument("--jobs", type=int, default=1, help="processes, of one thread each")
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    arguments = parser.parse_args()
    rows: list[dict[str, object]] = []
    with ProcessPoolExecutor(arguments.jobs) as pool:
        for condition in conditions(arguments):
            totals: dict[tuple[str, str], Outcome] = {}
            tasks = [(path, seed) for path in arguments.recordings for seed in arguments.seeds]
            waiting = [pool.submit(run, path, arguments.presets, {**condition, "seed": seed}) for path, seed in tasks]
            for (path, seed), result in zip(tasks, waiting, strict=True):
                names = (group_of(path), "all recordings", *([path.stem] if arguments.each else []))
                for (preset, outcome), name in product(result.result().items(), names):
                    totals.setdefault((name, preset), Outcome()).add(outcome)
                described = ", ".join(f"{key} {value}" for key, value in condition.items())
                print(f"{path.stem}, seed {seed}, {described}", file=sys.stderr)
            for name, preset in sorted(totals, key=lambda key: key[0] == "all recordings"):
                title = f"{name}: {condition['protocol']}, {condition['amplitude']:g} mm, {condition['share']:.0%}, {preset}"
                print_outcome(title, totals[name, preset])
                rows.append(
                    {
                        "protocol": condition["protocol"],
                        "preset": preset,
                        "amplitude_mm": f"{condition['amplitude']:g}",
                        "share_percent": f"{100 * condition['share']:g}",
                        "group": name,
                        **figures(totals[name, preset]),
                    }
                )
    if arguments.tsv:
        result_tables.write(arguments.tsv, rows)


if __name__ == "__main__":
    main()
