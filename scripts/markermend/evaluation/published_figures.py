"""The figures that papers print, to be put beside ours: tables in config/evaluate/published.

A row is one printed figure: the table, the sequence, the mean length of the gaps in frames, the method by the name of our
predictor, the descriptor of the sequence, the quantity and the value. What does not apply is empty. Obvious misprints are
corrected: the lengths 50, 100 and 200 of Table A3 of skurowski2021 are printed as 20.
"""

from __future__ import annotations

from pathlib import Path

import pandas as pd

COLUMNS = ("table", "sequence", "length", "method", "descriptor", "quantity", "value")
"""The columns of a table of published figures."""


def read_published(path: Path) -> pd.DataFrame:
    """Read published figures.

    Parameters
    ----------
    path : Path
        Table with tabs.

    Returns
    -------
    DataFrame
        The columns of COLUMNS: `length` is an integer or missing, `value` a number, the others are text, "" where it does not apply.

    Raises
    ------
    ValueError
        If the table has other columns, or figures of which two say the same.
    """
    text = pd.read_csv(path, sep="\t", dtype=str, keep_default_na=False)
    if tuple(text.columns) != COLUMNS:
        raise ValueError(f"{path}: the columns are {', '.join(text.columns)} instead of {', '.join(COLUMNS)}")
    if (twice := text.duplicated(list(COLUMNS[:-1]))).any():
        raise ValueError(f"{path}, line {int(twice.to_numpy().argmax()) + 2}: this figure was there before")
    length = pd.to_numeric(text["length"].where(text["length"] != "")).astype("Int64")
    return text.assign(length=length, value=pd.to_numeric(text["value"]))


def published_errors(figures: pd.DataFrame, quantity: str) -> pd.DataFrame:
    """Arrange the published errors of filled gaps by sequence, length and method.

    Parameters
    ----------
    figures : DataFrame
        See read_published.
    quantity : str
        A field of gap_errors.ErrorStatistics, such as "rmse".

    Returns
    -------
    DataFrame
        One row a sequence, and columns with the levels `length` and `method`; in mm.
    """
    rows = figures[(figures["quantity"] == quantity) & (figures["sequence"] != "") & (figures["descriptor"] == "")]
    return rows.astype({"length": int}).pivot(index="sequence", columns=["length", "method"], values="value")


def published_descriptors(figures: pd.DataFrame) -> pd.DataFrame:
    """Arrange the published descriptors of sequences.

    Parameters
    ----------
    figures : DataFrame
        See read_published.

    Returns
    -------
    DataFrame
        One row a sequence, and one column a descriptor, in the units of sequence_descriptors.SequenceDescriptors.
    """
    rows = figures[(figures["descriptor"] != "") & (figures["sequence"] != "")]
    return rows.pivot(index="sequence", columns="descriptor", values="value")
