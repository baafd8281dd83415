"""The command `markermend table`: a table of recordings to begin with, and what it was guessed from.

Reads: the names below a folder, and the beginning of each recording. Writes: the table.
"""

from __future__ import annotations

import sys
from pathlib import Path

from markermend.options.general import GeneralOptions
from markermend.options.ingest import IngestOptions
from markermend.planning.recordings import BadDataSet
from markermend.planning.starting_table import make_table
from markermend.storage.atomic import NotWritten, write_text


def run(folder: str, to: Path, general: GeneralOptions, ingest: IngestOptions) -> int:
    """Write a table, and print what was guessed.

    Parameters
    ----------
    folder : str
        The folder of recordings.
    to : Path
        The table; one that is there is never overwritten.
    general : GeneralOptions
        Which links are followed, which folders are days, and where results are.
    ingest : IngestOptions
        The names of static recordings.

    Returns
    -------
    int
        The exit status.
    """
    if to.exists():
        print(f"{to} is there already: name another table with --to", file=sys.stderr)
        return 1
    try:
        made = make_table(folder, general, ingest)
        write_text(to, made.text(to.parent))
    except (BadDataSet, NotWritten) as error:
        print(error, file=sys.stderr)
        return 1
    print(*made.notes, sep="\n")
    print(f"Correct {to} where it is wrong, and clean it: markermend clean {to}")
    return 0
