"""What the gap reconstruction paper states, and whether it holds here (skurowski2021, sections 4 and 5).

Statements on the order of methods are counted over recordings and lengths of gaps, ours as well as the published ones.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from scipy.stats import t

from markermend.evaluation.claims import UNTESTED, Claim, claims_table, span, verdict
from markermend.evaluation.gap_errors import error_table
from markermend.evaluation.gaps2021.methods import DEFAULT, INTERPOLATIONS, METHODS, NETWORKS, RECURRENT

SHORT = (10, 20)
"""Mean lengths of gaps that the paper calls short, frames."""

LONG = (50, 100, 200)
"""Those that it calls long."""

NO_WORSE = 1.05
"""Factor on an error up to which another counts as no worse."""

SIGNIFICANT = 0.05
"""Level of significance."""

KEY_DESCRIPTORS = ("acceleration", "monotonicity")
"""The descriptors of which the paper says that they correlate most with the errors."""

COHERENT = ("rmse", "mean", "median", "deviation", "iqr")
"""The measures that name the same best method, by the paper."""

COLLINEAR = 0.9
"""Correlation above which two descriptors are nearly collinear."""

FEW_RECORDINGS = "correlations need three recordings at least"


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


def judge(runs: pd.DataFrame, tables: Mapping[str, pd.DataFrame], published: pd.DataFrame) -> pd.DataFrame:
    """Judge what the paper states.

    Methods are compared on the runs that all of them have, as they may differ in their number.

    Parameters
    ----------
    runs : DataFrame
        The columns runs.RUN_COLUMNS.
    tables : mapping of str to DataFrame
        See tables.make_tables.
    published : DataFrame
        The published errors: see tables.arrange_published.

    Returns
    -------
    DataFrame
        See claims.claims_table.
    """
    compared = [_compare(each, runs, published) for each in COMPARISONS]
    coherent = _coherent(tables["errors"], published)
    return claims_table([*compared, coherent, *_of_correlations(tables), *_of_prints(tables)])


def common_errors(runs: pd.DataFrame, methods: Sequence[str], lengths: Sequence[int]) -> pd.DataFrame:
    """Compute the errors of methods on the runs that all of them have.

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
    shared = own.groupby(run)["method"].transform("nunique") == len(methods)
    table = error_table(own[shared], ["recording", "length", "method"])
    return table.pivot(index=["recording", "length"], columns="method", values="rmse").reindex(columns=list(methods))


def _compare(comparison: Comparison, runs: pd.DataFrame, published: pd.DataFrame) -> Claim:
    """Count in how many conditions a statement holds."""
    errors = common_errors(runs, comparison.methods, comparison.lengths)
    printed = published[published["length"].isin(comparison.lengths)]
    printed = printed.pivot(index=["sequence", "length"], columns="method", values="rmse")
    stated = _count(comparison.holds(printed))
    if not len(errors):
        return Claim(comparison.claim, stated, "", UNTESTED, "one of these methods or lengths was not run")
    holds = comparison.holds(errors)
    failing = ", ".join(f"{name} at {length:g}" for name, length in holds.index[~holds])
    return Claim(
        comparison.claim,
        stated,
        _count(holds),
        verdict(bool(holds.mean() >= comparison.share)),
        f"not {failing}" if failing else "",
    )


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


