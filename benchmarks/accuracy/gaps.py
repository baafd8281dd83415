"""Fill gaps whose truth is known and print our errors next to those of other programs on the very same gaps.

Reads: cases.json and programs.json (made gaps, and what programs made of them), the recordings that they name.
Writes: tables to stdout.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.gaps --jobs 2

Options are those of config/config.yaml, the mesh is inferred from each recording with its gaps. Only the rules of what
may be filled are lifted: every gap counts. Protocol A (conditions g3_L1: 3 concurrent gaps of 1 s) is judged by the
mean distance, mm; protocol B (sp2_50: 2 gaps of mean length 50 frames anywhere) by the root mean square per coordinate,
mm.
"""

from __future__ import annotations

import argparse
import json
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.support import result_tables
from benchmarks.support.defaults import DATA, OPTIONS
from benchmarks.support.gap_cases import FilledCase, FilledGap, error_spread, fill_case, read_changes, score

Programs = dict[str, dict[str, dict[str, Any]]]
"""Errors and seconds of other programs by program and case."""


def print_errors(ours: Mapping[str, tuple[str, float]], programs: Programs, title: str) -> None:
    """Per condition: our mean error, and for each program its mean, ours on the cases that it has, and the ratio."""
    print(
        f"\n{title}\nmean error, mm; each program: its error (ours on its cases), by how much ours is smaller or larger"
    )
    ratios: dict[str, dict[str, float]] = defaultdict(dict)
    for condition in sorted({condition for condition, _ in ours.values()}):
        mine = {key: error for key, (own, error) in ours.items() if own == condition}
        key = "rmse" if condition.startswith("sp") else "error"
        left = sum(not np.isfinite(error) for error in mine.values())
        note = f"; {left} of them not filled whole, and left out" if left else ""
        print(f"{condition:10} ours {np.nanmean(list(mine.values())):7.2f} ({len(mine)} cases{note})")
        for program, results in programs.items():
            both = [(mine[case], results[case][key]) for case in mine if results.get(case, {}).get(key) is not None]
            both = [pair for pair in both if np.isfinite(pair).all()]
            if not both:
                continue
            own, theirs = np.mean(both, axis=0)
            ratios[program][condition] = own / theirs
            print(f"    {program:12} {theirs:8.2f} ({own:7.2f}) ratio {own / theirs:6.3f} on {len(both):3} cases")
    print(f"\n{'program':12} {'mean ratio A':>12} {'mean ratio B':>12} {'worst':>7} condition")
    for program, own in ratios.items():
        means = [[own[name] for name in own if name.startswith("sp") == late] for late in (False, True)]
        worst = max(own, key=own.__getitem__)
        shown = [f"{np.mean(mean):12.3f}" if mean else f"{'':12}" for mean in means]
        print(f"{program:12} {' '.join(shown)} {own[worst]:7.3f} {worst}")


def print_calibration(cases: Iterable[FilledCase]) -> None:
    """Share of the true positions within the stated balls, %, and spread of the stated errors, by recording and condition.

    By number of gaps at once, too, and over all.
    """
    found: dict[tuple[str, str], list[FilledGap]] = defaultdict(list)
    for case, _, gaps in cases:
        condition, whole = case["cond"], "every recording"
        number = f"{len(gaps):2} gaps"
        for group in (
            (case["seq"], condition),
            (whole, condition),
            (whole, number),
            (case["seq"], "all"),
            (whole, "all"),
        ):
            found[group] += gaps
    print(
        "\ntrue positions within error and error95, %; spread: standard deviation of the logarithm of error / stated error"
    )
    print(f"{'recording':16} {'condition':10} {'68':>6} {'95':>6} {'spread':>6} {'n':>8}")
    for (name, condition), own in sorted(found.items()):
        distance = np.concatenate([np.linalg.norm(gap.offsets, axis=1) for gap in own])
        balls = [np.concatenate([gap.error for gap in own]), np.concatenate([gap.error95 for gap in own])]
        low, high = (100 * (distance <= ball).mean() for ball in balls)
        spread = error_spread([np.linalg.norm(gap.offsets, axis=1) for gap in own], [gap.error for gap in own])
        print(f"{name:16} {condition:10} {low:6.1f} {high:6.1f} {spread:6.2f} {len(distance):8}")


