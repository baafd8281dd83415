"""The tables of the experiments, with the published figures beside ours (skurowski2022, 4.1.2)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
import pandas as pd

from markermend.evaluation.artifacts2022.claims import PAPER_COORDINATES, judge
from markermend.evaluation.artifacts2022.runs import CONDITION
from markermend.evaluation.artifacts2022.slow_sweep import average_sweep
from markermend.evaluation.classification import CLASSES, average, measures
from markermend.evaluation.published_figures import beside
from markermend.simulation.published_contamination import AMPLITUDE_DEVIATION

READING = ["recording", "reading", *CONDITION[2:]]
"""The columns of the runs of a reading of the paper."""

REPAIR = ["recording", "coordinates", "class", "amplitude_mm", "share_percent", "method", "located"]
"""The columns over whose equal rows errors of repair are averaged."""

TRIANGLE = 1 / 3
"""Mean square of a triangle of height 1."""

PRINTED = ("TPR", "FDR", "F")
"""The measures of which the paper prints figures."""


EXPERIMENTS = ("runs", "readings", "slow", "repairs", "operators")
"""The experiments whose runs make the tables."""


def make_tables(runs: Mapping[str, pd.DataFrame], figures: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """Make all tables.

    Parameters
    ----------
    runs : mapping of str to DataFrame
        The runs of those of EXPERIMENTS that were run.
    figures : DataFrame
        Those of skurowski2022; see published_figures.read_published.

    Returns
    -------
    dict of str to DataFrame
        The tables by the names of their files; without rows where the experiment was not run.
    """
    makers: dict[str, tuple[str, Callable[[pd.DataFrame], pd.DataFrame]]] = {
        "measures": ("runs", lambda own: measure_runs(own, figures)),
        "confusion": ("runs", average_runs),
        "readings": ("readings", lambda own: measure_runs(own, figures, READING)),
        "slow": ("slow", average_sweep),
        "repairs": ("repairs", lambda own: average_repairs(own, figures)),
        "operators": ("operators", lambda own: join_operators(own, figures)),
    }
    tables = {
        name: make(runs[experiment]) if experiment in runs else pd.DataFrame(columns=["recording"])
        for name, (experiment, make) in makers.items()
    }
    return {**tables, "claims": judge(tables["measures"], tables["confusion"], tables["repairs"], tables["operators"])}


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
        parts.append(_with_keys(confusion, CONDITION, names))
    return pd.concat(parts, ignore_index=True)


def measure_runs(runs: pd.DataFrame, figures: pd.DataFrame, keys: Sequence[str] = CONDITION) -> pd.DataFrame:
    """Compute the measures of each condition from its averaged confusion matrix, with the published ones beside.

    Parameters
    ----------
    runs : DataFrame
        The columns RUN_COLUMNS, or those of a reading.
    figures : DataFrame
        Those of skurowski2022; see published_figures.read_published.
    keys : sequence of str, optional
        The columns over whose equal rows runs are averaged: CONDITION or READING.

    Returns
    -------
    DataFrame
        One row for each class of each condition, and one for all classes: the number of runs, the measures of `classification.measures`,
        and `TPR_published`, `FDR_published` and `F_published` as text, "" for other detectors than the published ones.
    """
    parts = []
    for names, own in runs.groupby(list(keys), sort=False):
        table = measures(average(_confusions(own))).reset_index()
        table.insert(0, "runs", own["run"].nunique())
        parts.append(_with_keys(table, keys, names))
    ours = pd.concat(parts, ignore_index=True)
    printed = figures[figures["table"] == "text"]
    for quantity in PRINTED:
        own = printed[printed["quantity"] == quantity]
        ours = beside(ours, own, on=["amplitude_mm", "class"], name=f"{quantity}_published")
        if "preset" in ours:  # the figures are of the paper's own detectors
            ours[f"{quantity}_published"] = ours[f"{quantity}_published"].where(ours["preset"] == "paper", "")
    return ours


def average_repairs(runs: pd.DataFrame, figures: pd.DataFrame) -> pd.DataFrame:
    """Average the errors of each way of repair, with the published ones beside.

    Parameters
    ----------
    runs : DataFrame
        The columns repairs.COLUMNS.
    figures : DataFrame
        Those of skurowski2022; see published_figures.read_published.

    Returns
    -------
    DataFrame
        One row for each class, share, method, and what was located: the number of runs, the mean error `rmse_mm` and its standard error, mm;
        `rmse_159_mm`, the same if the recording had as many coordinates as those of the paper; `formula_mm`, for distorted recordings, the
        root of the expected mean square error of these; and `published`, mm. The mean of errors lies below that root.
    """
    grouped = runs.groupby(REPAIR, sort=False)["rmse_mm"]
    table = grouped.agg(runs="count", rmse_mm="mean", standard_error_mm="sem").reset_index()
    table["rmse_159_mm"] = table["rmse_mm"] * np.sqrt(table["coordinates"] / PAPER_COORDINATES)
    distorted = table["method"] == "distorted"
    table["formula_mm"] = _formula(table).where(distorted)
    printed = figures[figures["quantity"] == "RMSE"].assign(table="")
    names = table["method"].where(distorted, table["method"] + " " + table["located"])
    on = ["amplitude_mm", "share_percent", "class", "method"]
    return beside(table.assign(method=names), printed, on=on).assign(method=table["method"])


def join_operators(ours: pd.DataFrame, figures: pd.DataFrame) -> pd.DataFrame:
    """Put the published findings of persons and the algorithm below ours.

    Parameters
    ----------
    ours : DataFrame
        The columns operators.COLUMNS.
    figures : DataFrame
        Those of skurowski2022; see published_figures.read_published.

    Returns
    -------
    DataFrame
        The columns of ours, and `source`: ours or published. What the paper's expert approved is `algorithm_confirmed`, what he
        rejected `only_algorithm`, what the algorithm missed `only_human`.
    """
    names = {"approved": "algorithm_confirmed", "rejected": "only_algorithm", "missed": "only_human"}
    printed = figures[figures["table"] == "2"].pivot(index="method", columns="quantity", values="value")
    printed = printed.rename(columns=names).rename_axis(index="operator", columns=None).reset_index()
    printed = printed.assign(recording="sitting", preset="paper", **{"class": "all"}, source="published")
    joined = pd.concat([ours.assign(source="ours"), printed], ignore_index=True)
    return joined[["source", *ours.columns]]


def _formula(table: pd.DataFrame) -> pd.Series:
    """Root of the expected mean square error of distorted recordings of 159 coordinates: share, amplitude, and shape of the artifact."""
    square = table["amplitude_mm"] ** 2 * (1 + AMPLITUDE_DEVIATION**2)
    shape = (table["class"] == "slow").map({True: TRIANGLE, False: 1.0})
    root: pd.Series = np.sqrt(table["share_percent"] / 100 / PAPER_COORDINATES * square * shape)
    return root


def _confusions(runs: pd.DataFrame) -> list[np.ndarray]:
    """The confusion matrix of each run of one condition."""
    return [
        own.pivot(index="true", columns="found", values="samples").loc[list(CLASSES), list(CLASSES)].to_numpy(float)
        for _, own in runs.groupby("run")
    ]


def _with_keys(table: pd.DataFrame, keys: Sequence[str], names: Sequence[object]) -> pd.DataFrame:
    """A table with the condition in front."""
    for place, (column, value) in enumerate(zip(keys, names, strict=True)):
        table.insert(place, column, value)
    return table
