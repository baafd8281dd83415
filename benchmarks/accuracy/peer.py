"""Let another program find and repair the faults of `practice`, on the same copies, and print what became of them.

Reads: what practice reads. Writes: its table to stdout.

    python3.11 -m venv ../peer && ../peer/bin/pip install nimblephysics 'numpy<2'
    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.peer --python ../peer/bin/python --use reporting

The program is the marker fixer of AddBiomechanics (Werling et al. 2023, PLoS ONE 18, e0295152) with its ripple reduction. It takes
markers away that jump or accelerate too much and smooths the others a little, so a sample counts as found, and as altered, where it
is taken away or moved by 2 mm or more. It names no classes.
"""

from __future__ import annotations

import argparse
import subprocess
import tempfile
from functools import cache
from pathlib import Path

import numpy as np

from benchmarks.accuracy import practice
from benchmarks.support import result_tables
from benchmarks.support.defaults import PROJECT
from benchmarks.support.fault_outcome import altered_outside
from benchmarks.support.recording_folds import Crop, load
from markermend.core.recording import Recording

MOVED_MM = 2.0
"""A sample that the program moves by less counts as left alone."""


def fix(positions: np.ndarray, rate: float, python: Path) -> np.ndarray:
    """Positions after the marker fixer."""
    with tempfile.TemporaryDirectory() as folder:
        given, fixed = Path(folder, "given.npz"), Path(folder, "fixed.npz")
        np.savez(given, positions=positions, rate=rate)
        script = PROJECT / "benchmarks/support/marker_fixer.py"
        subprocess.run([python, script, given, fixed], check=True, capture_output=True)
        with np.load(fixed) as result:
            return np.asarray(result["positions"])


def altered(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Samples that were taken away or moved, bool (frames, markers)."""
    seen = ~np.isnan(before).any(axis=2)
    return np.asarray(seen & ~(np.linalg.norm(after - before, axis=2) < MOVED_MM))


@cache
def altered_anyway(data: Path, crop: Crop, python: Path) -> np.ndarray:
    """Samples that are altered in a recording without faults, bool (frames, markers)."""
    clean, _ = load(data, crop)
    return altered(clean.positions, fix(clean.positions, clean.rate, python))


def run(task: practice.Task, clean: Recording, python: Path) -> practice.Judged:
    """Let the program repair the faults of one copy, and judge that."""
    copy = practice.make_copy(clean, task)
    if not copy.faults:
        return practice.Judged(task, [], 0)
    after = fix(copy.positions, clean.rate, python)
    found = altered(copy.positions, after)
    outcomes = practice.judge_all(copy, {"any": found}, after)
    noticed = np.where(found[..., None], after, copy.positions)
    return practice.Judged(task, outcomes, altered_outside(copy, noticed, altered_anyway(task.data, task.crop, python)))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--python", type=Path, required=True, help="a Python that has nimblephysics")
    practice.add_selection(parser)
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    arguments = parser.parse_args()
    asked = practice.tasks(arguments)
    rows = practice.report(run(task, load(task.data, task.crop)[0], arguments.python) for task in asked)
    if arguments.tsv:
        result_tables.write(arguments.tsv, rows)


if __name__ == "__main__":
    main()
