"""Contaminate a clean recording as the artifact detection paper did, detect, and count samples by class (skurowski2022, E1).

Reads: PREPARED, a clean recording. Writes: RUNS, one row for each true and found class of each run.
"""

import argparse
from pathlib import Path

from markermend.evaluation.artifacts2022 import runs
from markermend.evaluation.artifacts2022.options import Artifacts2022Options
from markermend.evaluation.jobs import run_numbers
from markermend.evaluation.options import read_flag
from markermend.evaluation.recordings import denoise
from markermend.evaluation.table_files import write_table
from markermend.storage import stage_files


def main(argv: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="artifacts2022_runs.py", description=__doc__, allow_abbrev=False)
    parser.add_argument("--prepared", type=Path, required=True, help="a clean recording")
    parser.add_argument("--recording", required=True, help="its name")
    parser.add_argument("--preset", required=True, help="the detectors")
    parser.add_argument("--amplitude-mm", type=float, required=True, help="mean amplitude, mm")
    parser.add_argument("--share-percent", type=float, required=True, help="share of the time for each class, %%")
    parser.add_argument(
        "--batch", type=run_numbers, required=True, help="the first run and the one after the last: 0-20"
    )
    parser.add_argument("--seed", type=int, required=True, help="equal seeds give equal tables")
    parser.add_argument("--options", required=True, help="options of the experiments, as JSON")
    parser.add_argument("--runs", type=Path, required=True, help="the table of runs, to write")
    flags = parser.parse_args(argv)
    options = read_flag(Artifacts2022Options, flags.options)
    condition = runs.Condition(flags.preset, flags.amplitude_mm, flags.share_percent)
    clean = denoise(stage_files.read_recording(flags.prepared), cutoff_hz=options.denoise_hz)
    counts = [
        (run, runs.count_run(clean, condition, rng=runs.run_generator(flags.seed, flags.recording, condition, run)))
        for run in flags.batch
    ]
    write_table(flags.runs, runs.run_rows(flags.recording, condition, counts))


if __name__ == "__main__":
    main()
