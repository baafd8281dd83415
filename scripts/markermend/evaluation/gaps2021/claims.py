"""What the gap reconstruction paper states, and whether it holds here (skurowski2021, sections 4 and 5)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
import pandas as pd
from scipy.stats import t

from markermend.evaluation.claims import UNTESTED, Claim, claims_table, span, verdict
from markermend.evaluation.gaps2021.comparisons import compare
from markermend.evaluation.gaps2021.methods import DEFAULT, METHODS, NETWORKS

SIGNIFICANT = 0.05
"""Level of significance."""

KEY_DESCRIPTORS = ("acceleration", "monotonicity")
"""The descriptors of which the paper says that they correlate most with the errors."""

COLLINEAR = 0.9
"""Correlation above which two descriptors are nearly collinear."""

FEW_RECORDINGS = "correlations need three recordings at least"


def judge(runs: pd.DataFrame, tables: Mapping[str, pd.DataFrame], published: pd.DataFrame) -> pd.DataFrame:
    """Judge what the paper states.

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
    compared = compare(runs, tables["errors"], published)
    return claims_table([*compared, *_of_correlations(tables), *_of_prints(tables)])


def _of_correlations(tables: Mapping[str, pd.DataFrame]) -> Iterator[Claim]:
    """Correlations of errors with descriptors."""
    means = tables["mean_correlations"]
    own = means[~means["method"].isin((DEFAULT, "msvd"))].astype({"correlation": float})
    own = own.assign(published=pd.to_numeric(own["published"], errors="coerce")).groupby("descriptor")
    ours, printed = own["correlation"].mean(), own["published"].mean()
    highest, stated = (values.abs().sort_values(ascending=False).index[:2] for values in (ours, printed))
    reason = "" if len(ours) else FEW_RECORDINGS
    stated_here = ", ".join(f"{name} {ours[name]:.2f}" for name in stated if name in ours)
    yield Claim(
        "Acceleration and monotonicity correlate most with the errors",
        ", ".join(f"{name} {printed[name]:.2f}" for name in stated),
        ", ".join(f"{name} {ours[name]:.2f}" for name in highest),
        verdict(set(highest) == set(KEY_DESCRIPTORS) if len(ours) else None),
        f"here {stated_here}" if stated_here and set(highest) != set(KEY_DESCRIPTORS) else reason,
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
    limit = f"of {recordings} recordings only correlations above {_critical(recordings):.3f} are significant"
    nearly = stated["correlation"].astype(float).abs() > _critical(recordings) / 2
    sign = stated["correlation"].astype(float) * stated["correlation_published"].astype(float) > 0
    reason = (
        f"{limit}; {int((sign & nearly).sum())} of the {len(stated)} have the printed sign and at least half of that"
    )
    return Claim(
        claim,
        f"{len(stated)} of {int(printed.notna().sum())}",
        f"{int(found.sum())} of these {len(stated)}",
        verdict(bool(found.mean() >= 0.5)),
        reason,
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
