"""Hide gaps in a clean recording, fill them by some methods, and measure the errors (skurowski2021).

Reads: SUBJECT, the clean recordings of a subject, from which the mesh is inferred. Writes: RUNS, one row for each gap and method.
"""

import argparse
from pathlib import Path

from markermend.evaluation.gaps2021 import runs
from markermend.evaluation.gaps2021.drawn import make_runs
from markermend.evaluation.gaps2021.methods import GROUPS
from markermend.evaluation.gaps2021.options import Gaps2021Options
from markermend.evaluation.jobs import run_numbers
from markermend.evaluation.option_flags import read_flag
from markermend.evaluation.table_files import write_table
from markermend.storage import stage_files


def main(argv: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="gaps2021_runs.py", description=__doc__, allow_abbrev=False)
    parser.add_argument("--subject", type=Path, nargs="+", required=True, help="clean recordings, NAME.parquet")
    parser.add_argument("--recording", required=True, help="name of the one that is filled")
    parser.add_argument("--methods", choices=GROUPS, required=True, help="what fills the gaps")
    parser.add_argument(
        "--batch", type=run_numbers, required=True, help="the first run and the one after the last: 0-20"
    )
    parser.add_argument("--seed", type=int, required=True, help="equal seeds give equal gaps")
    parser.add_argument("--options", required=True, help="options of the experiment, as JSON")
    parser.add_argument("--runs", type=Path, required=True, help="the table of runs, to write")
    flags = parser.parse_args(argv)
    options = read_flag(Gaps2021Options, flags.options)
    subject = {path.stem: runs.prepare(stage_files.read_recording(path), options) for path in flags.subject}
    clean = subject[flags.recording]
    mesh = runs.subject_mesh(flags.recording, subject)
    drawn = make_runs(flags.recording, clean, options, numbers=flags.batch, seed=flags.seed)
    table = runs.run_rows(clean, drawn, mesh, GROUPS[flags.methods], options)
    table.insert(0, "recording", flags.recording)
    write_table(flags.runs, table)


if __name__ == "__main__":
    main()
