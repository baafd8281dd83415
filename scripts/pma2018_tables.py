"""Put the runs of the model averaging paper's experiments into tables, with the published figures beside ours (tits2018).

Reads: the tables of runs, the published figures. Writes: LENGTHS, DURATIONS and GAP_COUNTS, the mean errors of Figures 4 to 6; MEANS, those
over recordings (Figure 7); CONSTRAINTS, the effect of the constraints (Tables 2 and 3); CLAIMS, what the paper states, and whether it holds.
"""

import argparse
from pathlib import Path

from markermend.evaluation.option_flags import read_flag
from markermend.evaluation.pma2018 import claims, tables
from markermend.evaluation.pma2018.options import Pma2018Options
from markermend.evaluation.published_figures import read_published
from markermend.evaluation.table_files import read_tables, write_table


def main(argv: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(
        prog="pma2018_tables.py", description=__doc__, allow_abbrev=False, fromfile_prefix_chars="@"
    )
    parser.add_argument("--runs", type=Path, nargs="+", required=True, help="tables of runs")
    parser.add_argument("--published", type=Path, required=True, help="the published figures")
    parser.add_argument("--options", required=True, help="options of the experiments, as JSON")
    parser.add_argument("--lengths", type=Path, required=True, help="errors by length of the gaps, to write")
    parser.add_argument("--durations", type=Path, required=True, help="errors by duration of the fragment, to write")
    parser.add_argument("--gap-counts", type=Path, required=True, help="errors by number of gaps, to write")
    parser.add_argument("--means", type=Path, required=True, help="mean errors over the recordings, to write")
    parser.add_argument("--constraints", type=Path, required=True, help="effect of the constraints, to write")
    parser.add_argument("--claims", type=Path, required=True, help="what the paper states, to write")
    flags = parser.parse_args(argv)
    options = read_flag(Pma2018Options, flags.options)
    made = tables.all_tables(read_tables(flags.runs), read_published(flags.published), options)
    for name, table in {**made, "claims": claims.judge(made, options)}.items():
        write_table(getattr(flags, name), table)


if __name__ == "__main__":
    main()
