"""The page of the gap reconstruction paper."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import pandas as pd

from markermend.evaluation import charts
from markermend.evaluation.charts import Axes, Chart
from markermend.evaluation.gaps2021.methods import DEFAULT, INTERPOLATIONS, METHODS, NETWORKS
from markermend.evaluation.pages import Page, Section
from markermend.report.references import REFERENCES

LEAD = (
    "Two gaps of a mean length are hidden in a clean recording, each in a random marker, and filled by five networks, which learn from the "
    "rest of the recording, by four interpolations, by low-rank completion, and by our default ensemble. All methods fill the same gaps; where "
    "slow ones have fewer runs, as the tables say, statements compare methods on the runs that they share.",
    "The published figures are of six other sequences, which are no part of this program; they stand beside those of recordings that are "
    "like them. Errors depend on how fast and how varied a motion is: compare the order of the methods, and how errors grow with the length of gaps.",
)

LOGARITHMIC = {"log_x": True, "log_y": True}


def make_page(tables: Mapping[str, pd.DataFrame]) -> Page:
    """Arrange the tables of the gap reconstruction paper as a page: errors, networks, descriptors, and correlations.

    Parameters
    ----------
    tables : mapping of str to DataFrame
        The tables of the paper, by their names.

    Returns
    -------
    Page
        The page.
    """
    sections = [
        _errors(tables["errors"]),
        _statistics(tables["errors"]),
        _criteria(tables["criteria"]),
        _parameters(),
        _descriptors(),
        _mean_correlations(tables["mean_correlations"]),
        _correlations(),
        _descriptor_correlations(),
    ]
    return Page("Reconstruction of gaps", REFERENCES["mesh"], LEAD, sections)


def _errors(errors: pd.DataFrame) -> Section:
    """Errors over the length of gaps (Figures 7 and 8)."""
    sentences = (
        "RMSE is the root mean square error over all coordinates of all gaps, in mm; diamonds are published figures of the sequence that "
        "a recording is like. The published column mSVD repeats linear interpolation in every row, so it is no figure of low-rank completion, and not drawn.",
    )
    printed = errors["rmse_published"].where(errors["method"] != "msvd", "")
    drawn = []
    for _, own in errors.assign(rmse_published=printed).groupby("recording", sort=False):
        for name, methods in (
            ("networks", NETWORKS),
            ("interpolations and low-rank completion", (*INTERPOLATIONS, "msvd")),
        ):
            shown = _named(own[own["method"].isin((*methods, DEFAULT))])
            axes = Axes("length", "rmse", "mean length of gaps, frames", "RMSE, mm", **LOGARITHMIC)
            title = f"{_title(own)}: {name}"
            drawn.append(charts.lines(shown, axes, by="method", title=title, published="rmse_published"))
    return Section(
        "Errors over the length of gaps (Tables 3, A1 to A5, Figures 7 and 8)", sentences, "errors.tsv", charts=drawn
    )


def _statistics(errors: pd.DataFrame) -> Section:
    """Statistics of the errors of single gaps (Figure 7)."""
    sentences = (
        "Statistics of the errors of single gaps (RMSE_k). The mode is the smallest of them, as Matlab gives it of values that all differ.",
    )
    longest = errors["length"].max()
    drawn = []
    for _, own in errors[errors["length"] == longest].groupby("recording", sort=False):
        long = _named(own).melt(["method"], ["rmse", "mean", "median", "mode", "iqr"], "statistic", "mm")
        axes = Axes("method", "mm", "method", "error, mm")
        drawn.append(charts.bars(long, axes, by="statistic", title=f"{_title(own)}, gaps of {longest:g} frames"))
    return Section(
        "Statistics of the errors of gaps (Figure 7)", sentences, "errors.tsv", table=errors.head(0), charts=drawn
    )


def _criteria(criteria: pd.DataFrame) -> Section:
    """Information criteria over the length of the training sequence (Figure 9)."""
    sentences = (
        "Akaike's and the Bayesian information criterion, and the mean square error, of the networks over the number of frames of which they "
        "learn. A gap has a network of its own, whose test data are the coordinates in the gap; criteria are means over the gaps. The paper "
        "prints no figures, and does not say how it counts test data.",
    )
    drawn = []
    for name, title in (("aic", "AIC"), ("bic", "BIC"), ("mean_square_error", "mean square error, mm²")):
        axes = Axes(
            "training_frames", name, "frames of which a network learns", title, log_y=name == "mean_square_error"
        )
        drawn.append(
            charts.points(
                _named(criteria), axes, by="method", title=f"{title} over the length of the training sequence"
            )
        )
    return Section("Information criteria (Figure 9)", sentences, "criteria.tsv", charts=drawn)


def _parameters() -> Section:
    """Numbers of parameters (Table 4)."""
    sentences = (
        "The exemplary case has the coordinates of five markers, now and one frame before. The printed numbers belong to recurrent layers "
        "that the outputs follow at once; the text has a hidden layer between. That of BILSTM does not follow from its own formula.",
    )
    return Section("Numbers of parameters (Table 4)", sentences, "parameters.tsv")


def _descriptors() -> Section:
    """Descriptors of recordings (Table 2)."""
    sentences = (
        "Entropy in bits a marker, standard deviation in mm a coordinate, velocity in m/s, acceleration in m/s², jerk in m/s³. Monotonicity is the "
        "mean absolute rank correlation with time; with signs, as it is printed, it would be near 0. The estimator of the entropy is not given.",
    )
    return Section("Descriptors of recordings (Table 2)", sentences, "descriptors.tsv")


def _mean_correlations(means: pd.DataFrame) -> Section:
    """Correlations of errors with descriptors, averaged (Table 5)."""
    sentences = (
        "Pearson's correlation over the recordings, averaged over the lengths of gaps. Those of the paper are of six sequences.",
    )
    return Section("Errors and descriptors (Table 5)", sentences, "mean_correlations.tsv", charts=list(_bars(means)))


def _bars(means: pd.DataFrame) -> Iterator[Chart]:
    """Our correlations beside the published ones."""
    for method in (name for name in ("network_linear", "spline") if name in set(means["method"])):
        own = means[means["method"] == method].assign(ours=lambda table: table["correlation"])
        long = own.melt(["descriptor"], ["ours", "published"], "whose", "value")
        long["value"] = pd.to_numeric(long["value"], errors="coerce")
        axes = Axes("descriptor", "value", "descriptor", "mean correlation")
        yield charts.bars(long, axes, by="whose", title=f"{METHODS[method]}: mean correlation with RMSE")


def _correlations() -> Section:
    """Correlations at each length (Tables A6 to A12)."""
    sentences = ("The same at each length, with p of no correlation.",)
    return Section("Errors and descriptors at each length (Tables A6 to A12)", sentences, "correlations.tsv")


def _descriptor_correlations() -> Section:
    """Correlations between descriptors (Table 6)."""
    return Section(
        "Descriptors among themselves (Table 6)", ("Pearson's correlation, with p.",), "descriptor_correlations.tsv"
    )


def _named(table: pd.DataFrame) -> pd.DataFrame:
    """A table with the methods as the paper names them."""
    return table.assign(method=table["method"].map(METHODS))


def _title(own: pd.DataFrame) -> str:
    """A recording, and the sequence of the paper that it is like."""
    recording, sequence = own.iloc[0][["recording", "sequence"]]
    return f"{recording}, diamonds: {sequence}" if sequence else str(recording)
