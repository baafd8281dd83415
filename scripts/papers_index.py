"""Put the papers together on one page: what each states, and whether it holds.

Reads: the tables of each paper. Writes: INDEX, the page.
"""

import argparse
from pathlib import Path

from markermend.evaluation.pages import papers_page
from markermend.evaluation.papers import PAGES
from markermend.evaluation.table_files import read_table
from markermend.storage import atomic


def main(argv: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="papers_index.py", description=__doc__, allow_abbrev=False)
    parser.add_argument("--tables", type=Path, nargs="*", required=True, help="tables, in PAPER/tables/NAME.tsv")
    parser.add_argument("--index", type=Path, required=True, help="the page, to write")
    flags = parser.parse_args(argv)
    papers = {}
    for name, make_page in PAGES.items():
        tables = {path.stem: read_table(path) for path in flags.tables if path.parts[-3] == name}
        if tables:
            papers[name] = (make_page(tables), tables["claims"])
    atomic.write_text(flags.index, papers_page(papers))


if __name__ == "__main__":
    main()
