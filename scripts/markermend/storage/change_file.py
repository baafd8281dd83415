"""The files of changes: what repair and filling did to each stretch, one row each, as Parquet."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import pyarrow as pa

from markermend.core.changes import Alternative, Change, MemberWeight, Outcome
from markermend.core.reasons import Cause, Limit, Reason
from markermend.storage.parquet_tables import read_table, table_of, write_table
from markermend.storage.stage_files import read_facts

SCHEMA = pa.schema(
    [
        ("marker", pa.string()),
        ("start", pa.int64()),
        ("stop", pa.int64()),
        ("classes", pa.list_(pa.string())),
        ("outcome", pa.string()),
        ("score", pa.float64()),
        ("axes", pa.string()),
        ("partner", pa.string()),
        ("group", pa.string()),
        ("method", pa.string()),
        ("alternatives", pa.list_(pa.struct([("method", pa.string()), ("expected_error_mm", pa.float64())]))),
        ("member_weights", pa.list_(pa.struct([("member", pa.string()), ("weight", pa.float64())]))),
        ("samples", pa.int64()),
        ("largest_change_mm", pa.float64()),
        ("expected_error_mm", pa.float64()),
        ("expected_error95_mm", pa.float64()),
        ("decisions", pa.list_(pa.string())),
        ("cause", pa.string()),
        ("reason", pa.string()),
        ("limit_setting", pa.string()),
        ("limit_value", pa.float64()),
        ("limit_actual", pa.float64()),
    ]
)
"""The columns: those of `Change`, with its reason and the limit in columns of their own; null where there is none."""


def write(path: Path, changes: Iterable[Change], facts: Mapping[str, Any]) -> None:
    """Write changes in their order, with facts in the footer.

    Parameters
    ----------
    path : Path
        The Parquet file.
    changes : sequence of Change
        What was done to each stretch.
    facts : mapping
        What the stage says of itself, JSON values.
    """
    write_table(path, table_of([_row(change) for change in changes], SCHEMA), facts)


def read(path: Path) -> tuple[Change, ...]:
    """Read changes.

    Parameters
    ----------
    path : Path
        A file that `write` wrote.

    Returns
    -------
    tuple of Change
        The changes in their order.

    Raises
    ------
    SetAside
        Where an earlier stage set the recording aside.
    """
    read_facts(path)
    return tuple(_change(row) for row in read_table(path).to_pylist())


def _row(change: Change) -> dict[str, Any]:
    """A change as the file states it."""
    row = asdict(change)
    reason = change.reason
    limit = reason.limit if reason else None
    row["cause"], row["reason"] = (reason.cause.value, reason.text) if reason else (None, None)
    for name in ("setting", "value", "actual"):
        row[f"limit_{name}"] = getattr(limit, name) if limit else None
    return row


def _change(row: dict[str, Any]) -> Change:
    """A change from a row of the file."""
    cause, text = row.pop("cause"), row.pop("reason")
    setting, value, actual = (row.pop(f"limit_{name}") for name in ("setting", "value", "actual"))
    limit = None if setting is None else Limit(setting, value, actual)
    parts = {
        "classes": tuple(row["classes"]),
        "outcome": Outcome(row["outcome"]),
        "alternatives": tuple(Alternative(**entry) for entry in row["alternatives"]),
        "member_weights": tuple(MemberWeight(**entry) for entry in row["member_weights"]),
        "decisions": tuple(row["decisions"]),
        "reason": None if cause is None else Reason(Cause(cause), text, limit),
    }
    return Change(**{**row, **parts})
