"""Decisions in the pages of the small report of the tests: the lines that it has, and what a test reads of page and table."""

from __future__ import annotations

import csv
import io
from typing import Any

from markermend.planning.decision_table import COLUMNS
from markermend.planning.recordings import Entry

ENTRIES = [Entry("Anna", "Walk 1", "/a.c3d"), Entry("Anna", "Calm", "/b.c3d"), Entry("Bob", "Bad", "/c.c3d")]
"""The recordings of the report."""

STATED = (
    ("Walk 1", "LFIN", "", "", "protect", "", "taped", "Anna", "A.L.", "2026-03-31"),
    ("gone", "A*", "5", "9", "reject", "peak", "", "", "", ""),
)
"""Lines of its table of decisions: one that the run followed, and one on a recording that is not there."""

ANY = ("local_ridge", "spline", "blank", "ensemble")
"""Methods that a decision may name."""


def lines(text: str) -> list[list[str]]:
    """The lines of a table, without its header."""
    header, *rows = csv.reader(io.StringIO(text), delimiter="\t")
    assert tuple(header) == COLUMNS
    return rows


def row_of(page: Any, kind: str, table: str = "changes", nth: int = 0) -> Any:
    """The line of a finding of a class."""
    return page.locator(f'#{table} tbody tr[data-kind="{kind}"]').nth(nth)


def cells(row: Any) -> list[str]:
    """Marker, first and last frame of a finding's line."""
    return [row.locator("td").nth(place).inner_text() for place in (3, 4, 5)]
