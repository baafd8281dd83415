"""What each member is worth: fill known gaps with the default members, with one more, with one fewer, and with one alone.

Reads: as benchmarks/accuracy/gaps.py.
Writes: a table to stdout: mean over the conditions of the error with other members, in units of that with the default
ones.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.members --iterations 2 --jobs 2
    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.members --members network_linear bolero --iterations 1 --jobs 2

A member that is added should never make the mean error larger by more than 2 %. The seconds are those that a gap costs
with the member alone, pseudo-gaps included, for weighing what it costs against what it brings.
"""

from __future__ import annotations

import argparse
import json
from collections import defaultdict
from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

from benchmarks.support import result_tables
from benchmarks.support.defaults import DATA, OPTIONS
from benchmarks.support.gap_cases import Case, fill_case, score
from markermend.prediction.neural_network.predictor import KINDS as NETWORKS
from markermend.prediction.registry import known_members

CONDITIONS = ("g1_L1", "g3_L0.5", "g3_L2", "g6_L1", "sp2_10", "sp2_50", "sp2_200")
SLOW = ("replicated_network", "bolero", *NETWORKS)
"""Tried only where they are named: they train for seconds to minutes per gap."""


def try_members(
    pool: ProcessPoolExecutor, folder: str, cases: Sequence[Case], names: Sequence[str]
) -> tuple[dict[str, np.ndarray], float]:
    """Mean error by condition, mm, and seconds per gap, with the named members."""
    errors: dict[str, list[float]] = defaultdict(list)
    seconds, gaps = 0.0, 0
    for case, spent, found in pool.map(fill_case, [folder] * len(cases), cases, [tuple(names)] * len(cases)):
        error = score(case["cond"], found)
        errors[case["cond"]].append(error)
        seconds, gaps = seconds + spent[1], gaps + len(found)
    return {condition: np.array(each) for condition, each in errors.items()}, seconds / gaps


def compared(errors: Mapping[str, np.ndarray], usual: Mapping[str, np.ndarray]) -> tuple[float, float]:
    """Mean over the conditions of the ratio of mean errors, over the cases that both filled whole; and its largest."""
    ratios = []
    for condition, each in errors.items():
        both = np.isfinite(each) & np.isfinite(usual[condition])
        if both.any():
            ratios.append(each[both].mean() / usual[condition][both].mean())
    return (float(np.mean(ratios)), float(np.max(ratios))) if ratios else (np.nan, np.nan)


def main() -> None:
    """Parse the command line, fill, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", default=DATA, type=Path, help="folder that holds clean/")
    parser.add_argument("--cases", type=Path, help="cases.json (default: next to --data)")
    parser.add_argument("--members", nargs="+", help="only these (default: all but the slowest)")
    parser.add_argument("--conditions", nargs="+", default=CONDITIONS, help="such as g3_L1 sp2_50")
    parser.add_argument("--iterations", type=int, default=1, help="number of cases of each condition")
    parser.add_argument("--jobs", type=int, default=1, help="processes, of one thread each")
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    arguments = parser.parse_args()
    path = arguments.cases or arguments.data.parent / "bench/gaps/cases.json"
    cases = json.loads(path.read_text(encoding="utf-8"))
    cases = [case for case in cases if case["cond"] in arguments.conditions and case["it"] < arguments.iterations]
    default = list(OPTIONS["fill"].members)
    known = [*known_members(OPTIONS["predictors"])]
    wanted = arguments.members or [name for name in known if name not in SLOW]
    with ProcessPoolExecutor(arguments.jobs) as pool:
        usual, seconds = try_members(pool, str(arguments.data), cases, default)
        print(f"{len(cases)} cases; default members: {', '.join(default)}; {seconds:.2f} s per gap")
        print(f"{'member':20} {'change':8} {'error':>6} {'worst condition':>16} {'alone':>7} {'s per gap':>10}")
        rows = []
        for name in wanted:
            others = [other for other in default if other != name] if name in default else [*default, name]
            mean, worst = compared(try_members(pool, str(arguments.data), cases, others)[0], usual)
            errors, seconds = try_members(pool, str(arguments.data), cases, [name])
            change = "without" if name in default else "with"
            alone = compared(errors, usual)[0]
            print(f"{name:20} {change:8} {mean:6.3f} {worst:16.3f} {alone:7.2f} {seconds:10.2f}", flush=True)
            rows.append(
                {
                    "member": name,
                    "change": change,
                    "error_ratio": mean,
                    "worst_condition_ratio": worst,
                    "alone_ratio": alone,
                    "seconds_per_gap": seconds,
                }
            )
    if arguments.tsv:
        result_tables.write(arguments.tsv, rows)


if __name__ == "__main__":
    main()
