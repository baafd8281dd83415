"""Finish a recording in one process: fill its gaps, write its cleaned file, judge it.

Reads: the original file, 01_markers.parquet, mesh.json, the events, 06_repaired.parquet, 06_changes.parquet, poses.parquet of the subject, if there
is one, and a file with the flags of the stages.
Writes: what fill.py, export.py and qc.py write: 07_filled.parquet to page.html, and the cleaned file.
"""

from collections.abc import Sequence
from pathlib import Path

from markermend.command import finishing


def main(argv: Sequence[str] | None = None) -> None:
    finishing.run(Path(__file__).resolve().parent, __doc__, argv)


if __name__ == "__main__":
    main()
