"""How the time and memory of the stages poses and fill grow with the recordings of a subject, on a synthetic person.

Writes: a table to stdout.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.runtime.subjects

Each recording has 20 s of 41 markers at 100 Hz; one of them has 10 gaps of 1 s and is filled. Each stage is its script with the
default options in a process of its own: seconds of a core and peak memory include its start and its files.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks.support import result_tables
from benchmarks.support.defaults import OPTIONS
from benchmarks.support.fill_runs import restored, stage, walker, with_gaps
from markermend import api
from markermend.core.recording import Recording
from markermend.storage import change_file, mesh_file, stage_files

FRAMES, MARKERS, RATE, GAPS = 2_000, 41, 100, 10
COUNTS = (1, 10, 100)
PARTS = 10
"""Different recordings; more are copies of these."""


def recordings() -> list[Recording]:
    """Parts of one long recording, the first with gaps."""
    whole = walker(PARTS * FRAMES, MARKERS, RATE)
    parts = [replace(whole, positions=part) for part in np.split(whole.positions, PARTS)]
    rng = np.random.default_rng(7)
    starts = rng.integers(RATE, FRAMES - 2 * RATE, GAPS).tolist()
    gaps = [(int(m), start, start + RATE) for m, start in zip(rng.integers(0, MARKERS, GAPS), starts, strict=True)]
    return [with_gaps(parts[0], gaps), *parts[1:]]


def run(parts: Sequence[Recording], count: int) -> dict[str, object]:
    """Sample the poses of a subject with a number of recordings, and fill its first."""
    names = [f"r{number:04}" for number in range(count)]
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for number, name in enumerate(names):
            facts = {"recording": name, "kind": "dynamic", "source": {"sha256": name}}
            own = restored(replace(parts[number % PARTS], facts=facts))
            stage_files.write_recording(folder / name / "06_repaired.parquet", own, {})
        mesh = replace(api.infer_mesh([replace(parts[0], facts={"recording": names[0]})]), recordings=tuple(names))
        mesh_file.write(folder / "mesh.json", [mesh], {})
        change_file.write(folder / "06_changes.parquet", [], {})
        (folder / "list").write_text("".join(f"{folder / name / '06_repaired.parquet'}\n" for name in names))
        poses = folder / "poses.parquet"
        common: list[str | Path] = ["--mesh", folder / "mesh.json"]
        sampling = stage("poses", [*common, "--repaired", f"@{folder / 'list'}", "--poses", poses], OPTIONS["poses"])
        files: list[str | Path] = [
            "--repaired",
            folder / names[0] / "06_repaired.parquet",
            "--repairs",
            folder / "06_changes.parquet",
        ]
        files += ["--filled", folder / "07_filled.parquet", "--changes", folder / "07_changes.parquet"]
        given: list[str | Path] = ["--decisions=[]", "--code=", "--poses", *([poses] if count > 1 else [])]
        filling = stage("fill", [*common, *files, *given], OPTIONS["fill"])
        return {
            "recordings": count,
            "poses_seconds": sampling[0],
            "poses_megabytes": sampling[1],
            "file_megabytes": poses.stat().st_size / 1e6,
            "fill_seconds": filling[0],
            "fill_megabytes": filling[1],
        }


def main() -> None:
    """Parse the command line, run, print a row for each number of recordings."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--counts", nargs="+", type=int, default=COUNTS, help="numbers of recordings")
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    arguments = parser.parse_args()
    parts, rows = recordings(), []
    for count in arguments.counts:
        rows.append(run(parts, count))
        print("  ".join(f"{name} {value:.4g}" for name, value in rows[-1].items()), flush=True)
    if arguments.tsv:
        result_tables.write(arguments.tsv, rows)


if __name__ == "__main__":
    main()
