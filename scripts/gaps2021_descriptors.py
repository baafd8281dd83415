"""Describe a recording as the gap reconstruction paper does (skurowski2021, Table 2).

Reads: PREPARED, a clean recording. Writes: DESCRIPTORS, a table of one row.
"""

import argparse
from pathlib import Path

from markermend.evaluation.gaps2021 import runs
from markermend.evaluation.gaps2021.options import Gaps2021Options
from markermend.evaluation.option_flags import read_flag
from markermend.evaluation.table_files import write_table
from markermend.storage import stage_files


def main(argv: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="gaps2021_descriptors.py", description=__doc__, allow_abbrev=False)
    parser.add_argument("--prepared", type=Path, required=True, help="a clean recording")
    parser.add_argument("--recording", required=True, help="its name")
    parser.add_argument("--options", required=True, help="options of the experiment, as JSON")
    parser.add_argument("--descriptors", type=Path, required=True, help="its descriptors, to write")
    flags = parser.parse_args(argv)
    options = read_flag(Gaps2021Options, flags.options)
    clean = runs.prepare(stage_files.read_recording(flags.prepared), options)
    write_table(flags.descriptors, runs.describe(flags.recording, clean))


if __name__ == "__main__":
    main()