def print_seconds(cases: Iterable[FilledCase], programs: Programs) -> None:
    """Per condition: our seconds of a core for the mesh and for filling, and the seconds of PMA where it was run."""
    spent: dict[str, list[tuple[float, float, float]]] = defaultdict(list)
    for case, seconds, _ in cases:
        theirs = programs["pma5"].get(f"{case['seq']}/{case['cond']}_{case['it']}", {}).get("seconds", np.nan)
        spent[case["cond"]].append((*seconds, theirs))
    print(f"\nseconds per recording\n{'condition':10} {'mesh':>6} {'fill':>6} {'pma5':>6} {'times as long':>14}")
    for condition, rows in sorted(spent.items()):
        timed = np.array([row for row in rows if np.isfinite(row[2])]).reshape(-1, 3)
        if len(timed):
            mesh, fill, theirs = timed.mean(axis=0)
            print(f"{condition:10} {mesh:6.2f} {fill:6.2f} {theirs:6.1f} {theirs / (mesh + fill):14.1f}")


def rows(cases: Sequence[FilledCase]) -> list[dict[str, object]]:
    """Mean error of each condition, mm, with the number of cases that were filled whole, and seconds per recording."""
    found = []
    for condition in sorted({case["cond"] for case, _, _ in cases}):
        own = [each for each in cases if each.case["cond"] == condition]
        errors = np.array([score(condition, each.gaps) for each in own])
        seconds = float(np.mean([sum(each.seconds) for each in own]))
        complete = np.isfinite(errors)
        error = float(errors[complete].mean()) if complete.any() else None
        found.append({"condition": condition, "cases": int(complete.sum()), "error_mm": error, "seconds": seconds})
    return found


def main() -> None:
    """Parse the command line, fill, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", default=DATA, type=Path, help="folder that holds clean/")
    parser.add_argument(
        "--cases", type=Path, help="cases.json; programs.json lies next to it (default: next to --data)"
    )
    parser.add_argument("--members", nargs="+", default=OPTIONS["fill"].members, help="in place of the config's")
    parser.add_argument(
        "--set",
        nargs="+",
        default=[],
        metavar="KEY=VALUE",
        help="other options of advanced.fill.ensemble, such as weights=pma or distances.spacing_rounds=5",
    )
    parser.add_argument("--conditions", nargs="+", help="only these, such as g3_L1 sp2_50")
    parser.add_argument("--iterations", type=int, help="number of cases of each condition; all by default")
    parser.add_argument("--jobs", type=int, default=1, help="processes, of one thread each")
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    arguments = parser.parse_args()
    path = arguments.cases or arguments.data.parent / "bench/gaps/cases.json"
    cases = json.loads(path.read_text(encoding="utf-8"))
    programs = json.loads(path.with_name("programs.json").read_text(encoding="utf-8"))
    cases = [case for case in cases if not arguments.conditions or case["cond"] in arguments.conditions]
    cases = [case for case in cases if arguments.iterations is None or case["it"] < arguments.iterations]
    names, folder = tuple(arguments.members), str(arguments.data)
    changes = read_changes(arguments.set)
    with ProcessPoolExecutor(arguments.jobs) as pool:
        done = list(pool.map(partial(fill_case, folder, names=names, changes=changes), cases))
    for title, kept in (("all markers", False), ("without the rigidly fitted markers of HDM05", True)):
        ours = {}
        for case, _, gaps in done:
            if kept and any(gap.fitted for gap in gaps):
                continue
            condition = case["cond"]
            ours[f"{case['seq']}/{condition}_{case['it']}"] = condition, score(condition, gaps)
        print_errors(ours, programs, title)
    print_calibration(done)
    print_seconds(done, programs)
    if arguments.tsv:
        result_tables.write(arguments.tsv, rows(done))
    mesh, fill = np.array([seconds for _, seconds, _ in done]).sum(axis=0)
    count = sum(len(own) for _, _, own in done)
    print(f"\n{len(done)} cases, {count} gaps: fill {fill:.0f} s ({fill / count:.2f} s per gap), mesh {mesh:.0f} s")


if __name__ == "__main__":
    main()
