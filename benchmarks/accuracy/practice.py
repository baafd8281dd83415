"""Put every kind of fault that recordings have into recordings at hand, find and repair it, and print what became of it.

Reads: the data folder (support/recording_folds.py says which recordings, in which groups), the workflow's config.
Writes: a table to stdout, one row for each kind and group.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.practice --use reporting --tsv benchmarks/results/practice.tsv
    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.practice --kinds wobble jitter --groups calm --each
    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.practice --kinds knocked --config '{"steps": {"preset": "default"}}'

`--use choosing` takes the recordings, the forms of faults and the seeds (0 to 9) for choosing thresholds, `--use reporting` those
for reporting (10 to 19). Kinds, groups and recordings are named by how their names begin, kinds as in
markermend.simulation.fault_kinds. A copy holds one to four faults of one kind, on markers and at times apart.

found: at least half of the wrong samples are in findings of any class; class: in findings of the right class; side: of the found,
those of which a larger share of the wrong samples is in findings than of the right ones about them; undone: all markers as they were, bit for bit (what is missing
after repair does not count); removed: share of the wrong samples that repair takes away, %; before, after: root mean square error
in mm over the fault, before and after repair, where there is a sample; outside: samples altered outside of the faults, without
those that are altered in the recording without faults.
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
from benchmarks.support.fault_outcome import Tally, altered_outside, covered, figures, judge, repaired_positions
from benchmarks.support.recording_folds import GROUPS, Crop, chosen, load
from markermend import api
from markermend.core.events import Event
from markermend.core.recording import Recording
from markermend.simulation.fault_kinds import KINDS, generators
from markermend.simulation.fault_site import Site
from markermend.simulation.faults import FaultyCopy, contaminate

SEEDS = {"choosing": range(10), "reporting": range(10, 20)}
"""The seeds of each use."""

MARGIN_S = 0.3
"""Time without faults around each, s."""


class Task(NamedTuple):
    """One copy: the recording, the kind of its faults, and how they are drawn."""

    data: Path
    crop: Crop
    kind: str
    use: str
    seed: int
    config: str


def make_copy(recording: Recording, task: Task) -> FaultyCopy:
    """The copy of a task."""
    rng = np.random.default_rng([list(KINDS).index(task.kind), task.seed, *task.crop.name.encode()])
    site = Site(recording.positions, recording.markers, rate=recording.rate, margin_s=MARGIN_S, rng=rng)
    forms = generators(task.kind, use=task.use)
    turn = task.seed % len(forms)
    return contaminate(site, forms[turn:] + forms[:turn], count=KINDS[task.kind].per_copy)


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


def run(task: Task) -> Tally:
    """Judge the faults of one copy."""
    clean, session = load(task.data, task.crop)
    copy = make_copy(clean, task)
    if not copy.faults:
        return Tally()
    findings, repaired = mend(replace(clean, positions=copy.positions), session, task.config)
    found = covered(findings, clean.frames, clean.markers)
    given: dict[str, Any] = {"found": found, "classes": KINDS[task.kind].classes, "repaired": repaired}
    outcomes = [judge(copy, fault, **given) for fault in copy.faults if copy.damaged(fault).any()]
    return Tally(outcomes, altered_outside(copy, repaired, altered_anyway(task.data, task.crop, task.config)))


def tasks(arguments: argparse.Namespace, *, config: str) -> Iterator[Task]:
    """The copies that are asked for, recording by recording."""
    kinds = [kind for kind in KINDS if not arguments.kinds or kind.startswith(tuple(arguments.kinds))]
    seeds = arguments.seeds or SEEDS[arguments.use][: arguments.copies]
    for crop in chosen(arguments.groups, arguments.recordings, arguments.use):
        for kind in kinds:
            for seed in seeds:
                yield Task(arguments.data, crop, kind, arguments.use, seed, config)


def rows(judged: Iterable[tuple[Task, Tally]]) -> list[dict[str, Any]]:
    """The rows of the table, by kind and group."""
    totals: dict[tuple[str, str], Tally] = {}
    for task, tally in judged:
        print(f"{task.crop.name}, {task.kind}, seed {task.seed}: {len(tally.outcomes)} faults", file=sys.stderr)
        totals.setdefault((task.kind, task.crop.group), Tally()).add(tally)
    keys = sorted(totals, key=lambda key: (list(KINDS).index(key[0]), GROUPS.index(key[1])))
    known = [(key, totals[key]) for key in keys if totals[key].outcomes]
    return [{"kind": kind, "group": group, **figures(tally)} for (kind, group), tally in known]


def judged(asked: Sequence[Task], *, jobs: int, each: bool) -> Iterator[tuple[Task, Tally]]:
    """Judge copies in processes of their own. each: whether a line is printed for each fault."""
    with ProcessPoolExecutor(jobs) as pool:
        for task, tally in zip(asked, pool.map(run, asked), strict=True):
            if each:
                print_each(task, tally)
            yield task, tally


def print_each(task: Task, tally: Tally) -> None:
    """A line for each fault."""
    for outcome in tally.outcomes:
        said = [name for name in ("found", "right", "sided", "undone") if getattr(outcome, name)]
        before, after = np.sqrt(outcome.squares[:, 0] / np.maximum(outcome.squares[:, 1], 1))
        place = f"{task.crop.name}, seed {task.seed}: {task.kind}, {outcome.form}"
        print(f"{place}: {before:.1f} -> {after:.1f} mm, {', '.join(said) or 'missed'}")


def print_table(rows: Sequence[Mapping[str, Any]]) -> None:
    """The table, one line for each kind and group."""
    heads = ("found", "class", "side", "undone", "removed", "before", "after", "outside")
    print(f"{'kind':24}{'group':10}" + "".join(f"{head:>9}" for head in heads))
    for row in rows:
        counts = [f"{row['found']}/{row['faults']}", f"{row['in_class']}/{row['faults']}"]
        counts += [f"{row['found_on_right_side']}/{row['found']}", f"{row['undone']}/{row['faults']}"]
        sizes = [f"{row['removed_percent']:.0f}", f"{row['before_mm']:.1f}", f"{row['after_mm']:.1f}"]
        print(
            f"{row['kind']:24}{row['group']:10}" + "".join(f"{cell:>9}" for cell in (*counts, *sizes, row["outside"]))
        )


def add_selection(parser: argparse.ArgumentParser) -> None:
    """Arguments that say which copies."""
    parser.add_argument("--data", type=Path, default=DATA, help="the folder of recordings")
    parser.add_argument("--use", choices=SEEDS, default="choosing", help="recordings, forms and seeds for that")
    parser.add_argument("--kinds", nargs="+", default=[], help="kinds by how they begin; by default all")
    parser.add_argument("--groups", nargs="+", choices=GROUPS, default=[], help="groups; by default all")
    parser.add_argument("--recordings", nargs="+", default=[], help="names of recordings; by default all")
    parser.add_argument("--copies", type=int, default=1, help="copies of each recording and kind")
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
    table = rows(judged(asked, jobs=arguments.jobs, each=arguments.each))
    print_table(table)
    if arguments.tsv:
        result_tables.write(arguments.tsv, table)


if __name__ == "__main__":
    main()
