"""The page of the artifact detection paper."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import pandas as pd

from markermend.evaluation import charts
from markermend.evaluation.charts import Axes, Chart
from markermend.evaluation.classification import CLASSES
from markermend.evaluation.pages import Page, Section
from markermend.report.methods_text import REFERENCES

LEAD = (
    "A clean and denoised recording is contaminated with artifacts of four classes, each in one coordinate of one marker, "
    "and the detectors say of every sample of every coordinate to which class it belongs. "
    "The recordings of the paper are not public: their figures are put beside those of other recordings, of like length and speed.",
)

NAMES = {
    "paper": "detectors as published",
    "default": "our detectors",
    "coordinates": "ours, each coordinate by itself",
}
"""The presets in words."""


def make_page(tables: Mapping[str, pd.DataFrame]) -> Page:
    """Put the page together.

    Parameters
    ----------
    tables : mapping of str to DataFrame
        The tables of the paper, by their names.

    Returns
    -------
    Page
        The page.
    """
    return Page(
        "Detection of artifacts",
        REFERENCES["artifacts"],
        LEAD,
        [_measures(tables["measures"]), _confusion(tables["confusion"])],
    )


def _measures(measures: pd.DataFrame) -> Section:
    """The measures of each class (section 4.2.1)."""
    sentences = (
        "TPR is the share of a class that is found as this class; FDR is the share of what is found as the class that is something "
        "else (the paper calls it FPR). Both in %. Diamonds are published figures.",
    )
    drawn = measures[measures["class"].isin(CLASSES[1:])]
    return Section("Classification of contaminated recordings", sentences, "measures.tsv", charts=list(_rates(drawn)))


def _rates(measures: pd.DataFrame) -> Iterator[Chart]:
    """The rates of each class over the share that is distorted."""
    for (recording, preset, amplitude), own in measures.groupby(["recording", "preset", "amplitude_mm"], sort=False):
        for measure in ("TPR", "FDR"):
            axes = Axes("share_percent", measure, "share of the time that each class distorts, %", f"{measure}, %")
            title = f"{recording}, {NAMES[str(preset)]}, {amplitude:g} mm: {measure}"
            printed = f"{measure}_published" if preset == "paper" else None
            yield charts.lines(own, axes, by="class", title=title, published=printed)


def _confusion(confusion: pd.DataFrame) -> Section:
    """Averaged confusion matrices (Figures 12 and 13)."""
    maps = []
    for (recording, preset, amplitude, share), own in confusion.groupby(
        ["recording", "preset", "amplitude_mm", "share_percent"], sort=False
    ):
        title = f"{recording}, {NAMES[str(preset)]}, {amplitude:g} mm, {share:g} %"
        indexed = own.set_index("true")
        maps.append(charts.matrix(indexed, columns=CLASSES, title=title, x_title="found", y_title="true"))
    sentences = ("Mean number of samples a run, by true and by found class; colours are shares of the true class.",)
    return Section("Averaged confusion matrices (Figures 12 and 13)", sentences, "confusion.tsv", charts=maps)
