"""The tables of correlations, with the published figures beside ours (skurowski2021, Tables 5, 6 and A6 to A12)."""

from __future__ import annotations

import pandas as pd

from markermend.evaluation.correlations import MIN_SEQUENCES, correlations
from markermend.evaluation.gaps2021.row_order import in_order
from markermend.evaluation.published_figures import beside

DESCRIPTORS = ("entropy", "deviation", "velocity", "acceleration", "jerk", "monotonicity", "complexity")
"""The descriptors that the paper prints (Table 2)."""


def correlate(errors: pd.DataFrame, descriptors: pd.DataFrame, figures: pd.DataFrame) -> pd.DataFrame:
    """Correlate the errors of each method with the descriptors of the recordings (Tables A6 to A12).

    Parameters
    ----------
    errors : DataFrame
        See describe_errors.
    descriptors : DataFrame
        See runs.describe.
    figures : DataFrame
        Those of skurowski2021.

    Returns
    -------
    DataFrame
        One row for each descriptor, length and method: correlation, p, number of recordings, and correlation and p as they are printed; no rows
        for fewer than three recordings.
    """
    names = ["descriptor", "length", "method", "correlation", "p", "sequences"]
    if len(descriptors) < MIN_SEQUENCES:
        table = pd.DataFrame(columns=names)
    else:
        arranged = errors.pivot(index="recording", columns=["length", "method"], values="rmse")
        table = in_order(correlations(_indexed(descriptors), arranged))[names]
    for name in ("correlation", "p"):
        printed = figures[(figures["quantity"] == name) & figures["table"].astype(str).str.startswith("A")]
        table = beside(table, printed, on=["descriptor", "length", "method"], name=f"{name}_published")
    return table.rename(columns={"sequences": "recordings"})


def average_correlations(table: pd.DataFrame, figures: pd.DataFrame) -> pd.DataFrame:
    """Average correlations over the lengths of gaps (Table 5).

    Parameters
    ----------
    table : DataFrame
        See correlate.
    figures : DataFrame
        Those of skurowski2021.

    Returns
    -------
    DataFrame
        One row for each descriptor and method: mean correlation, and the printed one.
    """
    means = table.groupby(["descriptor", "method"], sort=False)["correlation"].mean().reset_index()
    printed = figures[(figures["table"].astype(str) == "5") & (figures["quantity"] == "correlation")]
    return beside(means, printed, on=["descriptor", "method"])


def correlate_descriptors(descriptors: pd.DataFrame, figures: pd.DataFrame) -> pd.DataFrame:
    """Correlate the descriptors of recordings with each other (Table 6).

    Parameters
    ----------
    descriptors : DataFrame
        See runs.describe.
    figures : DataFrame
        Those of skurowski2021.

    Returns
    -------
    DataFrame
        One row for each pair of descriptors: correlation, p, and both as they are printed; no rows for fewer than three recordings.
    """
    parts = []
    for other in DESCRIPTORS if len(descriptors) >= MIN_SEQUENCES else ():
        own = _indexed(descriptors)
        table = correlations(own.drop(columns=other), own[[other]].rename_axis(columns="other"))[
            ["descriptor", "other", "correlation", "p"]
        ]
        for name in ("correlation", "p"):
            printed = figures[figures["quantity"] == f"{name}_with_{other}"]
            table = beside(table, printed, on=["descriptor"], name=f"{name}_published")
        parts.append(table)
    columns = ["descriptor", "other", "correlation", "p", "correlation_published", "p_published"]
    return pd.concat(parts, ignore_index=True)[columns] if parts else pd.DataFrame(columns=columns)


def _indexed(descriptors: pd.DataFrame) -> pd.DataFrame:
    """The descriptors that the paper prints, one row for each recording, named by the index."""
    return descriptors.set_index("recording")[list(DESCRIPTORS)]
