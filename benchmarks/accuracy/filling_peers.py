"""Fill gaps whose truth is known by the default and by its peers: LWPCA, Tucker completion, published model averaging, single predictors.

Reads: recordings in clean/; for --protocol bench also cases.json. Writes: a table to stdout.

    python3.11 -m venv ../tensorly && ../tensorly/bin/pip install tensorly
    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.filling_peers --tensorly ../tensorly/bin/python

--protocol lwpca repeats the experiment of Kieu et al. (2022) on other recordings (`benchmarks.support.long_gaps`); --protocol bench fills
the cases of `benchmarks.accuracy.gaps`. Errors are means over the cases that the peer and the default both filled whole. Without
--tensorly Tucker completion is left out.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.support import filling_peers, gap_cases, long_gaps, result_tables
from benchmarks.support.defaults import DATA
from benchmarks.support.filling_peers import PREDICTORS, Peer
from benchmarks.support.gap_cases import Gap
from markermend.core.recording import Recording

DEFAULT = "default"
"""Name of our own filling in the table."""


@dataclass(frozen=True)
class Case:
    """A recording, the gaps (marker, start, stop) to hide in it, and the group in which its errors are averaged."""

    group: str
    whole: Recording
    gaps: list[Gap]


@dataclass(frozen=True)
class Outcome:
    """What a peer made of a case: its errors, mm, NaN where a sample stayed open, and the seconds of a core without child processes.

    absolute: mean absolute error of a coordinate; distance: mean distance from the truth; rms: root mean square of a coordinate.
    """

    absolute: float
    distance: float
    rms: float
    seconds: float


def long_cases(data: Path, recordings: list[str], seeds: list[int]) -> Iterator[Case]:
    """The cases of the protocol of Kieu et al."""
    for case in long_gaps.cases(data, recordings, long_gaps.COUNTS, seeds):
        yield Case(f"{case.name} {case.count}", case.whole, case.gaps)


def bench_cases(data: Path, recordings: list[str], iterations: list[int]) -> Iterator[Case]:
    """The cases of the benchmark of gaps."""
    path = data.parent / "bench/gaps/cases.json"
    for case in json.loads(path.read_text(encoding="utf-8")):
        if case["it"] in iterations and any(case["seq"].startswith(name) for name in recordings):
            yield Case(case["cond"], gap_cases.load(str(data), case["seq"]), [tuple(gap) for gap in case["gaps"]])


def judge(peer: Peer, case: Case) -> Outcome:
    """Fill a case and measure the errors."""
    started = time.process_time()
    filled = peer(case.whole, case.gaps)
    seconds = time.process_time() - started
    hidden = np.zeros(case.whole.missing.shape, bool)
    for marker, start, stop in case.gaps:
        hidden[start:stop, marker] = True
    offsets = (filled - case.whole.positions)[hidden & ~case.whole.missing]
    return Outcome(
        float(np.abs(offsets).mean()),
        float(np.linalg.norm(offsets, axis=1).mean()),
        float(np.sqrt((offsets**2).mean())),
        seconds,
    )


def rows(group: str, outcomes: Mapping[str, list[Outcome]]) -> Iterator[dict[str, Any]]:
    """A row for each peer: its errors and ours over the cases that both filled whole, mm, their ratio, and seconds a case."""
    ours = outcomes[DEFAULT]
    for name, own in outcomes.items():
        pairs = [(theirs, our) for theirs, our in zip(own, ours, strict=True) if np.isfinite(theirs.rms + our.rms)]
        errors = np.array([[each.absolute, each.distance, each.rms, our.absolute] for each, our in pairs])
        means = errors.mean(axis=0) if pairs else np.full(4, np.nan)
        yield {
            "group": group,
            "peer": name,
            "cases": len(pairs),
            "absolute_mm": float(means[0]),
            "distance_mm": float(means[1]),
            "rms_mm": float(means[2]),
            "default_absolute_mm": float(means[3]),
            "ratio": float(means[3] / means[0]),
            "seconds": float(np.mean([each.seconds for each in own])),
        }


def summary(found: Iterable[Mapping[str, Any]]) -> Iterator[dict[str, Any]]:
    """By peer: the mean over the groups of the ratio of our error to the peer's, and the largest."""
    table = list(found)
    for name in dict.fromkeys(row["peer"] for row in table):
        own = [row for row in table if row["peer"] == name and np.isfinite(row["ratio"])]
        if own:
            worst = max(own, key=lambda row: row["ratio"])
            mean = float(np.mean([row["ratio"] for row in own]))
            yield {"peer": name, "mean_ratio": mean, "worst_ratio": worst["ratio"], "worst_group": worst["group"]}


def peers(names: list[str] | None, tensorly: Path | None) -> dict[str, Peer]:
    """The peers by name, the default first."""
    every: dict[str, Peer] = {DEFAULT: filling_peers.default, "lwpca": filling_peers.lwpca_regression}
    if tensorly:
        every["tucker"] = filling_peers.tucker_completion(tensorly)
    else:
        print("tucker: left out, since no --tensorly is given")
    every["published_pma"] = filling_peers.published_averaging
    every |= {name: filling_peers.predictors((name,)) for name in PREDICTORS}
    return {name: peer for name, peer in every.items() if name == DEFAULT or names is None or name in names}


def main() -> None:
    """Parse the command line, fill, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", default=DATA, type=Path, help="folder that holds clean/; bench/ lies next to it")
    parser.add_argument("--protocol", choices=("lwpca", "bench"), default="lwpca")
    parser.add_argument("--tensorly", type=Path, help="a Python that has tensorly")
    parser.add_argument("--peers", nargs="+", help="only these; all by default")
    parser.add_argument("--recordings", nargs="+", help="only these")
    parser.add_argument("--runs", nargs="+", type=int, default=[0, 1], help="seeds of lwpca, iterations of bench")
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    arguments = parser.parse_args()
    known = long_gaps.RECORDINGS if arguments.protocol == "lwpca" else ("85_02", "85_12", "HDM_mm")
    draw = long_cases if arguments.protocol == "lwpca" else bench_cases
    groups: dict[str, list[Case]] = {}
    for case in draw(arguments.data, arguments.recordings or list(known), arguments.runs):
        groups.setdefault(case.group, []).append(case)
    asked = peers(arguments.peers, arguments.tensorly)
    print(f"{'group':14} {'peer':20} {'cases':>5} {'absolute':>9} {'distance':>9} {'rms':>8} {'ours':>8} {'ratio':>6}")
    found = []
    for group, cases in groups.items():
        for row in rows(group, {name: [judge(peer, case) for case in cases] for name, peer in asked.items()}):
            errors = f"{row['absolute_mm']:9.2f} {row['distance_mm']:9.2f} {row['rms_mm']:8.2f}"
            ours = f"{row['default_absolute_mm']:8.2f} {row['ratio']:6.3f}"
            print(f"{group:14} {row['peer']:20} {row['cases']:5} {errors} {ours}", flush=True)
            found.append(row)
        if arguments.tsv:
            result_tables.write(arguments.tsv, found)
    print(f"\n{'peer':20} {'mean ratio':>10} {'worst':>7} group")
    for row in summary(found):
        print(f"{row['peer']:20} {row['mean_ratio']:10.3f} {row['worst_ratio']:7.3f} {row['worst_group']}")


if __name__ == "__main__":
    main()
