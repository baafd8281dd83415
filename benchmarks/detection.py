"""Damage clean recordings in known ways, find and repair the damage, and print how well that went.

Reads: the clean recordings named on the command line, the workflow's config, confirmed_glitches.tsv beside this file.
Writes: tables to stdout, one set for each condition (amplitude, share, preset) and group of recordings, over all seeds.

    PYTHONPATH=scripts .venv/bin/python benchmarks/detection.py ../shared/data/clean/* --amplitudes 10 --shares 0.1

Damage is the procedure of skurowski2022 (section 4.1.3): a share of the time distorted, one marker at a time, in equal
shares peaks, heavy noise, steps and slow changes of 50 samples on average. Amplitudes are normal, of 10 mm with a
deviation of 4, and of 5 with 2. Counts are of samples. RMSE is over the distorted samples that have a value after
repair (the share that has none is told), and, as `all`, over all samples.

Clean recordings hold glitches of their own. Those that were confirmed by eye (the marker leaves its course and that
predicted from its neighbours, at once and alike, and the neighbours do not) are listed in confirmed_glitches.tsv, frames
in the capture program's numbering. Their samples, and two on either side, count neither as clean nor as false.
"""

import argparse
import csv
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import yaml

from markermend import events, hills, mesh_inference, mesh_statistics, noise, peaks, slow, steps, swaps
from markermend.contamination import Contamination
from markermend.formats import files
from markermend.mesh import Mesh
from markermend.predictors import Scene
from markermend.predictors.registry import REGISTRY, SHARED, members
from markermend.procedures import one_at_a_time, recipes
from markermend.recording import Recording
from markermend.repair import RepairOptions, repair

PROJECT = Path(__file__).resolve().parents[1]
DETECTORS = {"peaks": peaks, "noise": noise, "steps": steps, "slow": slow}
CLASSES = tuple(DETECTORS)
GLITCHES = Path(__file__).with_name("confirmed_glitches.tsv")
BORDER = 2
"""Samples on either side of a glitch that are not counted: where it begins is a matter of taste."""
GROUPS = {"calm": ("STS1", "Qualisys", "HDM_mm_01-02_03_120"), "fast": ("85_02", "85_12")}
"""Recordings by how much goes on in them; all others are in a group by themselves."""


@dataclass
class Outcome:
    """What is counted over recordings and seeds.

    confusion: samples by true and by found class, (5, 5), clean first. squares: sum of squared errors, mm^2, and number
    of samples, (stages of repair, classes, 2): before, after repair of the true and of the found events.
    """

    confusion: np.ndarray
    squares: np.ndarray
    refused: int = 0

    def add(self, other: "Outcome") -> None:
        self.confusion += other.confusion
        self.squares += other.squares
        self.refused += other.refused


def nothing() -> Outcome:
    return Outcome(np.zeros((5, 5), int), np.zeros((3, 5, 2)))


def damage(clean: Recording, *, amplitude: float, share: float, seed: int) -> Contamination:
    """Contaminate a recording."""
    rng = np.random.default_rng(seed)
    given = {"recipes": recipes(amplitude), "share": share, "margin": 10, "rng": rng}
    return one_at_a_time(clean.positions, clean.markers, **given)


def detect(recording: Recording, body: Mesh, config: dict, preset: str) -> dict:
    """Find the events of each class as the workflow does: swaps undone, each detector after the ones before."""
    near, relatives = body.neighbour_indices(recording.markers), body.relative_indices(recording.markers)
    scene, swapped = Scene(recording.positions, recording.rate, near, relatives=relatives), []
    if preset != "paper":
        swapped = swaps.detect_swaps(scene, markers=recording.markers, settings=swaps.SwapSettings(**config["swaps"]))
        scene = replace(scene, positions=swaps.undone(scene.positions, swapped, recording.markers))
    predictor = members(["local_ridge"], {"local_ridge": config["local_ridge"]})[0]
    claimed, found = np.zeros(recording.positions.shape, bool), {}
    for kind, module in DETECTORS.items():
        settings = module.settings({**config[kind], "preset": preset})
        if isinstance(settings, hills.CoordinateSlow):
            predictor = hills.predictor(settings, config)
        arguments = {"markers": recording.markers, "earlier": claimed, "settings": settings, "predictor": predictor}
        result = getattr(module, f"detect_{kind}")(scene, **arguments)
        found[kind] = result[0] if kind == "steps" else result
        claimed = claimed | events.coordinates(found[kind], recording.frames, recording.markers)
    return {**found, "steps": swaps.among(found["steps"], swapped)}


