"""Put the runs of the artifact detection paper's experiments into tables, with the published figures beside ours (skurowski2022).

Reads: the tables of runs of each experiment, the published figures. Writes, into TABLES: confusion, averaged confusion matrices as in Figures
12 and 13; measures, those of each class and over all classes; readings, the same for each reading of the paper; slow, thresholds of slow
changes; repairs, as Tables 3 to 5; operators, as Table 2; claims, what the paper states, and whether it holds.
"""

import argparse
from pathlib import Path

from markermend.evaluation.artifacts2022.tables import EXPERIMENTS, make_tables
from markermend.evaluation.published_figures import read_published
from markermend.evaluation.table_files import read_tables, write_table


def main(argv: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(
        prog="artifacts2022_tables.py", description=__doc__, allow_abbrev=False, fromfile_prefix_chars="@"
    )
    for name in EXPERIMENTS:
        parser.add_argument(f"--{name}", type=Path, nargs="*", default=[], help="tables of runs of this experiment")
    parser.add_argument("--published", type=Path, required=True, help="the published figures")
    parser.add_argument("--tables", type=Path, required=True, help="the folder of the tables, to write")
    flags = parser.parse_args(argv)
    runs = {name: read_tables(paths) for name in EXPERIMENTS if (paths := getattr(flags, name))}
    for name, table in make_tables(runs, read_published(flags.published)).items():
        write_table(flags.tables / f"{name}.tsv", table)


if __name__ == "__main__":
    main()
