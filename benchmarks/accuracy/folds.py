"""Choose thresholds of the detectors on some recordings and report on the others, all folds in turn, and print both.

Reads: the data folder (support/recording_folds.py has the folds, one for each subject), the workflow's config.
Writes: tables to stdout: for each threshold and fold left out the value that was chosen, and false findings a minute and the share
of faults found, on the folds that it was chosen on and on the one left out; below, the means and those of the default.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.folds --tsv benchmarks/results/folds.tsv
    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.folds --thresholds steps.threshold_sigmas=5,6,7,8.5,10 --length 6

Of each fold one crop is used, the first. The rule: the lowest value on the grid with which the stage has at most `--limit` false findings a minute on the folds to choose on;
the highest value if none has. Findings count as false in recordings without faults, but for confirmed glitches; recordings as they
come from the capture program (group raw) have true ones, so that only faults are counted there. Faults are those of
markermend.simulation.fault_kinds that the stage is meant for, in the forms for choosing on the folds to choose on and in those for
reporting on the one left out; a fault is found where at least half of its samples are in findings of the stage or of those before it,
which have their defaults.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"


from benchmarks.accuracy.detection import glitches
from benchmarks.accuracy.practice import Task, judge_all, make_copy
from benchmarks.support import result_tables
from benchmarks.support.defaults import DATA
from benchmarks.support.fault_outcome import covered
from benchmarks.support.recording_folds import CROPS, FOLDS, Crop, load
from markermend import api
from markermend.command import detector
from markermend.core.events import Event, count_findings
from markermend.core.mesh import Mesh
from markermend.core.recording import Recording

KINDS = {
    "peaks": ("peak",),
    "noise": ("jitter", "wobble"),
    "steps": ("line of sight", "flicker", "dip"),
    "slow": ("drift 0.3-0.8 s 10 mm", "drift 1.4 s 10 mm"),
}
"""The faults that each stage is meant for."""

GRIDS = (
    "peaks.threshold_sigmas=7,9.5,12,16",
    "noise.threshold_sigmas=4.5,6,7.5,10",
    "steps.threshold_sigmas=5.5,6.9,8.5,11",
    "slow.threshold_sigmas=3.5,4.5,5.5,7",
)
"""The thresholds, and the grids around their defaults."""

SEEDS = {"choosing": 0, "reporting": 10}
"""The seed of each use."""


RAW = "raw"
"""The group whose findings are not counted as false."""


class Score(NamedTuple):
    """What one value of a threshold does on some crops: minutes without faults, false findings, faults, and those found."""

    minutes: float = 0.0
    false: int = 0
    faults: int = 0
    found: int = 0

    def plus(self, other: Score) -> Score:
        return Score(
            self.minutes + other.minutes,
            self.false + other.false,
            self.faults + other.faults,
            self.found + other.found,
        )

    @property
    def rate(self) -> float:
        """False findings a minute."""
        return self.false / self.minutes if self.minutes else float("nan")

    @property
    def recall(self) -> float:
        """Share of the faults that was found."""
        return self.found / self.faults if self.faults else float("nan")


class Threshold(NamedTuple):
    """An option of a stage, and the values that are tried; the default is the one of the config."""

    stage: str
    option: str
    values: tuple[float, ...]

    @classmethod
    def parse(cls, text: str) -> Threshold:
        """Parse `stage.option=value,value`."""
        name, _, values = text.partition("=")
        stage, _, option = name.partition(".")
        return cls(stage, option, tuple(sorted(float(value) for value in values.split(","))))

    @property
    def default(self) -> float:
        """The default."""
        return float(getattr(getattr(api.Options.read(), self.stage), self.option))

    def options(self, value: float) -> api.Options:
        """The options with a value of the threshold."""
        return api.Options.read({self.stage: {self.option: value}})


def stage_findings(
    recording: Recording, mesh: Mesh, threshold: Threshold
) -> Iterator[tuple[float, dict[str, list[Event]]]]:
    """What the stage, and those before it by their defaults, find with each value of its threshold."""
    stages = list(api.DETECTORS)
    before = stages[: stages.index(threshold.stage)]
    earlier = api.detect(recording, mesh, api.Options.read({"detect": before})) if before else {}
    known = [event for events in earlier.values() for event in events]
    for value in threshold.values:
        own = detector.find(
            api.DETECTORS[threshold.stage],
            recording,
            api.mesh_of(recording, mesh),
            known,
            options=getattr(threshold.options(value), threshold.stage),
            published=api.PUBLISHED.get(threshold.stage),
        )
        yield value, {**earlier, threshold.stage: list(own)}


@cache
def false_findings(data: Path, crop: Crop, threshold: Threshold) -> dict[float, Score]:
    """The scores of all values on one crop without faults."""
    clean, session = load(data, crop)
    confirmed, out = glitches(Path(crop.file), clean), {}
    for value, findings in stage_findings(clean, api.infer_mesh([clean, *session]), threshold):
        false = [
            event
            for event in findings[threshold.stage]
            if not confirmed[event.start : event.stop, clean.markers.index(event.marker)].any()
        ]
        out[value] = Score(clean.frames / clean.rate / 60, count_findings(false))
    return out


def scores(data: Path, crop: Crop, threshold: Threshold, use: str) -> dict[float, Score]:
    """The scores of all values on one crop with faults in the forms of a use, and without faults."""
    clean, session = load(data, crop)
    copy = make_copy(clean, Task(data, crop, KINDS[threshold.stage], use, SEEDS[use]))
    faulty = replace(clean, positions=copy.positions)
    none = {value: Score() for value in threshold.values}
    out = dict(none if crop.group == RAW else false_findings(data, crop, threshold))
    for value, findings in stage_findings(faulty, api.infer_mesh([faulty, *session]), threshold):
        outcomes = judge_all(copy, covered(findings, clean.frames, clean.markers), copy.positions)
        out[value] = out[value].plus(Score(0.0, 0, len(outcomes), sum(outcome.found for outcome in outcomes)))
    return out


def total(by_fold: Mapping[str, Mapping[float, Score]], folds: Sequence[str], value: float) -> Score:
    """The sum of the scores of a value over folds."""
    own = Score()
    for fold in folds:
        own = own.plus(by_fold[fold][value])
    return own


def choose(by_fold: Mapping[str, Mapping[float, Score]], folds: Sequence[str], limit: float) -> float:
    """The lowest value with at most so many false findings a minute on some folds, else the highest."""
    values = sorted(next(iter(by_fold.values())))
    return next((value for value in values if total(by_fold, folds, value).rate <= limit), values[-1])


def rows(
    threshold: Threshold, by_use: Mapping[str, Mapping[str, Mapping[float, Score]]], limit: float
) -> list[dict[str, Any]]:
    """The rows of one threshold: each fold left out once, then all of them, then the default."""
    choosing, reporting = by_use["choosing"], by_use["reporting"]
    name = f"{threshold.stage}.{threshold.option}"
    found, here, there = [], Score(), Score()
    for left_out in choosing:
        others = [fold for fold in choosing if fold != left_out]
        value = choose(choosing, others, limit)
        one, other = total(choosing, others, value), reporting[left_out][value]
        here, there = here.plus(one), there.plus(other)
        found.append(_row(name, left_out, value, one, other))
    default = min(threshold.values, key=lambda value: abs(value - threshold.default))
    found.append(_row(name, "all", float("nan"), here, there))
    sums = (total(scores, list(scores), default) for scores in (choosing, reporting))
    found.append(_row(name, "all, default", default, *sums))
    return found


def _row(name: str, left_out: str, value: float, choosing: Score, held_out: Score) -> dict[str, Any]:
    return {
        "threshold": name,
        "left_out": left_out,
        "value": value,
        "choosing_false_per_minute": choosing.rate,
        "choosing_found": choosing.recall,
        "held_out_false_per_minute": held_out.rate,
        "held_out_found": held_out.recall,
        "held_out_faults": held_out.faults,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, default=DATA, help="the folder of recordings")
    parser.add_argument("--thresholds", nargs="+", default=GRIDS, help="stage.option=values, separated by commas")
    parser.add_argument("--folds", nargs="+", choices=FOLDS, default=FOLDS, help="the folds; by default all")
    parser.add_argument("--limit", type=float, default=2.0, help="false findings a minute that are allowed")
    parser.add_argument("--length", type=float, default=3.0, help="seconds of each crop, at most")
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    arguments = parser.parse_args()
    table: list[dict[str, Any]] = []
    chosen = {crop.fold: crop for crop in reversed(CROPS) if crop.fold in arguments.folds}
    crops = [replace(crop, length_s=min(crop.length_s, arguments.length)) for crop in chosen.values()]
    for threshold in map(Threshold.parse, arguments.thresholds):
        by_use: dict[str, dict[str, dict[float, Score]]] = {}
        for use in SEEDS:
            for crop in crops:
                print(f"{threshold.stage}.{threshold.option}, {crop.name}, {use}", file=sys.stderr)
                own = scores(arguments.data, crop, threshold, use)
                fold = by_use.setdefault(use, {}).setdefault(crop.fold, {value: Score() for value in threshold.values})
                fold.update({value: fold[value].plus(own[value]) for value in threshold.values})
        table += rows(threshold, by_use, arguments.limit)
    print(f"{'threshold':26}{'left out':14}{'value':>7}{'choosing: false/min, found':>28}{'held out':>20}")
    for row in table:
        here, there = (
            f"{row[f'{use}_false_per_minute']:.2f}, {row[f'{use}_found']:.2f}" for use in ("choosing", "held_out")
        )
        print(f"{row['threshold']:26}{row['left_out']:14}{row['value']:7g}{here:>28}{there:>20}")
    if arguments.tsv:
        result_tables.write(arguments.tsv, table)


if __name__ == "__main__":
    main()
