"""Put the runs of the artifact detection paper's experiments into tables, with the published figures beside ours (skurowski2022).

Reads: the tables of runs, the published figures. Writes: CONFUSION, averaged confusion matrices as in Figures 12 and 13;
MEASURES, the measures of each class and over all classes; CLAIMS, what the paper states, and whether it holds.
"""

import argparse
from pathlib import Path

from markermend.evaluation.artifacts2022 import claims, tables
from markermend.evaluation.published_figures import read_published
from markermend.evaluation.table_files import read_tables, write_table


def main(argv: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(
        prog="artifacts2022_tables.py", description=__doc__, allow_abbrev=False, fromfile_prefix_chars="@"
    )
    parser.add_argument("--runs", type=Path, nargs="+", required=True, help="tables of runs")
    parser.add_argument("--published", type=Path, required=True, help="the published figures")
    parser.add_argument("--confusion", type=Path, required=True, help="averaged confusion matrices, to write")
    parser.add_argument("--measures", type=Path, required=True, help="measures of each class, to write")
    parser.add_argument("--claims", type=Path, required=True, help="what the paper states, to write")
    flags = parser.parse_args(argv)
    runs, figures = read_tables(flags.runs), read_published(flags.published)
    measures = tables.measure_runs(runs, figures)
    write_table(flags.measures, measures)
    write_table(flags.confusion, tables.average_runs(runs))
    write_table(flags.claims, claims.judge(measures))


if __name__ == "__main__":
    main()
