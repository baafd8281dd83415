"""What a run came to, in a few lines for the terminal."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

STATUSES = ("cleaned", "unchanged", "static", "set aside")
"""The possible outcomes of a recording, in the order in which a summary counts them."""

LISTED = 10
"""Largest number of recordings set aside that a terminal names; the report names all."""


def summary(paths: Iterable[Path], report: Path) -> str:
    """Sum up a run: recordings by outcome, changed samples, what was set aside and why.

    Parameters
    ----------
    paths : iterable of Path
        Quality files of the recordings; those that do not exist count as unfinished.
    report : Path
        First page of the report; the last line names it where it exists.

    Returns
    -------
    str
        The lines.
    """
    found = [json.loads(path.read_text(encoding="utf-8")) if path.exists() else {} for path in paths]
    counts = Counter(quality.get("status", "unfinished") for quality in found)
    lines = [", ".join(f"{counts[status]} {status}" for status in (*STATUSES, "unfinished") if counts[status])]
    lines[0] = (
        f"{len(found)} recordings: {lines[0]}; {sum(q.get('changed_samples') or 0 for q in found)} samples changed"
    )
    aside = [quality for quality in found if quality.get("status") == "set aside"]
    lines += [f"  set aside: {q.get('subject')}/{q.get('recording')}: {q.get('reason')}" for q in aside[:LISTED]]
    if len(aside) > LISTED:
        lines.append(f"  and {len(aside) - LISTED} more, all in the report")
    return "\n".join([*lines, *([f"Report: {report}"] if report.exists() else [])])
