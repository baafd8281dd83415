"""Contaminate a clean recording as the artifact detection paper did, detect, and count samples by class (skurowski2022, E1).

Reads: a clean recording. Writes: RUNS, one row for each true and found class of each run.
"""

import argparse
from pathlib import Path

from markermend import api
from markermend.evaluation import artifact_classification as classification
from markermend.storage import atomic


def main(argv: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="artifacts2022_runs.py", description=__doc__, allow_abbrev=False)
    parser.add_argument("--recording", type=Path, required=True, help="a clean recording")
    parser.add_argument("--runs", type=Path, required=True, help="the table of runs, to write")
    parser.add_argument("--preset", choices=("paper", "default", "coordinates"), required=True, help="the detectors")
    parser.add_argument("--amplitude-mm", type=float, required=True, help="mean amplitude, mm")
    parser.add_argument("--share-percent", type=float, required=True, help="share of the time for each class, %%")
    parser.add_argument("--first-run", type=int, required=True, help="number of the first run")
    parser.add_argument("--count", type=int, required=True, help="number of runs")
    parser.add_argument("--seed", type=int, required=True, help="equal seeds give equal tables")
    parser.add_argument("--denoise-hz", type=float, help="low-pass the recording at this frequency before")
    flags = parser.parse_args(argv)
    condition = classification.Condition(flags.preset, flags.amplitude_mm, flags.share_percent)
    clean = api.read(flags.recording, kind="dynamic")
    if flags.denoise_hz:
        clean = classification.denoise(clean, cutoff_hz=flags.denoise_hz)
    numbers = range(flags.first_run, flags.first_run + flags.count)
    counts = [(run, classification.count_run(clean, condition, run=run, seed=flags.seed)) for run in numbers]
    table = classification.run_rows(flags.recording.stem, condition, counts)
    atomic.write_text(flags.runs, table.to_csv(sep="\t", index=False, lineterminator="\n"))


if __name__ == "__main__":
    main()
