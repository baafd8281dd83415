"""Put every kind of fault that recordings have into recordings at hand, find and repair it, and print what became of it.

Reads: the data folder (support/recording_folds.py says which recordings, in which groups), the workflow's config.
Writes: a table to stdout, one row for each kind and group.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.practice --use reporting --tsv benchmarks/results/practice.tsv
    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.practice --kinds wobble jitter --groups calm --each
    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.practice --kinds knocked --config '{"steps": {"preset": "default"}}'

`--use choosing` takes the recordings, the forms of faults and the seeds (0 to 9) for choosing thresholds, `--use reporting` those
for reporting (10 to 19). Kinds, groups and recordings are named by how their names begin, kinds as in
markermend.simulation.fault_kinds. A copy holds two faults of each of up to four kinds, on markers or at times apart, and of the
system's faults and exchanges of limbs one kind alone.

found: at least half of the wrong samples are in findings of any class; class: in findings of the right class; side: of the found,
those of which a larger share of the wrong samples is in findings than of the right ones about them; undone: all markers as they were, bit for bit (what is missing
after repair does not count); removed: share of the wrong samples that repair takes away, %; before, after: root mean square error
in mm over the fault, before and after repair, where there is a sample. Below the table, for each group the samples that are altered
outside of the faults, without those that are altered in the recording without faults.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np

from benchmarks.support import result_tables
from benchmarks.support.defaults import DATA
from benchmarks.support.fault_outcome import FaultOutcome, altered_outside, covered, figures, judge, repaired_positions
from benchmarks.support.recording_folds import GROUPS, Crop, chosen, load
from markermend import api
from markermend.core.events import Event
from markermend.core.recording import Recording
from markermend.simulation.fault_kinds import FAULT_KINDS, KINDS, generators
from markermend.simulation.fault_site import Site
from markermend.simulation.faults import FaultyCopy, contaminate

SEEDS = {"choosing": range(10), "reporting": range(10, 20)}
"""The seeds of each use."""

MARGIN_S = 0.3
"""Time without faults around each, s."""


KINDS_TOGETHER, FAULTS = 4, 2
"""Kinds of faults in one copy, and faults of each."""


class Task(NamedTuple):
    """One copy: the recording, the kinds of its faults, and how they are drawn."""

    data: Path
    crop: Crop
    kinds: tuple[str, ...]
    use: str
    seed: int
    config: str = "{}"


class Judged(NamedTuple):
    """A copy, what became of its faults, and how many samples were altered outside of them."""

    task: Task
    outcomes: list[FaultOutcome]
    outside: int


def make_copy(recording: Recording, task: Task) -> FaultyCopy:
    """The copy of a task."""
    kinds = [list(KINDS).index(kind) for kind in task.kinds]
    rng = np.random.default_rng([task.seed, *kinds, *task.crop.name.encode()])
    site = Site(recording.positions, recording.markers, rate=recording.rate, margin_s=MARGIN_S, rng=rng)
    forms = {kind: generators(kind, use=task.use) for kind in task.kinds}
    turns = {kind: task.seed * FAULTS % len(own) for kind, own in forms.items()}
    return contaminate(
        site, {kind: own[turns[kind] :] + own[: turns[kind]] for kind, own in forms.items()}, count=FAULTS
    )


def mend(
    recording: Recording, session: Sequence[Recording], config: str
) -> tuple[Mapping[str, Sequence[Event]], np.ndarray]:
    """What is found in a recording, and its positions after repair."""
    options = api.Options.read(json.loads(config))
    mesh = api.infer_mesh([recording, *session], options=options)
    found = api.detect(recording, mesh, options)
    return found, repaired_positions(recording, api.repair(recording, mesh, found, options).recording)


@cache
def altered_anyway(data: Path, crop: Crop, config: str) -> np.ndarray:
    """Samples that are altered in a recording without faults, bool (frames, markers)."""
    recording, session = load(data, crop)
    _, repaired = mend(recording, session, config)
    return np.asarray((repaired != recording.positions).any(axis=2) & ~recording.missing)


def judge_all(copy: FaultyCopy, findings: Mapping[str, np.ndarray], repaired: np.ndarray) -> list[FaultOutcome]:
    """Judge the faults of a copy. findings: see `covered`; repaired: positions after repair."""
    return [
        judge(copy, fault, found=findings, classes=KINDS[fault.kind].classes, repaired=repaired)
        for fault in copy.faults
        if copy.damaged(fault).any()
    ]


def run(task: Task) -> Judged:
    """Find and repair the faults of one copy, and judge that."""
    clean, session = load(task.data, task.crop)
    copy = make_copy(clean, task)
    if not copy.faults:
        return Judged(task, [], 0)
    findings, repaired = mend(replace(clean, positions=copy.positions), session, task.config)
    outcomes = judge_all(copy, covered(findings, clean.frames, clean.markers), repaired)
    return Judged(task, outcomes, altered_outside(copy, repaired, altered_anyway(task.data, task.crop, task.config)))


def tasks(arguments: argparse.Namespace, *, config: str = "{}") -> Iterator[Task]:
    """The copies that are asked for, recording by recording."""
    names = [kind.name for kind in FAULT_KINDS]
    kinds = [name for name in names if not arguments.kinds or name.startswith(tuple(arguments.kinds))]
    sharing = [kind for kind in kinds if not KINDS[kind].alone]
    copies = -(-len(sharing) // KINDS_TOGETHER)
    together = [tuple(sharing[number::copies]) for number in range(copies)]
    together += [(kind,) for kind in kinds if KINDS[kind].alone]
    seeds = arguments.seeds or SEEDS[arguments.use][: arguments.copies]
    for crop in chosen(arguments.groups, arguments.recordings, arguments.use):
        for seed in seeds:
            for some in together:
                yield Task(arguments.data, crop, some, arguments.use, seed, config)


def judged(asked: Sequence[Task], *, jobs: int) -> Iterator[Judged]:
    """Judge copies in processes of their own."""
    with ProcessPoolExecutor(jobs) as pool:
        yield from pool.map(run, asked)


def report(copies: Iterable[Judged], *, each: bool = False) -> list[dict[str, Any]]:
    """Print the table as copies are judged; returns its rows. each: whether there is a line for each fault, too."""
    totals: dict[tuple[str, str], list[FaultOutcome]] = {}
    outside: dict[str, int] = {}
    for task, outcomes, altered in copies:
        done = f"{task.crop.name}, {', '.join(task.kinds)}, seed {task.seed}"
        print(f"{done}: {len(outcomes)} faults, {altered} samples altered outside", file=sys.stderr)
        if each:
            print_each(task, outcomes)
        for outcome in outcomes:
            totals.setdefault((outcome.kind, task.crop.group), []).append(outcome)
        outside[task.crop.group] = outside.get(task.crop.group, 0) + altered
    keys = sorted(totals, key=lambda key: (list(KINDS).index(key[0]), GROUPS.index(key[1])))
    rows = [{"kind": kind, "group": group, **figures(totals[kind, group])} for kind, group in keys]
    print_table(rows)
    print("samples altered outside: " + ", ".join(f"{group} {altered}" for group, altered in outside.items()))
    return rows


def print_each(task: Task, outcomes: Sequence[FaultOutcome]) -> None:
    """A line for each fault."""
    for outcome in outcomes:
        said = [name for name in ("found", "right", "sided", "undone") if getattr(outcome, name)]
        before, after = np.sqrt(outcome.squares[:, 0] / np.maximum(outcome.squares[:, 1], 1))
        place = f"{task.crop.name}, seed {task.seed}: {outcome.kind}, {outcome.form}"
        print(f"{place}: {before:.1f} -> {after:.1f} mm, {', '.join(said) or 'missed'}", flush=True)


def print_table(rows: Sequence[Mapping[str, Any]]) -> None:
    """The table, one line for each kind and group."""
    heads = ("found", "class", "side", "undone", "removed", "before", "after")
    print(f"{'kind':24}{'group':10}" + "".join(f"{head:>9}" for head in heads))
    for row in rows:
        counts = [f"{row['found']}/{row['faults']}", f"{row['in_class']}/{row['faults']}"]
        counts += [f"{row['found_on_right_side']}/{row['found']}", f"{row['undone']}/{row['faults']}"]
        sizes = [f"{row['removed_percent']:.0f}", f"{row['before_mm']:.1f}", f"{row['after_mm']:.1f}"]
        print(f"{row['kind']:24}{row['group']:10}" + "".join(f"{cell:>9}" for cell in (*counts, *sizes)))


def add_selection(parser: argparse.ArgumentParser) -> None:
    """Arguments that say which copies."""
    parser.add_argument("--data", type=Path, default=DATA, help="the folder of recordings")
    parser.add_argument("--use", choices=SEEDS, default="choosing", help="recordings, forms and seeds for that")
    parser.add_argument("--kinds", nargs="+", default=[], help="kinds by how they begin; by default all")
    parser.add_argument("--groups", nargs="+", choices=GROUPS, default=[], help="groups; by default all")
    parser.add_argument("--recordings", nargs="+", default=[], help="names of recordings; by default all")
    parser.add_argument("--copies", type=int, default=1, help="copies of each recording and of each set of kinds")
    parser.add_argument("--seeds", type=int, nargs="+", help="seeds, one copy each, instead of the first of the use")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_selection(parser)
    parser.add_argument("--config", default="{}", help="options that are not the default, as JSON")
    parser.add_argument("--each", action="store_true", help="print a line for each fault, too")
    parser.add_argument("--jobs", type=int, default=1, help="processes, of one thread each")
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    arguments = parser.parse_args()
    asked = list(tasks(arguments, config=arguments.config))
    rows = report(judged(asked, jobs=arguments.jobs), each=arguments.each)
    if arguments.tsv:
        result_tables.write(arguments.tsv, rows)


if __name__ == "__main__":
    main()
