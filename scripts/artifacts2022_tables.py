"""Put the runs of the experiment on classification into tables, with the published figures beside ours (skurowski2022, E1).

Reads: the tables of runs, the published figures. Writes: CONFUSION, averaged confusion matrices as in Figures 12 and 13;
MEASURES, the measures of each class and over all classes.
"""

import argparse
from pathlib import Path

import pandas as pd

from markermend.evaluation import artifact_classification as classification
from markermend.storage import atomic


def main(argv: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="artifacts2022_tables.py", description=__doc__, allow_abbrev=False)
    parser.add_argument("--runs", type=Path, nargs="+", required=True, help="tables of runs")
    parser.add_argument("--published", type=Path, required=True, help="the published figures")
    parser.add_argument("--confusion", type=Path, required=True, help="averaged confusion matrices, to write")
    parser.add_argument("--measures", type=Path, required=True, help="measures of each class, to write")
    flags = parser.parse_args(argv)
    runs = pd.concat([pd.read_csv(path, sep="\t") for path in flags.runs], ignore_index=True)
    published = pd.read_csv(flags.published, sep="\t", dtype=str, keep_default_na=False)
    for path, table in (
        (flags.confusion, classification.average_runs(runs)),
        (flags.measures, classification.measure_runs(runs, published)),
    ):
        atomic.write_text(path, table.to_csv(sep="\t", index=False, float_format="%.6g", lineterminator="\n"))


if __name__ == "__main__":
    main()
