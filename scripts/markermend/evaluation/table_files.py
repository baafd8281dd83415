"""Tables of the experiments as files: tabs between columns, equal tables as equal bytes."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import pandas as pd

from markermend.storage import atomic

NAMES = ("recording", "sequence", "marker", "operator")
"""Columns of names, which stay text: a recording may be called 001."""


def write_table(path: Path, table: pd.DataFrame) -> None:
    """Write a table; numbers have six significant digits.

    Parameters
    ----------
    path : Path
        The file.
    table : DataFrame
        The columns; the index is left out.
    """
    atomic.write_text(path, table.to_csv(sep="\t", index=False, float_format="%.6g", lineterminator="\n"))


def read_table(path: Path) -> pd.DataFrame:
    """Read a table.

    Parameters
    ----------
    path : Path
        A file that write_table wrote.

    Returns
    -------
    DataFrame
        Numbers where a column has nothing else, NaN where they are missing; other columns, and NAMES, as text, "" where there is none.
    """
    text = pd.read_csv(path, sep="\t", dtype=str, keep_default_na=False)
    return text.apply(_numbers)


def read_tables(paths: Iterable[Path]) -> pd.DataFrame:
    """Read tables of the same columns, one below the other.

    Parameters
    ----------
    paths : iterable of Path
        The files.

    Returns
    -------
    DataFrame
        See read_table.
    """
    return pd.concat(
        [pd.read_csv(path, sep="\t", dtype=str, keep_default_na=False) for path in paths], ignore_index=True
    ).apply(_numbers)


def _numbers(column: pd.Series) -> pd.Series:
    """A column as numbers, if it has nothing else and none of NAMES."""
    if column.name in NAMES:
        return column
    given = column[column != ""]
    numbers = pd.to_numeric(given, errors="coerce")
    return column if given.empty or numbers.isna().any() else numbers.reindex(column.index)