def mend(recording: Recording, neighbours: list[np.ndarray], found: dict, config: dict) -> tuple[np.ndarray, bool]:
    """Positions after repair of what was found, and whether the repair refused."""
    options = RepairOptions(**config["repair"], protect=config["protect"])
    names = {name for methods in options.methods.values() for name in methods if name in REGISTRY} | {"local_ridge"}
    settings = {name: config[name] for name in SHARED}
    predictors = {predictor.name: predictor for predictor in members(sorted(names), settings)}
    result = repair(recording, found=found, neighbours=neighbours, predictors=predictors, options=options)
    refused = bool(result.facts["repairs_left"]) and not result.facts["repairs"]
    return result.positions, refused


def classes(found: dict, recording: Recording) -> np.ndarray:
    """Class of each sample (frames, markers): 0 clean, else 1 + its place in CLASSES; the detector that was first wins."""
    out = np.zeros(recording.missing.shape, int)
    for kind in reversed(CLASSES):
        out[events.mask(found[kind], recording.frames, recording.markers)] = 1 + CLASSES.index(kind)
    return out


def glitches(path: Path, recording: Recording) -> np.ndarray:
    """Bool (frames, markers): True where a glitch of the recording itself is confirmed, and beside it."""
    out = np.zeros(recording.missing.shape, bool)
    with GLITCHES.open(encoding="utf-8", newline="") as stream:
        for row in csv.DictReader(stream, delimiter="\t"):
            if row["recording"] == path.stem:
                start = int(row["first_frame"]) - recording.first_frame - BORDER
                stop = int(row["last_frame"]) - recording.first_frame + 1 + BORDER
                out[max(0, start) : stop, recording.markers.index(row["marker"])] = True
    return out


def judge(
    clean: Recording, config: dict, *, ignored: np.ndarray, amplitude: float, share: float, seed: int, presets: list
) -> dict:
    """Damage one recording once, and judge each preset on it. ignored: samples (frames, markers) that do not count."""
    harm = damage(clean, amplitude=amplitude, share=share, seed=seed)
    harmed = replace(clean, positions=harm.positions, facts={"recording": "benchmark"})
    settings = {key: value for key, value in config["mesh"].items() if key not in ("files", "marker_overlap")}
    thinned = mesh_statistics.thin(harmed, frames=settings["frames"])
    body = mesh_inference.infer_mesh([thinned], **settings)
    neighbours = body.neighbour_indices(harmed.markers)
    truth, seen, out = classes(harm.events, harmed), ~harmed.missing & ~ignored, {}
    perfect, _ = mend(harmed, neighbours, harm.events, config)
    for preset in presets:
        found = detect(harmed, body, config, preset)
        outcome = out[preset] = nothing()
        np.add.at(outcome.confusion, (truth[seen], classes(found, harmed)[seen]), 1)
        actual, outcome.refused = mend(harmed, neighbours, found, config)
        for stage, positions in enumerate((harmed.positions, perfect, actual)):
            squared = ((positions - clean.positions) ** 2).sum(axis=2)
            known = seen & ~np.isnan(squared)
            for kind in range(5):
                own = squared[known & (truth == kind)]
                outcome.squares[stage, kind] += own.sum(), own.size
    return out


def correlation(confusion: np.ndarray) -> float:
    """Matthews' correlation coefficient of several classes (Gorodkin 2004)."""
    true, found, total = confusion.sum(axis=1), confusion.sum(axis=0), confusion.sum()
    spread = np.sqrt(float(total**2 - found @ found)) * np.sqrt(float(total**2 - true @ true))
    return float(np.trace(confusion) * total - true @ found) / spread if spread else 0.0


