"""The order of the rows of tables: methods as the paper has them."""

from __future__ import annotations

import pandas as pd

from markermend.evaluation.gaps2021.methods import METHODS


def in_order(table: pd.DataFrame) -> pd.DataFrame:
    """Put the rows of a table into the order of its other keys, and the methods within them into that of the paper.

    Parameters
    ----------
    table : DataFrame
        The column `method`, and any of `descriptor`, `recording` and `length`.

    Returns
    -------
    DataFrame
        Its rows, sorted; descriptors and recordings in the order in which they come first.
    """
    named = [name for name in ("descriptor", "recording") if name in table]
    ranks = {name: pd.Categorical(table[name], list(dict.fromkeys(table[name])), ordered=True) for name in named}
    ranked = table.assign(**ranks, method=pd.Categorical(table["method"], list(METHODS), ordered=True))
    by = [*named, *(["length"] if "length" in table else []), "method"]
    return table.loc[ranked.sort_values(by, kind="stable").index].reset_index(drop=True)
