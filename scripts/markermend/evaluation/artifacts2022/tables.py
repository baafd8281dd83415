"""The tables of the experiment on classification, with the published figures beside ours (skurowski2022, 4.1.2, E1)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from markermend.evaluation.artifacts2022.runs import CONDITION
from markermend.evaluation.classification import CLASSES, average, measures
from markermend.evaluation.published_figures import beside

PRINTED = ("TPR", "FDR", "F")
"""The measures of which the paper prints figures."""


def average_runs(runs: pd.DataFrame) -> pd.DataFrame:
    """Average the confusion matrices of each condition.

    Parameters
    ----------
    runs : DataFrame
        The columns RUN_COLUMNS.

    Returns
    -------
    DataFrame
        One row for each true class of each condition: the number of runs, and the mean number of samples in each found class.
    """
    parts = []
    for names, own in runs.groupby(CONDITION, sort=False):
        confusion = pd.DataFrame(average(_confusions(own)), columns=list(CLASSES))
        confusion.insert(0, "true", list(CLASSES))
        confusion.insert(0, "runs", own["run"].nunique())
        parts.append(_with_condition(confusion, names))
    return pd.concat(parts, ignore_index=True)


def measure_runs(runs: pd.DataFrame, figures: pd.DataFrame) -> pd.DataFrame:
    """Compute the measures of each condition from its averaged confusion matrix, with the published ones beside.

    Parameters
    ----------
    runs : DataFrame
        The columns RUN_COLUMNS.
    figures : DataFrame
        Those of skurowski2022; see published_figures.read_published.

    Returns
    -------
    DataFrame
        One row for each class of each condition, and one for all classes: the number of runs, the measures of `classification.measures`,
        and `TPR_published`, `FDR_published` and `F_published` as text.
    """
    parts = []
    for names, own in runs.groupby(CONDITION, sort=False):
        table = measures(average(_confusions(own))).reset_index()
        table.insert(0, "runs", own["run"].nunique())
        parts.append(_with_condition(table, names))
    ours = pd.concat(parts, ignore_index=True)
    printed = figures[figures["table"] == "text"]
    for quantity in PRINTED:
        own = printed[printed["quantity"] == quantity]
        ours = beside(ours, own, on=["amplitude_mm", "class"], name=f"{quantity}_published")
    return ours


def _confusions(runs: pd.DataFrame) -> list[np.ndarray]:
    """The confusion matrix of each run of one condition."""
    return [
        own.pivot(index="true", columns="found", values="samples").loc[list(CLASSES), list(CLASSES)].to_numpy(float)
        for _, own in runs.groupby("run")
    ]


def _with_condition(table: pd.DataFrame, names: Sequence[object]) -> pd.DataFrame:
    """A table with the condition in front."""
    for place, (column, value) in enumerate(zip(CONDITION, names, strict=True)):
        table.insert(place, column, value)
    return table
