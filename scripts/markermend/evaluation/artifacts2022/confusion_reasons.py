"""Why a statement on the classification does not hold: with which class the samples are confused most."""

from __future__ import annotations

import numpy as np
import pandas as pd

from markermend.evaluation.classification import CLASSES, OVERALL


def confusion_reason(confusion: pd.DataFrame, *, kind: str, measure: str) -> str:
    """Say where the wrong samples of a class are.

    Parameters
    ----------
    confusion : DataFrame
        Averaged confusion matrices of the conditions of the statement, one below the other; see tables.average_runs.
    kind : str
        The class, or classification.OVERALL.
    measure : str
        `TPR`: where the samples of the class are that are not found; `FDR`: what the other samples are that are found as the class;
        any other measure: the largest confusion.

    Returns
    -------
    str
        A sentence without its full stop; "" where no sample is wrong.
    """
    counts = confusion.groupby("true")[list(CLASSES)].sum().reindex(CLASSES, fill_value=0.0)
    wrong = counts.where(~np.eye(len(CLASSES), dtype=bool), 0.0)
    if kind == OVERALL:
        (true, found), most = wrong.stack().idxmax(), wrong.to_numpy().max()
        share = most / max(wrong.to_numpy().sum(), 1e-12)
        return f"{100 * share:.0f} % of the wrong samples are {true} found as {found}" if most else ""
    own = wrong.loc[kind] if measure == "TPR" else wrong[kind]
    if not own.sum():
        return ""
    share = f"{100 * own.max() / own.sum():.0f} %"
    missed, false = (
        f"{share} of those that are not found are taken for {own.idxmax()}",
        f"{share} of these are {own.idxmax()}",
    )
    return missed if measure == "TPR" else false
