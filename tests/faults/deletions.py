"""Results that are deleted: each comes back in the next run."""

import shutil
from functools import partial
from pathlib import Path

from faults.trial import Outcome, Trial
from faults.workplace import Workplace

DELETED = (
    "cleaned/S01/walk.c3d",
    "cleaned/S02/reach.csv",
    "S01/walk/changes.tsv",
    "S01/walk/originals.parquet",
    "S01/walk/certificate.json",
    "S01/walk/08_qc.json",
    "S01/walk/page.html",
    "S01/walk/07_filled.parquet",
    "S01/walk/05_slow.parquet",
    "S01/walk/01_markers.parquet",
    "S01/mesh.json",
    "S01/poses.parquet",
    "report/index.html",
    "report/summary.tsv",
    "report/plotly.min.js",
    "S01/walk",
    "S01",
    "cleaned",
    "report",
    ".snakemake",
)
"""What is deleted, a file or a folder at a time."""


def trials() -> list[Trial]:
    """The trials of this kind."""
    return [Trial(name, partial(delete, name=name)) for name in DELETED]


def delete(place: Workplace, *, name: str) -> Outcome:
    """Delete a result, and run again."""
    place.restore(finished=True)
    remove(place.results / name)
    ended = place.run()
    return Outcome(
        ["back" if not place.differences() else "back after another run"], [*place.unsaid(ended), *place.finish(ended)]
    )


def remove(path: Path) -> None:
    """Remove a file or a folder."""
    if path.is_dir():
        shutil.rmtree(path)
    else:
        path.unlink()
