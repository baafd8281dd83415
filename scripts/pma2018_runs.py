"""Hide concurrent gaps in a recording, fill them with each method, and measure the errors (tits2018, Experiments).

Reads: PREPARED, a recording; the preset of published filling. Writes: RUNS, one row for each gap and method.
"""

import argparse
from functools import partial
from pathlib import Path

import yaml

from markermend.evaluation.jobs import run_numbers
from markermend.evaluation.option_flags import read_flag
from markermend.evaluation.pma2018 import runs
from markermend.evaluation.pma2018.jobs import PRESETS, Condition
from markermend.evaluation.pma2018.methods import published_methods
from markermend.evaluation.pma2018.options import Pma2018Options
from markermend.evaluation.table_files import write_table
from markermend.options.config import read_config
from markermend.storage import stage_files


def main(argv: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="pma2018_runs.py", description=__doc__, allow_abbrev=False)
    parser.add_argument("--prepared", type=Path, required=True, help="a recording")
    parser.add_argument("--recording", required=True, help="its name")
    parser.add_argument("--procedure", choices=PRESETS, required=True, help="what fills the gaps")
    parser.add_argument("--preset", type=Path, nargs="?", help="config of published filling; by default ours")
    parser.add_argument("--condition", type=Condition.read, required=True, help="gaps, length, duration: g3_L1_T5")
    parser.add_argument("--batch", type=run_numbers, required=True, help="the first run and the one after the last")
    parser.add_argument("--seed", type=int, required=True, help="equal seeds give equal gaps")
    parser.add_argument("--options", required=True, help="options of the experiments, as JSON")
    parser.add_argument("--runs", type=Path, required=True, help="the table of runs, to write")
    flags = parser.parse_args(argv)
    recording = stage_files.read_recording(flags.prepared)
    if flags.preset is None:
        fill = runs.default_errors
    else:
        options = read_config(yaml.safe_load(flags.preset.read_text(encoding="utf-8")))["fill"]
        own = read_flag(Pma2018Options, flags.options)
        methods = published_methods(flags.procedure, own)
        fill = partial(runs.published_errors, methods=methods, options=options)
    job = runs.Job(flags.recording, flags.procedure, flags.condition)
    write_table(flags.runs, runs.run_rows(recording, job, fill, runs=flags.batch, seed=flags.seed))


if __name__ == "__main__":
    main()