def root(squares: np.ndarray) -> float:
    """Root mean square from sums and counts (..., 2); NaN without any."""
    total, count = squares.reshape(-1, 2).sum(axis=0)
    return float(np.sqrt(total / count)) if count else float("nan")


def print_outcome(title: str, outcome: Outcome) -> None:
    """The tables of one condition."""
    confusion, squares = outcome.confusion, outcome.squares
    print(f"\n{title}" + (f" (repair of what was found refused {outcome.refused} times)" if outcome.refused else ""))
    names = ("clean", *CLASSES)
    print(f"{'samples: true, found':>22}" + "".join(f"{name:>9}" for name in names))
    for name, row in zip(names, confusion, strict=True):
        print(f"{name:>22}" + "".join(f"{count:9}" for count in row))
    columns = ("TPR", "PPV", "F1", "any", "before", "perfect", "actual", "blank p", "blank a")
    print(f"{'class':>22}" + "".join(f"{name:>9}" for name in columns))
    scores = []
    for k, name in enumerate(names[1:], 1):
        right, true, found = confusion[k, k], max(1, confusion[k].sum()), max(1, confusion[:, k].sum())
        scores.append(2 * right / (true + found))
        errors = [root(squares[stage, k]) for stage in range(3)]
        blank = [1 - squares[stage, k, 1] / max(1, squares[0, k, 1]) for stage in (1, 2)]
        rates = (right / true, right / found, scores[-1], confusion[k, 1:].sum() / true)
        print(f"{name:>22}" + "".join(f"{value:9.3f}" for value in (*rates, *errors, *blank)))
    overall = [root(squares[stage, 1:]) for stage in range(3)]
    print(f"{'distorted':>22}{'':36}" + "".join(f"{value:9.3f}" for value in overall))
    print(f"{'all':>22}{'':36}" + "".join(f"{root(squares[stage]):9.3f}" for stage in range(3)))
    false = confusion[0, 1:] / max(1, confusion[0].sum())
    each = ", ".join(f"{name} {share:.4%}" for name, share in zip(CLASSES, false, strict=True))
    print(
        f"macro F1 {np.mean(scores):.3f}, MCC {correlation(confusion):.3f}, false per clean {false.sum():.4%} ({each})"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recordings", type=Path, nargs="+", help="clean recordings")
    parser.add_argument("--amplitudes", type=float, nargs="+", default=[5, 10], help="mean amplitudes, mm")
    parser.add_argument(
        "--shares", type=float, nargs="+", default=[0.05, 0.1, 0.2], help="shares of the time distorted"
    )
    parser.add_argument("--presets", nargs="+", default=["default", "paper"], help="presets of the detectors")
    parser.add_argument("--seeds", type=int, nargs="+", default=[0], help="seeds; one contamination each")
    parser.add_argument("--each", action="store_true", help="print the tables of each recording too")
    arguments = parser.parse_args()
    config = yaml.safe_load((PROJECT / "config/config.yaml").read_text(encoding="utf-8"))
    for amplitude in arguments.amplitudes:
        for share in arguments.shares:
            totals: dict[tuple[str, str], Outcome] = {}
            for path in arguments.recordings:
                clean = files.read(path, unlabelled=config["ingest"]["unlabelled"], rate=None).recording
                group = next((name for name, members in GROUPS.items() if path.stem in members), "others")
                names = (path.stem, group, "all recordings") if arguments.each else (group, "all recordings")
                condition = {"amplitude": amplitude, "share": share, "presets": arguments.presets}
                for seed in arguments.seeds:
                    judged = judge(clean, config, ignored=glitches(path, clean), seed=seed, **condition)
                    for preset, outcome in judged.items():
                        for name in names:
                            totals.setdefault((name, preset), nothing()).add(outcome)
            for (name, preset), outcome in totals.items():
                print_outcome(f"{name}: {amplitude:g} mm, {share:.0%}, {preset}", outcome)


if __name__ == "__main__":
    main()
