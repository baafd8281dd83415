"""What the gap reconstruction paper states of the order of methods (skurowski2021, sections 4.1 and 5).

Such statements are counted over recordings and lengths of gaps, ours as well as the published ones.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import pandas as pd

from markermend.evaluation.claims import UNTESTED, Claim, verdict
from markermend.evaluation.gap_errors import error_table
from markermend.evaluation.gaps2021.methods import DEFAULT, INTERPOLATIONS, NETWORKS, RECURRENT

SHORT = (10, 20)
"""Mean lengths of gaps that the paper calls short, frames."""

LONG = (50, 100, 200)
"""Those that it calls long."""

NO_WORSE = 1.05
"""Factor on an error up to which another counts as no worse."""

COHERENT = ("rmse", "mean", "median", "deviation", "iqr")
"""The measures that name the same best method, by the paper."""


@dataclass(frozen=True)
class Comparison:
    """A statement on the order of methods.

    Attributes
    ----------
    claim : str
        The statement.
    methods : tuple of str
        The methods that it compares.
    lengths : tuple of int
        The mean lengths of gaps that it is about, frames.
    holds : callable
        Makes of errors (one row for each recording and length, one column for each method) whether it holds.
    share : float
        The share of the conditions in which it must hold.
    """

    claim: str
    methods: tuple[str, ...]
    lengths: tuple[int, ...]
    holds: Callable[[pd.DataFrame], pd.Series]
    share: float


def _best(errors: pd.DataFrame, methods: Sequence[str]) -> pd.Series:
    """The least error of methods."""
    return errors[list(methods)].min(axis=1)


COMPARISONS = (
    Comparison(
        "At 10 and 20 samples an interpolation is better than every network",
        (*INTERPOLATIONS, *NETWORKS),
        SHORT,
        lambda errors: _best(errors, INTERPOLATIONS) < _best(errors, NETWORKS),
        0.9,
    ),
    Comparison(
        "At 10 and 20 samples the spline is the best interpolation",
        INTERPOLATIONS,
        SHORT,
        lambda errors: errors["spline"] <= _best(errors, INTERPOLATIONS),
        0.9,
    ),
    Comparison(
        "At 10 and 20 samples the recurrent networks are better than the linear one",
        ("network_linear", *RECURRENT),
        SHORT,
        lambda errors: errors[list(RECURRENT)].max(axis=1) < errors["network_linear"],
        0.9,
    ),
    Comparison(
        "At 50 samples a network is no worse than the interpolations",
        (*INTERPOLATIONS, *NETWORKS),
        (50,),
        lambda errors: _best(errors, NETWORKS) <= NO_WORSE * _best(errors, INTERPOLATIONS),
        0.5,
    ),
    Comparison(
        "From 50 samples the linear network is mostly better than any other method",
        (*INTERPOLATIONS, *NETWORKS),
        LONG,
        lambda errors: errors["network_linear"] <= _best(errors, (*INTERPOLATIONS, *NETWORKS)),
        0.5,
    ),
    Comparison(
        "From 50 samples the linear network is mostly no worse than the interpolations",
        (*INTERPOLATIONS, "network_linear"),
        LONG,
        lambda errors: errors["network_linear"] <= NO_WORSE * _best(errors, INTERPOLATIONS),
        0.5,
    ),
    Comparison(
        "From 50 samples the linear network is better than the one with tanh",
        ("network_linear", "network_tanh"),
        LONG,
        lambda errors: errors["network_linear"] < errors["network_tanh"],
        0.9,
    ),
    Comparison(
        "At 100 and 200 samples the linear network is better than the recurrent ones",
        ("network_linear", *RECURRENT),
        (100, 200),
        lambda errors: errors["network_linear"] < _best(errors, RECURRENT),
        0.9,
    ),
)
"""The statements on the order of methods."""


def compare(runs: pd.DataFrame, errors: pd.DataFrame, published: pd.DataFrame) -> list[Claim]:
    """Judge what the paper states of the order of methods.

    Methods are compared on the runs whose gaps all of them filled, as their numbers may differ.

    Parameters
    ----------
    runs : DataFrame
        The columns runs.RUN_COLUMNS.
    errors : DataFrame
        See tables.describe_errors.
    published : DataFrame
        The published errors: see tables.arrange_published.

    Returns
    -------
    list of Claim
        One for each of COMPARISONS, and one on the measures of errors.
    """
    why = _of_growth(errors, published)
    return [*(_compare(each, runs, published, why) for each in COMPARISONS), _coherent(errors, published)]


def common_errors(runs: pd.DataFrame, methods: Sequence[str], lengths: Sequence[int]) -> pd.DataFrame:
    """Compute the errors of methods on the runs whose gaps all of them filled.

    Parameters
    ----------
    runs : DataFrame
        The columns runs.RUN_COLUMNS.
    methods : sequence of str
        The methods.
    lengths : sequence of int
        The mean lengths of gaps.

    Returns
    -------
    DataFrame
        RMSE in mm, one row for each recording and length, one column for each method; empty where a method was not run.
    """
    own = runs[runs["method"].isin(methods) & runs["length"].isin(lengths)]
    run = ["recording", "length", "run"]
    filled = own["error"].notna().groupby([own[name] for name in run]).transform("all")
    shared = (own.groupby(run)["method"].transform("nunique") == len(methods)) & filled
    table = error_table(own[shared], ["recording", "length", "method"])
    return table.pivot(index=["recording", "length"], columns="method", values="rmse").reindex(columns=list(methods))


def _of_growth(errors: pd.DataFrame, published: pd.DataFrame) -> str:
    """How much the errors of networks grow with the gap, ours and published, by which the order of methods differs; "" where they do not grow less here."""
    medians = []
    for table, key in ((errors, "recording"), (published, "sequence")):
        own = table[table["method"].isin(NETWORKS)].astype({"rmse": float})
        wide = own.pivot(index=[key, "method"], columns="length", values="rmse").reindex(columns=[SHORT[0], LONG[-1]])
        medians.append((wide[LONG[-1]] / wide[SHORT[0]]).median())
    ours, printed = medians
    if not ours < printed:  # also where one is unknown
        return ""
    return (
        f"; from {SHORT[0]} to {LONG[-1]} samples the errors of networks grow {ours:.1f} times here, {printed:.1f} times in the paper "
        "(medians): ours are those of motion that is not learned, in gaps of any length"
    )


def _compare(comparison: Comparison, runs: pd.DataFrame, published: pd.DataFrame, why: str) -> Claim:
    """Count in how many conditions a statement holds; `why` is said of those on networks and other methods that do not."""
    errors = common_errors(runs, comparison.methods, comparison.lengths)
    printed = published[published["length"].isin(comparison.lengths)]
    printed = printed.pivot(index=["sequence", "length"], columns="method", values="rmse")
    stated = _count(comparison.holds(printed))
    if not len(errors):
        return Claim(comparison.claim, stated, "", UNTESTED, "one of these methods or lengths was not run")
    holds = comparison.holds(errors)
    failing = ", ".join(f"{name} at {length:g}" for name, length in holds.index[~holds])
    enough = bool(holds.mean() >= comparison.share)
    of_networks = set(comparison.methods) & set(NETWORKS) and set(comparison.methods) & {*INTERPOLATIONS, *RECURRENT}
    reason = (f"not {failing}" if failing else "") + (why if of_networks and not enough else "")
    return Claim(comparison.claim, stated, _count(holds), verdict(enough), reason)


def _coherent(errors: pd.DataFrame, published: pd.DataFrame) -> Claim:
    """All measures but the mode name the same best method, where all methods have the same runs."""
    claim = "All measures but the mode name the same best method"
    ours, printed = (
        pd.Series(
            [
                len({table.loc[table[name].idxmin(), "method"] for name in COHERENT}) == 1
                for _, table in own.groupby([key, "length"])
            ],
            dtype=bool,
        )
        for own, key in ((_of_equal_runs(errors), "recording"), (published, "sequence"))
    )
    if not len(ours):
        return Claim(claim, _count(printed), "", UNTESTED, "the methods have different numbers of runs")
    return Claim(claim, _count(printed), _count(ours), verdict(bool(ours.mean() >= 0.5)))


def _of_equal_runs(errors: pd.DataFrame) -> pd.DataFrame:
    """The errors of the methods that have most runs."""
    own = errors[errors["method"] != DEFAULT]
    most = own[own["runs"] == own.groupby(["recording", "length"])["runs"].transform("max")]
    return most[most.groupby(["recording", "length"])["method"].transform("nunique") > 1]


def _count(holds: pd.Series) -> str:
    """In how many conditions a statement holds."""
    return f"{int(holds.sum())} of {len(holds)}"
