"""Fill gaps whose truth is known through the whole workflow, C3D in and C3D out, and compare with the predictors alone.

Reads: as benchmarks/accuracy/gaps.py.
Writes: C3D files with gaps and results below a temporary folder (or --folder); a table to stdout.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.gaps_workflow --iterations 1 --cores 2

Each case becomes a subject of its own: a copy of the recording whose samples in the gaps are marked as missing. What
the workflow writes into the cleaned file is compared with the truth, and so is what benchmarks/accuracy/gaps.py fills. Detection is
off, and the rules of what may be filled are lifted, as there.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from collections import defaultdict
from dataclasses import replace
from pathlib import Path

import numpy as np
import yaml

from benchmarks.support.defaults import DATA, OPTIONS, PROJECT
from benchmarks.support.gap_cases import LIFTED, Case, FilledGap, fill_case, load, score
from markermend.formats import files
from markermend.options.config import write_config

UNLABELLED = OPTIONS["ingest"].unlabelled


def write_case(folder: Path, case: Case, target: Path) -> None:
    """Write the recording of a case with its gaps."""
    (original,) = Path(folder, "clean").glob(f"{case['seq']}*")
    reading = files.read(original, unlabelled=UNLABELLED, rate=None)
    positions = reading.recording.positions.copy()
    hidden = np.zeros(positions.shape[:2], bool)
    for marker, start, stop in case["gaps"]:
        hidden[start:stop, marker] = True
    positions[hidden] = np.nan
    target.parent.mkdir(parents=True)
    files.write_back(
        original, target, format=reading.format, positions=positions, changed=hidden, columns=reading.columns
    )


def run(recordings: Path, results: Path, cores: int) -> None:
    """Run the workflow over the cases."""
    lifted = write_config({**OPTIONS, "fill": replace(OPTIONS["fill"], **LIFTED)})
    study = {**lifted, "recordings": str(recordings), "results": str(results), "detect": []}
    path = results.with_suffix(".yaml")
    path.write_text(yaml.safe_dump(study), encoding="utf-8")
    command: list[str | Path] = [
        Path(sys.executable).with_name("snakemake"),
        "--cores",
        str(cores),
        "--configfile",
        path,
    ]
    subprocess.run([*command, "--quiet", "rules", "progress"], cwd=PROJECT, check=True)


def compare(folder: Path, case: Case, results: Path) -> tuple[float, float, float]:
    """Errors of a case, mm: by the predictors alone, by the workflow; and how far apart the two are at most."""
    _, _, alone = fill_case(str(folder), case, OPTIONS["fill"].members)
    (cleaned,) = results.glob(f"cleaned/{case['seq']}_{case['cond']}_{case['it']}/*.c3d")
    written = files.read(cleaned, unlabelled=UNLABELLED, rate=None).recording
    truth, through = load(str(folder), case["seq"]), []
    for marker, start, stop in case["gaps"]:
        place = slice(start, stop), marker
        offsets = (written.positions - truth.positions)[place][~truth.missing[place]]
        nothing = np.empty(0)
        through.append(FilledGap(offsets, nothing, nothing, False))
    apart = max(np.abs(a.offsets - b.offsets).max(initial=0.0) for a, b in zip(alone, through, strict=True))
    return score(case["cond"], alone), score(case["cond"], through), float(apart)


def main() -> None:
    """Parse the command line, write the cases, run, compare, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", default=DATA, type=Path, help="folder that holds clean/")
    parser.add_argument("--cases", type=Path, help="cases.json (default: next to --data)")
    parser.add_argument("--conditions", nargs="+", help="only these, such as g3_L1 sp2_50")
    parser.add_argument("--iterations", type=int, help="number of cases of each condition; all by default")
    parser.add_argument("--cores", type=int, default=1)
    parser.add_argument("--folder", type=Path, help="keep files and results here")
    arguments = parser.parse_args()
    path = arguments.cases or arguments.data.parent / "bench/gaps/cases.json"
    cases = json.loads(path.read_text(encoding="utf-8"))
    cases = [case for case in cases if not arguments.conditions or case["cond"] in arguments.conditions]
    cases = [case for case in cases if arguments.iterations is None or case["it"] < arguments.iterations]
    with tempfile.TemporaryDirectory() as temporary:
        folder = (arguments.folder or Path(temporary)).resolve()
        for case in cases:
            name = f"{case['seq']}_{case['cond']}_{case['it']}"
            write_case(arguments.data, case, folder / "recordings" / name / f"{case['seq']}.c3d")
        run(folder / "recordings", folder / "results", arguments.cores)
        errors: dict[str, list[tuple[float, float, float]]] = defaultdict(list)
        for case in cases:
            errors[case["cond"]].append(compare(arguments.data, case, folder / "results"))
    print(f"{'condition':10} {'cases':>5} {'alone, mm':>10} {'workflow':>9} {'apart at most':>13}")
    for condition, found in sorted(errors.items()):
        alone, through, apart = np.array(found).T
        print(f"{condition:10} {len(found):5} {alone.mean():10.4f} {through.mean():9.4f} {apart.max():13.4f}")


if __name__ == "__main__":
    main()
