"""Put the runs of the gap reconstruction paper's experiment into tables, with the published figures beside ours (skurowski2021).

Reads: the tables of runs, the descriptors of the recordings, the published figures. Writes: ERRORS_TABLE, as Tables 3 and A1 to A5;
DESCRIPTORS_TABLE, as Table 2; PARAMETERS_TABLE, as Table 4; CRITERIA_TABLE, of Figure 9; CORRELATIONS_TABLE, as Tables A6 to A12;
MEAN_CORRELATIONS_TABLE, as Table 5; DESCRIPTOR_CORRELATIONS_TABLE, as Table 6; CLAIMS_TABLE, what the paper states, and whether it holds.
"""

import argparse
from pathlib import Path

from markermend.evaluation.gaps2021 import claims, tables
from markermend.evaluation.gaps2021.jobs import TABLES
from markermend.evaluation.gaps2021.options import Gaps2021Options
from markermend.evaluation.option_flags import read_flag
from markermend.evaluation.published_figures import read_published
from markermend.evaluation.table_files import read_tables, write_table


def main(argv: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(
        prog="gaps2021_tables.py", description=__doc__, allow_abbrev=False, fromfile_prefix_chars="@"
    )
    parser.add_argument("--runs", type=Path, nargs="+", required=True, help="tables of runs")
    parser.add_argument("--descriptors", type=Path, nargs="+", required=True, help="descriptors of the recordings")
    parser.add_argument("--published", type=Path, required=True, help="the published figures")
    parser.add_argument("--options", required=True, help="options of the experiment, as JSON")
    for name in TABLES:
        parser.add_argument(f"--{name.replace('_', '-')}-table", type=Path, required=True, help="a table to write")
    flags = parser.parse_args(argv)
    options = read_flag(Gaps2021Options, flags.options)
    runs, figures = read_tables(flags.runs), read_published(flags.published)
    made = tables.make_tables(runs, read_tables(flags.descriptors), figures, options)
    made["claims"] = claims.judge(runs, made, tables.arrange_published(figures))
    for name in TABLES:
        write_table(getattr(flags, f"{name}_table"), made[name])


if __name__ == "__main__":
    main()
