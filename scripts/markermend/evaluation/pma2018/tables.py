"""The tables of the experiments, with the published figures beside ours (tits2018, Results)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product

import numpy as np
import pandas as pd
from scipy.stats import ttest_rel, wilcoxon

from markermend.evaluation.pma2018.jobs import TEST, Condition, figure_conditions, tested_conditions
from markermend.evaluation.pma2018.methods import UNCONSTRAINED, average
from markermend.evaluation.pma2018.options import Pma2018Options
from markermend.evaluation.published_figures import add_sequences, beside

CONDITION = ["gaps", "length_s", "duration_s"]
"""The columns of a condition; the duration is missing where the whole recording is used."""

WHOLE = "whole"
"""What stands for the duration where the whole recording is used, when figures are matched."""

MEAN = ["recordings", *CONDITION, "method", "error_mm", "standard_error_mm", "published"]
"""The columns of the table of means over recordings."""


def all_tables(runs: pd.DataFrame, figures: pd.DataFrame, options: Pma2018Options) -> dict[str, pd.DataFrame]:
    """Put the runs into tables.

    Parameters
    ----------
    runs : DataFrame
        The columns runs.RUN_COLUMNS.
    figures : DataFrame
        The published figures; see published_figures.read_published.
    options : Pma2018Options
        What was run.

    Returns
    -------
    dict of str to DataFrame
        The tables by their names, without the claims.
    """
    errors = run_errors(runs)
    drawn = {name: figure_table(errors, name, figures, options) for name in figure_conditions(options)}
    return {**drawn, "means": mean_table(drawn, figures), "constraints": constraint_table(errors, figures, options)}


def run_errors(runs: pd.DataFrame) -> pd.DataFrame:
    """Average the errors of the gaps of each run.

    Parameters
    ----------
    runs : DataFrame
        The columns runs.RUN_COLUMNS.

    Returns
    -------
    DataFrame
        One row for each run and method: recording, procedure, condition, method, run, and `error_mm`; NaN where a gap was not filled.

    References
    ----------
    tits2018, eq 28.
    """
    keys = ["recording", "procedure", *CONDITION, "method", "run"]
    errors = runs.assign(error_mm=pd.to_numeric(runs["error_mm"]), duration_s=pd.to_numeric(runs["duration_s"]))
    grouped = errors.groupby(keys, sort=False, dropna=False)["error_mm"]
    return grouped.agg(lambda own: own.mean(skipna=False)).reset_index()


def figure_table(errors: pd.DataFrame, name: str, figures: pd.DataFrame, options: Pma2018Options) -> pd.DataFrame:
    """Put the errors of a figure into a table.

    Parameters
    ----------
    errors : DataFrame
        See run_errors.
    name : str
        `lengths` (Figure 4), `durations` (Figure 5) or `gap_counts` (Figure 6).
    figures : DataFrame
        The published figures; see published_figures.read_published.
    options : Pma2018Options
        What was run.

    Returns
    -------
    DataFrame
        One row for each recording, condition and method: number of runs, of those in which a gap was not filled, mean error, its standard
        error and the median of the runs in mm, and the published mean.
    """
    chosen = _of_conditions(errors, figure_conditions(options)[name])
    chosen = chosen[~chosen["procedure"].str.startswith(TEST)]
    keys = ["recording", *CONDITION, "method"]
    rows = [(*key, *_statistics(own["error_mm"])) for key, own in chosen.groupby(keys, sort=False, dropna=False)]
    ours = pd.DataFrame(rows, columns=[*keys, "runs", "unfilled", "error_mm", "standard_error_mm", "median_mm"])
    own = figures[(figures["table"] == "text") & (figures["quantity"] == "error_mm") & (figures["sequence"] != "")]
    return _beside_conditions(add_sequences(ours, options.published_as), own, on=["sequence", "method"])


def mean_table(tables: Mapping[str, pd.DataFrame], figures: pd.DataFrame) -> pd.DataFrame:
    """Average the errors over the recordings (Figure 7).

    Parameters
    ----------
    tables : mapping of str to DataFrame
        See figure_table, by their names.
    figures : DataFrame
        The published figures.

    Returns
    -------
    DataFrame
        One row for each condition of each figure and each method: the number of recordings, the mean of their errors with its standard
        error by chance of the gaps, in mm, and the published mean over eight recordings.
    """
    parts = []
    for name, table in tables.items():
        grouped = table.groupby([*CONDITION, "method"], sort=False, dropna=False)
        means = grouped.agg(
            recordings=("error_mm", "count"),
            error_mm=("error_mm", "mean"),
            standard_error_mm=("standard_error_mm", lambda own: np.sqrt((own**2).sum()) / own.count()),
        )
        parts.append(means.reset_index().assign(figure=name))
    text = figures[(figures["table"] == "text") & (figures["quantity"] == "error_mm") & (figures["sequence"] == "")]
    return _beside_conditions(pd.concat(parts, ignore_index=True), text, on=["method"])[["figure", *MEAN]]


def constraint_table(errors: pd.DataFrame, figures: pd.DataFrame, options: Pma2018Options) -> pd.DataFrame:
    """Test the effect of the constraints (Tables 2 and 3).

    Parameters
    ----------
    errors : DataFrame
        See run_errors.
    figures : DataFrame
        The published figures.
    options : Pma2018Options
        What was run.

    Returns
    -------
    DataFrame
        One row for each published table, recording and variant of the paper: number of runs, mean errors without and with the constraints, their
        standard errors, medians and difference in mm, p of Student's paired test and of Wilcoxon's, and the published figures.

    References
    ----------
    tits2018, Tables 2 and 3.
    """
    name = average(options.tested_average, options).name
    rows = []
    for (table, condition), variant in product(tested_conditions(options).items(), options.constraint_runs):
        own = _of_conditions(errors, [condition])
        own = own[own["procedure"] == TEST + variant]
        for recording, each in own.groupby("recording", sort=False):
            paired = each.pivot(index="run", columns="method", values="error_mm").dropna()
            if len(paired) > 1:
                where = table, recording, variant, condition.gaps, condition.length_s
                rows.append((*where, len(paired), *_paired(paired[name + UNCONSTRAINED], paired[name])))
    ours = pd.DataFrame(rows, columns=["table", "recording", "variant", "gaps", "length_s", "runs", *PAIRED])
    out = add_sequences(ours[["recording", *ours.columns.drop("recording")]], options.published_as)
    named = {"unconstrained": name + UNCONSTRAINED, "constrained": name, "p": ""}
    for column, method in named.items():
        own = figures[(figures["method"] == method) & (figures["quantity"] == ("p" if column == "p" else "error_mm"))]
        own = own[own["table"].isin(options.constraint_tests)].drop(columns="method")
        own = own if name in set(figures["method"]) else own[:0]  # the printed p is that of the printed average alone
        out = beside(out, own, on=["table", "sequence", "gaps", "length_s"], name=f"{column}_published")
    return out


PAIRED = (
    "unconstrained_mm", "unconstrained_standard_error_mm", "unconstrained_median_mm", "constrained_mm", "constrained_standard_error_mm",
    "constrained_median_mm", "difference_mm", "p", "p_wilcoxon",
)  # fmt: skip
"""What a paired test states."""


def _paired(without: pd.Series, constrained: pd.Series) -> Sequence[float]:
    """The values of PAIRED."""
    same = bool((without == constrained).all())
    with np.errstate(invalid="ignore"):  # an error may be infinite
        described = [value for own in (without, constrained) for value in (own.mean(), own.sem(), own.median())]
        p = np.nan if same else float(ttest_rel(without, constrained).pvalue)
        ranks = np.nan if same else float(wilcoxon(without, constrained).pvalue)
    return [*described, without.mean() - constrained.mean(), p, ranks]


def _statistics(errors: pd.Series) -> tuple[int, int, float, float, float]:
    """Number of runs, of runs that were not filled, mean, standard error and median of the others."""
    known = errors.dropna()
    return len(errors), len(errors) - len(known), known.mean(), known.sem(), known.median()


def _beside_conditions(ours: pd.DataFrame, figures: pd.DataFrame, *, on: Sequence[str]) -> pd.DataFrame:
    """Put published figures beside ours of the same condition: those of whole recordings stand for no fragments."""
    whole, printed = (
        table.assign(duration_s=table["duration_s"].astype(object).where(table["duration_s"].notna(), WHOLE))
        for table in (ours, figures)
    )
    return ours.assign(published=beside(whole, printed, on=[*CONDITION, *on])["published"])


def _of_conditions(errors: pd.DataFrame, conditions: Sequence[Condition]) -> pd.DataFrame:
    """The rows of some conditions, in their order."""
    places = {
        (own.gaps, own.length_s, -1.0 if own.duration_s is None else own.duration_s): k
        for k, own in enumerate(conditions)
    }
    keys = zip(errors["gaps"], errors["length_s"], errors["duration_s"].fillna(-1), strict=True)
    place = pd.Series([places.get(key, -1) for key in keys], index=errors.index, dtype=int)
    return errors[place >= 0].iloc[np.argsort(place[place >= 0], kind="stable")]
