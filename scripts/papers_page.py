"""Write the page of a paper: what it states and whether that holds, tables and charts with the published figures beside ours.

Reads: the tables of the paper, the sizes of its recordings. Writes: PAGE; RECORDINGS_TABLE and
OPTIONS_TABLE, what was run.
"""

import argparse
import json
from dataclasses import replace
from pathlib import Path

import pandas as pd

from markermend.evaluation.pages import paper_page
from markermend.evaluation.papers import PAGES
from markermend.evaluation.table_files import read_table, read_tables, write_table
from markermend.storage import atomic


def main(argv: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="papers_page.py", description=__doc__, allow_abbrev=False)
    parser.add_argument("--paper", choices=PAGES, required=True, help="the paper")
    parser.add_argument("--tables", type=Path, nargs="+", required=True, help="its tables")
    parser.add_argument("--sizes", type=Path, nargs="+", required=True, help="the sizes of its recordings")
    parser.add_argument("--options", type=json.loads, required=True, help="the options of its experiments, as JSON")
    parser.add_argument("--page", type=Path, required=True, help="the page, to write")
    parser.add_argument("--recordings-table", type=Path, required=True, help="the sizes of all recordings, to write")
    parser.add_argument("--options-table", type=Path, required=True, help="the options as a table, to write")
    parser.add_argument("--note", default="", help="what must be said of the choice of recordings")
    flags = parser.parse_args(argv)
    tables = {path.stem: read_table(path) for path in flags.tables}
    sizes = read_tables(flags.sizes)
    write_table(flags.recordings_table, sizes)
    rows = [(name, json.dumps(value, ensure_ascii=False)) for name, value in flags.options.items()]
    write_table(flags.options_table, pd.DataFrame(rows, columns=["option", "value"]))
    page = PAGES[flags.paper](tables)
    page = replace(page, lead=(*page.lead, flags.note)) if flags.note else page
    atomic.write_text(flags.page, paper_page(page, tables, sizes=sizes, options=flags.options))


if __name__ == "__main__":
    main()
