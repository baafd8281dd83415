"""The page of the model averaging paper."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import pandas as pd

from markermend.evaluation import charts
from markermend.evaluation.charts import Axes, Chart
from markermend.evaluation.pages import Page, Section
from markermend.evaluation.pma2018.wording import display_name, millimetres
from markermend.report.references import REFERENCES

LEAD = (
    "Concurrent gaps of equal length are hidden at a random frame on random markers, filled by each method, and the error is the mean "
    "distance to the true positions. All methods meet the same gaps. The models and averages follow the text of the paper; the program that "
    "was released with it differs in several points, and is put beside in the tests of the constraints.",
    "The curves of Figures 4 to 7 are printed as drawings only: what is put beside them here is the few figures that the text states. "
    "Of the eight sequences, those are compared whose recordings were given.",
)

FIGURES = {
    "lengths": ("length_s", "length of the gaps, s", "Length of the gaps (Figure 4)"),
    "durations": ("duration_s", "duration of the fragment, s", "Duration of the recording (Figure 5)"),
    "gap_counts": ("gaps", "number of concurrent gaps", "Number of concurrent gaps (Figure 6)"),
}
"""What varies in each figure: its column, its title, and the heading."""


def make_page(tables: Mapping[str, pd.DataFrame]) -> Page:
    """Arrange the tables of the model averaging paper as a page: errors of each figure, means, and constraints.

    Parameters
    ----------
    tables : mapping of str to DataFrame
        The tables of the paper, by their names.

    Returns
    -------
    Page
        The page.
    """
    sections = [_figure(name, tables[name]) for name in FIGURES]
    return Page(
        "Filling of gaps by model averaging",
        REFERENCES["averaging"],
        LEAD,
        [*sections, _means(tables["means"]), _constraints(tables["constraints"])],
    )


def _figure(name: str, table: pd.DataFrame) -> Section:
    """Errors over what varies, a chart for each recording."""
    column, title, heading = FIGURES[name]
    sentences = [
        "Mean errors with their standard errors. PMA is the average of the models with these numbers, weighted by the likelihood of "
        "distances. Diamonds are published figures."
    ]
    if name == "lengths" and "bolero" in set(table["method"]):
        sentences.append("The charts leave out BoLeRo where they would else show nothing but it; it is in the table.")
    drawn = []
    for recording, own in table.groupby("recording", sort=False):
        of_sequence = f" ({own['sequence'].iloc[0]})" if own["sequence"].iloc[0] else ""
        drawn += list(_charts(own, column, title, f"{recording}{of_sequence}"))
    return Section(heading, sentences, f"{name}.tsv", charts=drawn)


def _charts(table: pd.DataFrame, column: str, x_title: str, title: str) -> Iterator[Chart]:
    """A chart of the errors of all methods, and another without BoLeRo, if it is there, as in Figure 4."""
    axes = Axes(column, "error_mm", x_title, "mean error, mm")
    named = table.assign(method=[display_name(method) for method in table["method"]])
    chart = {"by": "method", "published": "published", "error": "standard_error_mm"}
    yield charts.lines(named, axes, title=title, **chart)
    if "bolero" in set(table["method"]):
        yield charts.lines(named[table["method"] != "bolero"], axes, title=f"{title}, without BoLeRo", **chart)


def _means(means: pd.DataFrame) -> Section:
    """Means over the recordings."""
    drawn = []
    for name, (column, title, heading) in FIGURES.items():
        own = means[means["figure"] == name]
        own = own[own["method"] != "bolero"]
        if not own.empty:
            drawn += list(_charts(own, column, title, heading.split(" (")[0]))
    sentences = (
        "Means over the recordings; the published ones are means over eight sequences. A recording that is shorter than a fragment does "
        "not count there, so that the points of long durations stand for fewer recordings.",
    )
    return Section("Means over the recordings (Figure 7)", sentences, "means.tsv", charts=drawn)


def _constraints(constraints: pd.DataFrame) -> Section:
    """The effect of the constraints."""
    sentences = (
        "Errors of the average of the models without and with the time and the spacing constraint, over the same runs: means with their "
        "standard errors, medians, and p of Student's paired test, which the paper used, and of Wilcoxon's. Where means are far above "
        "medians, some runs in which the polynomial regression extrapolates, and no model leads to likely distances, decide them.",
    )
    return Section(
        "Effect of the constraints (Tables 2 and 3)", sentences, "constraints.tsv", table=_with_errors(constraints)
    )


def _with_errors(constraints: pd.DataFrame) -> pd.DataFrame:
    """The table for the page: each mean with its standard error, then the published one."""
    shown = constraints[["sequence", "recording", "table", "variant", "runs"]].copy()
    for name, words in (("unconstrained", "without"), ("constrained", "with")):
        means = zip(constraints[f"{name}_mm"], constraints[f"{name}_standard_error_mm"], strict=True)
        shown[f"{words} constraints, mm"] = [f"{millimetres(mean)} ± {millimetres(error)}" for mean, error in means]
        shown[f"{words}, published"] = constraints[f"{name}_published"]
    for name in ("unconstrained", "constrained"):
        shown[f"{name} median, mm"] = constraints[f"{name}_median_mm"].round(1)
    return shown.assign(
        p=constraints["p"], **{"p, published": constraints["p_published"], "p, Wilcoxon": constraints["p_wilcoxon"]}
    )
