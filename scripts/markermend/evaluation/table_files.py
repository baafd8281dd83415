"""Tables of the experiments as files: tabs between columns, equal tables as equal bytes."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import pandas as pd
from pandas.api.types import is_numeric_dtype

from markermend.storage import atomic
from markermend.storage.tab_separated import guarded, plain

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
    atomic.write_text(
        path, _map_texts(table, guarded).to_csv(sep="\t", index=False, float_format="%.6g", lineterminator="\n")
    )


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
    return read_tables([path])


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
    texts = [pd.read_csv(path, sep="\t", dtype=str, keep_default_na=False) for path in paths]
    return _map_texts(pd.concat(texts, ignore_index=True), plain).apply(_numbers)


def _map_texts(table: pd.DataFrame, function: Callable[[Any], Any]) -> pd.DataFrame:
    """A table with its cells of text changed."""
    return table.apply(lambda column: column if is_numeric_dtype(column) else column.map(function))


def _numbers(column: pd.Series) -> pd.Series:
    """A column as numbers, if it has nothing else and none of NAMES."""
    if column.name in NAMES:
        return column
    given = column[column != ""]
    numbers = pd.to_numeric(given, errors="coerce")
    return column if given.empty or numbers.isna().any() else numbers.reindex(column.index)
