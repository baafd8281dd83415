"""Put the results of `practice` before and after a change, and those of the peer, side by side, by kind of fault.

Reads: tables of practice.py and peer.py as in benchmarks/results. Writes: a table in Markdown to stdout.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.practice_table practice_before.tsv practice.tsv peer.tsv --groups calm

found: of the faults, in findings of any class, before, now (in the right class in brackets) and by the peer; error: root mean
square over faults in mm, as they are, and after repair, before, now and by the peer. Only kinds and groups of the second table.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np

from benchmarks.support import result_tables
from benchmarks.support.defaults import PROJECT
from benchmarks.support.recording_folds import GROUPS

RESULTS = PROJECT / "benchmarks/results"
"""Where tables that are named without a folder are."""

COUNTS = ("faults", "found", "in_class")
"""Columns that are added up over groups."""


def pooled(rows: Iterable[Mapping[str, str]], keys: Sequence[tuple[str, str]]) -> dict[str, float]:
    """The figures of some kinds and groups together: counts added up, errors by root mean square over faults."""
    own = [row for row in rows if (row["kind"], row["group"]) in keys]
    figures = {name: float(sum(int(row[name]) for row in own)) for name in COUNTS}
    for name in ("before_mm", "after_mm"):
        pairs = [(float(row[name]), int(row["faults"])) for row in own if row[name]]
        count = sum(faults for _, faults in pairs)
        square = sum(error**2 * faults for error, faults in pairs)
        figures[name] = float(np.sqrt(square / count)) if count else float("nan")
    return figures


def line(kind: str, before: Mapping[str, float], now: Mapping[str, float], peer: Mapping[str, float]) -> str:
    """The row of one kind."""
    found = [share(before, "found"), f"{share(now, 'found')} ({now['in_class']:.0f})", share(peer, "found")]
    errors = [now["before_mm"], before["after_mm"], now["after_mm"], peer["after_mm"]]
    return "| " + " | ".join([kind, *found, *("" if error != error else f"{error:.3g}" for error in errors)]) + " |"


def share(figures: Mapping[str, float], name: str) -> str:
    """A count of faults, "3 of 4"; empty where there were none."""
    return f"{figures[name]:.0f} of {figures['faults']:.0f}" if figures["faults"] else ""


def main() -> None:
    """Parse the command line and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tables", type=Path, nargs=3, help="before, now, peer")
    parser.add_argument(
        "--groups", nargs="+", choices=GROUPS, default=GROUPS, help="groups of recordings; by default all"
    )
    arguments = parser.parse_args()
    paths = [path if path.exists() else RESULTS / path for path in arguments.tables]
    before, now, peer = (result_tables.read(path) for path in paths)
    print("| kind | found: before | now (class) | peer | error, mm | repaired: before | now | peer |")
    print("|---|---|---|---|---|---|---|---|")
    for kind in dict.fromkeys(row["kind"] for row in now):
        keys = [(kind, row["group"]) for row in now if row["kind"] == kind and row["group"] in arguments.groups]
        if keys:
            print(line(kind, pooled(before, keys), pooled(now, keys), pooled(peer, keys)))


if __name__ == "__main__":
    main()
