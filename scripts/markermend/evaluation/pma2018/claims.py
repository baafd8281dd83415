"""What the model averaging paper states, and whether it holds here (tits2018, Results)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
import pandas as pd

from markermend.evaluation.claims import Claim, claims_table, verdict
from markermend.evaluation.pma2018 import reasons
from markermend.evaluation.pma2018.methods import average
from markermend.evaluation.pma2018.options import Pma2018Options
from markermend.evaluation.pma2018.tables import CONDITION
from markermend.evaluation.pma2018.wording import display_name, millimetres

SIGNIFICANT = 0.05
"""An effect is significant if p is smaller, as in the paper."""

COMPARABLE = 1.1
"""Errors are comparable if they differ by less than this factor."""

IN_GENERAL = 0.75
"""What holds in general holds in this share of the cases."""


def judge(tables: Mapping[str, pd.DataFrame], options: Pma2018Options) -> pd.DataFrame:
    """Judge what the paper states.

    Parameters
    ----------
    tables : mapping of str to DataFrame
        The tables of the paper by their names, without the claims.
    options : Pma2018Options
        What was run.

    Returns
    -------
    DataFrame
        See claims.claims_table.
    """
    lengths, gap_counts = (wide(tables[name]) for name in ("lengths", "gap_counts"))
    durations = wide(tables["durations"])
    return claims_table(
        [
            *_on_models(lengths, options),
            *_on_averages(pd.concat([lengths, durations, gap_counts]), options),
            _on_durations(durations),
            _growing(gap_counts, "gaps", "The error of all methods grows with the number of concurrent gaps"),
            *_on_means(tables["means"]),
            *_on_constraints(tables["constraints"]),
        ]
    )


def wide(table: pd.DataFrame) -> pd.DataFrame:
    """Arrange the mean errors of a figure by recording and condition.

    Parameters
    ----------
    table : DataFrame
        See tables.figure_table.

    Returns
    -------
    DataFrame
        One row for each recording and condition, one column for each published method, mm; the levels of the index are `sequence`,
        `recording` and those of the condition.
    """
    own = table[table["method"] != "default"]
    own = own.assign(duration_s=own["duration_s"].astype(float).fillna(np.inf))
    return own.pivot(index=["sequence", "recording", *CONDITION], columns="method", values="error_mm")


def _on_models(lengths: pd.DataFrame, options: Pma2018Options) -> Iterator[Claim]:
    """On Figure 4."""
    claim = "BoLeRo has larger errors than all other methods"
    if "bolero" in lengths and len(lengths.columns) > 1:
        run = lengths.dropna()
        largest = run["bolero"] > run.drop(columns="bolero").max(axis=1)
        yield _counted(claim, "in all conditions of CMU1 and CMU3", largest, reason=reasons.WINDOW)
    else:
        yield Claim(claim, "in all conditions of CMU1 and CMU3", "", verdict(None), reasons.NOT_RUN)
    yield _growing(lengths, "length_s", "The error of all methods grows with the length of the gaps")
    claim = "On CMU1 the local GRNN is the best single model in gaps of 5 s"
    own = lengths[
        (lengths.index.get_level_values("sequence") == "CMU1") & (lengths.index.get_level_values("length_s") == 5)
    ]
    known = [name for name in options.models if name in own]
    if own.empty or "local_grnn" not in known or len(known) < 2:
        yield Claim(claim, "20.2 mm", "", verdict(None), reasons.NO_SUCH_SEQUENCE if own.empty else reasons.NOT_RUN)
        return
    errors = own[known].iloc[0]
    best = str(errors.idxmin())
    ours = f"{errors['local_grnn']:.1f} mm" + (
        "" if best == "local_grnn" else f"; {display_name(best)} {errors[best]:.1f} mm"
    )
    yield Claim(claim, "20.2 mm", ours, verdict(best == "local_grnn"))


def _on_averages(errors: pd.DataFrame, options: Pma2018Options) -> Iterator[Claim]:
    """On the averages in Figures 4 to 6; errors: all conditions, some of them twice."""
    errors = errors[~errors.index.duplicated()]
    names = [average(numbers, options).name for numbers in options.averages]
    names = [name for name in names if name in errors]
    models = [name for name in options.models if name in errors]
    claims = (
        "The averages have errors like that of the best single model of the condition, or smaller ones",
        "The average of models 1, 3, 4 and 5 is the best",
        "Local interpolation is the least effective single model",
    )
    published = (
        f"comparable in general (here: less than {COMPARABLE:g} times in {100 * IN_GENERAL:g} %)",
        "pma_1_3_4_5",
        "local_interpolation",
    )
    if names and len(models) > 1:
        ratio = errors[names].div(errors[models].min(axis=1), axis=0)
        yield _counted(claims[0], published[0], ratio.stack().dropna() < COMPARABLE, share=IN_GENERAL)
    else:
        yield Claim(claims[0], published[0], "", verdict(None), reasons.NOT_RUN)
    for claim, figure, own, pick in ((claims[1], published[1], names, "min"), (claims[2], published[2], models, "max")):
        if figure not in own or len(own) < 2:
            yield Claim(claim, display_name(figure), "", verdict(None), reasons.NOT_RUN)
            continue
        means = np.exp(np.log(errors[own]).mean())
        chosen = str(means.idxmin() if pick == "min" else means.idxmax())
        ours = "; ".join(f"{display_name(name)} {value:.2f} mm" for name, value in means.items())
        yield Claim(claim, display_name(figure), f"geometric means: {ours}", verdict(chosen == figure))


def _on_durations(durations: pd.DataFrame) -> Claim:
    """On Figure 5."""
    claim = "Errors are larger in fragments of 5 s than of 10 s"
    levels = durations.index.get_level_values("duration_s")
    short, longer = (durations[levels == duration].droplevel("duration_s") for duration in (5, 10))
    both = short.index.intersection(longer.index)
    if len(both):
        return _counted(claim, "on most sequences", _larger(short.loc[both], longer.loc[both]), share=0.5)
    return Claim(claim, "on most sequences", "", verdict(None), "no recording has fragments of both durations")


def _growing(errors: pd.DataFrame, level: str, claim: str) -> Claim:
    """A claim that all errors are larger at the last value of a level of the condition than at the first."""
    values = errors.index.get_level_values(level)
    if errors.empty or values.min() == values.max():
        return Claim(claim, "all", "", verdict(None), reasons.NOT_RUN)
    first, last = (errors[values == value].droplevel(level) for value in (values.min(), values.max()))
    both = first.index.intersection(last.index)
    return _counted(claim, "all", _larger(last.loc[both], first.loc[both]))


def _larger(one: pd.DataFrame, other: pd.DataFrame) -> pd.Series:
    """Whether each error is larger than the other, where both are known."""
    difference = (one - other).stack().dropna()
    return difference > 0


def _counted(claim: str, published: str, holds: pd.Series, *, share: float = 1.0, reason: str = "") -> Claim:
    """A claim that holds if it does in a share of the cases, and the reason where it does not."""
    if holds.empty:
        return Claim(claim, published, "", verdict(None), reasons.NOT_RUN)
    enough = bool(holds.mean() >= share)
    return Claim(claim, published, f"in {int(holds.sum())} of {len(holds)}", verdict(enough), "" if enough else reason)


def _on_means(means: pd.DataFrame) -> Iterator[Claim]:
    """On Figure 7: the best single models, and the mean errors that the text states."""
    rows = (
        ("lengths", 5.0, np.nan, "local_grnn", "10 mm", "In gaps of 5 s the local GRNN has the smallest mean error of all single models"),
        ("durations", 1.0, 5.0, "local_grnn", "12 mm", "In fragments of 5 s the local GRNN has the smallest mean error of all single models"),
        ("durations", 1.0, 40.0, "linear_regression", "9 mm", "In fragments of 40 s the global regression has the smallest mean error of all single models"),
    )  # fmt: skip
    for figure, length, duration, method, published, claim in rows:
        own = means[(means["figure"] == figure) & (means["length_s"] == length)]
        own = own[(own["duration_s"] == duration) | (np.isnan(duration) & own["duration_s"].isna())]
        own = own[~own["method"].str.startswith(("pma", "default"))].set_index("method")
        if method not in own.index or len(own) < 2:
            yield Claim(
                claim,
                published,
                "",
                verdict(None),
                reasons.NOT_RUN if own.empty and figure == "lengths" else reasons.TOO_SHORT,
            )
            continue
        best = str(own["error_mm"].idxmin())
        ours = "; ".join(
            f"{display_name(name)} {own.loc[name, 'error_mm']:.1f} mm" for name in dict.fromkeys((best, method))
        )
        yield Claim(claim, published, ours, verdict(best == method), "" if best == method else reasons.FEW_RECORDINGS)


def _on_constraints(constraints: pd.DataFrame) -> Iterator[Claim]:
    """On Tables 2 and 3: sign and significance of the effect, and the errors."""
    printed = constraints[["unconstrained_published", "constrained_published", "p_published"]]
    stated = constraints[(printed != "").all(axis=1)]
    if stated.empty:
        reason = reasons.NOT_RUN if constraints.empty else reasons.NOT_PRINTED
        yield Claim("The constraints reduce the error", "", "", verdict(None), reason)
    for row in stated.to_dict("records"):
        where = (
            f"{row['sequence']}, {row['gaps']} gaps of {row['length_s']:g} s (Table {row['table']}, {row['variant']})"
        )
        significant = float(row["p_published"].strip("< ").replace("10e", "1e")) < SIGNIFICANT
        effect = "significantly reduce the error" if significant else "have no significant effect"
        published = f"{row['unconstrained_published']} to {row['constrained_published']} mm, p {row['p_published']}"
        # Where a regression extrapolated beyond all bounds, only ranks can be tested.
        name, p = ("p", row["p"]) if np.isfinite(row["unconstrained_mm"]) else ("Wilcoxon's p", row["p_wilcoxon"])
        ours = f"{millimetres(row['unconstrained_mm'])} to {millimetres(row['constrained_mm'])} mm, {name} {p:.2g}"
        same = (p < SIGNIFICANT) == significant and (row["difference_mm"] > 0 or not significant)
        yield Claim(
            f"The constraints {effect}: {where}",
            published,
            ours,
            verdict(bool(same)),
            "" if same else reasons.why_another_effect(row),
        )
        error, figure = row["constrained_standard_error_mm"], float(row["constrained_published"])
        near = abs(row["constrained_mm"] - figure) <= 2 * np.sqrt(2) * error
        spread = f"{row['constrained_mm']:.1f} mm, standard error {error:.1f}"
        smoothed = not near and row["variant"] == "text" and row["constrained_mm"] < figure
        text = f"The mean error with the constraints is as published, within chance: {where}"
        yield Claim(text, f"{figure:g} mm", spread, verdict(bool(near)), reasons.SMOOTHED if smoothed else "")
