"""Copy the plotting script that the pages of all papers share.

Writes: SCRIPT.
"""

import argparse
from pathlib import Path

from markermend.report.rendering import plotly_script
from markermend.storage import atomic


def main(argv: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="papers_script.py", description=__doc__, allow_abbrev=False)
    parser.add_argument("--script", type=Path, required=True, help="the plotting script, to write")
    flags = parser.parse_args(argv)
    with atomic.replacing(flags.script) as temporary:
        temporary.write_bytes(plotly_script().read_bytes())


if __name__ == "__main__":
    main()
