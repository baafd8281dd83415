"""Fill the gaps of the benchmark as tits2018 does and print our errors next to those of its released program on the same gaps.

Reads: cases.json and programs.json (made gaps, and what programs made of them), the recordings that they name, a preset.
Writes: the ratio of the errors by condition to stdout, and every case to a table.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.published_pma --iterations 4

The presets published_pma_code and published_pma_text are compared with the columns pma5 and pma4 (models 1-5 and 1-4); --members
names one model, to be compared with its own column (m1_li, m2_lp, m3_grnn, m4_gwlr). Every marker is a neighbour of every other, as
in the paper. The program draws its training frames at random, so that single cases differ.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from benchmarks.support import result_tables
from benchmarks.support.defaults import DATA, PROJECT
from benchmarks.support.gap_cases import Case, fill_hidden, load, offsets, score
from markermend.filling.fill_ensembles import make_ensembles
from markermend.options.config import read_config
from markermend.options.filling import FillOptions


def published_options(preset: str, members: Iterable[str]) -> FillOptions:
    """The options of filling of a preset, with other members if any are named."""
    config = yaml.safe_load((PROJECT / f"config/presets/{preset}.yaml").read_text(encoding="utf-8"))
    if members := list(members):
        config["fill"]["members"] = members
    fill: FillOptions = read_config(config)["fill"]
    return fill


def error_of(case: Case, folder: str, options: FillOptions) -> float:
    """The error of a case, mm, by the measure of its protocol."""
    whole = load(folder, case["seq"])
    markers = np.arange(len(whole.markers))
    neighbours = [np.delete(markers, marker) for marker in markers]
    filled = fill_hidden(whole, case["gaps"], neighbours, options, make_ensembles(options))
    return score(case["cond"], offsets(whole, filled, case))


def print_ratios(rows: Iterable[dict[str, Any]]) -> None:
    """By condition, and over all: both mean errors, the ratio of the means, and the geometric mean of the ratios of the cases."""
    known = [
        row for row in rows if row["theirs_mm"] is not None and np.isfinite([row["ours_mm"], row["theirs_mm"]]).all()
    ]
    print(f"{'condition':10} {'cases':>5} {'ours':>7} {'theirs':>7} {'of means':>8} {'geometric':>9}")
    for condition in [*sorted({row["condition"] for row in known}), "all"]:
        own = [row for row in known if condition in (row["condition"], "all")]
        errors = np.array([[row["ours_mm"], row["theirs_mm"]] for row in own])
        ours, theirs = errors.mean(axis=0)
        geometric = np.exp(np.log(errors[:, 0] / errors[:, 1]).mean())
        print(
            f"{condition:10} {len(own):5} {ours:7.2f} {theirs:7.2f} {ours / theirs:8.3f} {geometric:9.3f}", flush=True
        )


def main() -> None:
    """Parse the command line, fill, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", default=DATA, type=Path, help="folder that holds clean/; bench/ lies next to it")
    parser.add_argument("--preset", default="published_pma_code", help="file of config/presets, without .yaml")
    parser.add_argument("--program", default="pma5", help="column of programs.json")
    parser.add_argument("--members", nargs="+", default=[], help="in place of the preset's")
    parser.add_argument("--recordings", nargs="+", default=["85_02", "85_12", "HDM_mm"])
    parser.add_argument("--conditions", nargs="+", default=["g3_L0.5", "g3_L1", "g3_L2", "g3_L5", "g10_L1", "g10_L5"])
    parser.add_argument("--iterations", type=int, default=4, help="number of cases of each condition")
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    arguments = parser.parse_args()
    folder = arguments.data.parent / "bench/gaps"
    theirs = json.loads((folder / "programs.json").read_text(encoding="utf-8"))[arguments.program]
    options = published_options(arguments.preset, arguments.members)
    rows = []
    for case in json.loads((folder / "cases.json").read_text(encoding="utf-8")):
        key = f"{case['seq']}/{case['cond']}_{case['it']}"
        wanted = case["seq"] in arguments.recordings and case["cond"] in arguments.conditions
        if not wanted or case["it"] >= arguments.iterations or key not in theirs:
            continue
        measure = "rmse" if case["cond"].startswith("sp") else "error"
        row = {
            "recording": case["seq"],
            "condition": case["cond"],
            "iteration": case["it"],
            "program": arguments.program,
        }
        rows.append(row | {"ours_mm": error_of(case, str(arguments.data), options), "theirs_mm": theirs[key][measure]})
        if arguments.tsv:
            result_tables.write(arguments.tsv, rows)
    print_ratios(rows)


if __name__ == "__main__":
    main()
