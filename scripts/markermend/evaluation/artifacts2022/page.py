"""The page of the artifact detection paper."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

import pandas as pd

from markermend.evaluation import charts
from markermend.evaluation.artifacts2022.readings import SUDDEN
from markermend.evaluation.charts import Axes, Chart
from markermend.evaluation.classification import CLASSES
from markermend.evaluation.pages import Page, Section
from markermend.report.references import REFERENCES

LEAD = (
    "A clean and denoised recording is contaminated with artifacts of four classes, each in one coordinate of one marker, "
    "and the detectors say of every sample of every coordinate to which class it belongs. Our own detectors look at all axes of a marker "
    "together: where they name several, those that were not distorted count as falsely found. "
    "The recordings of the paper are not public: their figures are put beside those of other recordings, of like length and speed.",
)

NAMES = {
    "paper": "detectors as published",
    "default": "our detectors",
    "coordinates": "ours, each coordinate by itself",
}
"""The presets in words."""


def make_page(tables: Mapping[str, pd.DataFrame]) -> Page:
    """Arrange the tables of the artifact detection paper as a page: classification, readings, repair, and persons.

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
        [section(tables[name]) for name, section in SECTIONS.items() if len(tables[name])],
    )


def _measures(measures: pd.DataFrame) -> Section:
    """The measures of each class (section 4.2.1)."""
    sentences = (
        "TPR is the share of a class that is found as this class; FDR is the share of what is found as the class that is something "
        "else (the paper calls it FPR). Both in %. Diamonds are published figures, which are of the detectors as published.",
    )
    drawn = measures[measures["class"].isin(CLASSES[1:])]
    return Section("Classification of contaminated recordings", sentences, "measures.tsv", charts=list(_rates(drawn)))


def _rates(measures: pd.DataFrame) -> Iterator[Chart]:
    """The rates of each class over the share that is distorted."""
    for (recording, preset, amplitude), own in measures.groupby(["recording", "preset", "amplitude_mm"], sort=False):
        for measure in ("TPR", "FDR"):
            axes = Axes("share_percent", measure, "share of the time that each class distorts, %", f"{measure}, %")
            title = f"{recording}, {NAMES[str(preset)]}, {amplitude:g} mm: {measure}"
            yield charts.lines(own, axes, by="class", title=title, published=f"{measure}_published")


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


def _readings(readings: pd.DataFrame) -> Section:
    """The measures of sudden changes under each reading."""
    sentences = (
        "Where the text leaves a choice, the preset is read as the printed results demand. Here one reading is changed at a time, and sudden "
        "changes are looked for (slow changes stay clean). Some follow the letter: closings over 39 samples are printed.",
    )
    drawn = readings[readings["class"].isin(SUDDEN)]
    maps = []
    for (recording, amplitude, share), own in drawn.groupby(["recording", "amplitude_mm", "share_percent"], sort=False):
        for measure in ("TPR", "FDR"):
            axes = Axes("class", measure, "", f"{measure}, %")
            maps.append(
                charts.bars(own, axes, by="reading", title=f"{recording}, {amplitude:g} mm, {share:g} %: {measure}")
            )
    return Section("Readings of the paper", sentences, "readings.tsv", charts=maps)


def _slow(slow: pd.DataFrame) -> Section:
    """What the detection of slow changes depends on."""
    sentences = (
        "The network learns the recording before it is contaminated (clean), or the one in which it detects (contaminated). What remains is "
        "the part of a slow change that is left in the residual; the deviation of the residual is its standard deviation over the recording. The "
        "upper threshold is three deviations, of each coordinate, each marker, or the recording. The charts have the largest lower threshold. "
        "The paper prints a lower threshold of 0.5, and 0.5 s for the shortest slow change.",
    )
    drawn = slow[slow["lower_sigmas"] == slow["lower_sigmas"].max()]
    names = [
        f"{learned}, {frames} frames, from {duration:g} s, of {'the' if over == 'recording' else 'each'} {over}"
        for learned, frames, over, duration in drawn[
            ["trained_on", "training_frames", "deviation_over", "min_duration_s"]
        ].itertuples(index=False)
    ]
    plots = []
    for (recording, amplitude, share), own in drawn.assign(setting=names).groupby(
        ["recording", "amplitude_mm", "share_percent"], sort=False
    ):
        for measure in ("TPR", "FDR"):
            axes = Axes("network_steps", measure, "steps of the training, at most", f"{measure}, %", log_x=True)
            title = f"{recording}, {amplitude:g} mm, {share:g} %: {measure}"
            plots.append(charts.lines(own, axes, by="setting", title=title))
    return Section("Thresholds of slow changes", sentences, "slow.tsv", charts=plots)


def _repairs(repairs: pd.DataFrame) -> Section:
    """Errors after repair (Tables 3 to 5)."""
    sentences = (
        "Root mean square error over all samples of all coordinates, for as many coordinates as the paper's recordings have. Perfect: what was put "
        "in is repaired; classified: what the published detectors find is, or, for our own repair, what ours find.",
    )
    plots = []
    for (recording, kind, share), own in repairs.groupby(["recording", "class", "share_percent"], sort=False):
        axes = Axes("method", "rmse_mm", "", "error, mm", log_y=True)
        title = f"{recording}, {kind}, {share:g} %"
        plots.append(charts.bars(_with_published(own), axes, by="located", title=title))
    return Section("Repair (Tables 3 to 5)", sentences, "repairs.tsv", charts=plots)


def _with_published(own: pd.DataFrame) -> pd.DataFrame:
    """Our errors, and the published ones as further rows."""
    ours = own.assign(rmse_mm=own["rmse_159_mm"])
    printed = own.assign(
        rmse_mm=pd.to_numeric(own["published"], errors="coerce"), located=own["located"] + ", published"
    )
    return pd.concat([ours, printed.dropna(subset=["rmse_mm"])])


def _operators(operators: pd.DataFrame) -> Section:
    """Findings of persons and of the algorithm (Table 2)."""
    sentences = (
        "What a person found is confirmed where the algorithm finds anything on this marker in any of its frames, or else missed, in the words "
        "of the paper. What the algorithm finds is approved where the person found the same class there, or else rejected. "
        "The published network learns the recording in which it detects.",
    )
    return Section("Persons and the algorithm (Table 2)", sentences, "operators.tsv")


SECTIONS: Mapping[str, Callable[[pd.DataFrame], Section]] = {
    "measures": _measures,
    "confusion": _confusion,
    "readings": _readings,
    "slow": _slow,
    "repairs": _repairs,
    "operators": _operators,
}
"""The sections of the page, by their tables; those without rows are left out."""