def _of_correlations(tables: Mapping[str, pd.DataFrame]) -> Iterator[Claim]:
    """Correlations of errors with descriptors."""
    means = tables["mean_correlations"]
    own = means[~means["method"].isin((DEFAULT, "msvd"))].astype({"correlation": float})
    own = own.assign(published=pd.to_numeric(own["published"], errors="coerce")).groupby("descriptor")
    ours, printed = own["correlation"].mean(), own["published"].mean()
    highest, stated = (values.abs().sort_values(ascending=False).index[:2] for values in (ours, printed))
    reason = "" if len(ours) else FEW_RECORDINGS
    yield Claim(
        "Acceleration and monotonicity correlate most with the errors",
        ", ".join(f"{name} {printed[name]:.2f}" for name in stated),
        ", ".join(f"{name} {ours[name]:.2f}" for name in highest),
        verdict(set(highest) == set(KEY_DESCRIPTORS) if len(ours) else None),
        reason,
    )
    rising = ours.drop("complexity", errors="ignore")
    yield Claim(
        "Errors grow with every descriptor but complexity, with which they fall",
        _signs(printed),
        _signs(ours),
        verdict(bool((rising > 0).all() and ours["complexity"] < 0) if len(ours) else None),
        reason,
    )
    yield _significance(tables["correlations"])
    pairs = tables["descriptor_correlations"]
    both = pairs[(pairs["descriptor"] == "deviation") & (pairs["other"] == "velocity")]
    yield Claim(
        "Standard deviation and velocity of a recording are nearly collinear",
        "".join(both["correlation_published"]),
        span(both["correlation"], 3),
        verdict(bool(both["correlation"].min() > COLLINEAR) if len(both) else None),
        reason,
    )


def _significance(table: pd.DataFrame) -> Claim:
    """Which correlations are significant."""
    claim = "Of the correlations that are significant in the paper (p < 0.05) most are so here"
    own = table[table["p"].notna() & ~table["method"].isin((DEFAULT, "msvd"))]
    printed = pd.to_numeric(own["p_published"], errors="coerce")
    stated = own[printed < SIGNIFICANT]
    if not len(stated):
        return Claim(claim, "", "", UNTESTED, FEW_RECORDINGS)
    found, recordings = stated["p"].astype(float) < SIGNIFICANT, int(own["recordings"].max())
    fewer = f"of {recordings} recordings, not 6, only correlations above {_critical(recordings):.3f} are significant"
    return Claim(
        claim,
        f"{len(stated)} of {int(printed.notna().sum())}",
        f"{int(found.sum())} of these {len(stated)}",
        verdict(bool(found.mean() >= 0.5)),
        fewer if recordings < 6 else "",
    )


def _critical(recordings: int) -> float:
    """The correlation that is just significant."""
    quantile = float(t.ppf(1 - SIGNIFICANT / 2, recordings - 2))
    return quantile / float(np.hypot(quantile, np.sqrt(recordings - 2)))


def _of_prints(tables: Mapping[str, pd.DataFrame]) -> Iterator[Claim]:
    """Numbers of parameters, and the column of low-rank completion."""
    table = tables["parameters"].set_index("method")
    printed = table["published"].astype(int)
    for methods in (NETWORKS[:-1], NETWORKS[-1:]):
        own, stated = table.loc[list(methods), "parameters"], printed[list(methods)]
        names = ", ".join(METHODS[name] for name in methods)
        equal = bool((own == stated).all())
        yield Claim(
            f"{names} {'has the number' if len(methods) == 1 else 'have the numbers'} of parameters of Table 4",
            ", ".join(map(str, stated)),
            ", ".join(map(str, own)),
            verdict(equal),
            "" if equal else "the printed formula gives our number; the value beside it is a misprint",
        )
    wide = tables["errors"].pivot(index=["recording", "length"], columns="method", values="rmse")
    tested = {"linear", "msvd"} <= set(wide)
    ratio = wide["msvd"] / wide["linear"] if tested else pd.Series(dtype=float)
    yield Claim(
        "Low-rank completion (mSVD) has the errors of linear interpolation",
        "1.000 times in every row",
        f"{span(ratio, 2)} times" if tested else "",
        verdict(bool((ratio - 1).abs().max() < 0.001) if tested else None),
        "the column of linear interpolation is printed twice: no figure of mSVD can be compared",
    )


def _signs(means: pd.Series) -> str:
    """The range of the correlations, apart from that of complexity."""
    return f"{span(means.drop('complexity'), 2)}, complexity {means['complexity']:.2f}" if len(means) else ""


def _count(holds: pd.Series) -> str:
    """In how many conditions a statement holds."""
    return f"{int(holds.sum())} of {len(holds)}"
