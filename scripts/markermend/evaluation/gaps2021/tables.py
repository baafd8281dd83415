"""The tables of the experiment, with the published figures beside ours (skurowski2021, Tables 2 to 4 and A1 to A5)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pandas as pd

from markermend.evaluation.gap_errors import error_table
from markermend.evaluation.gaps2021.correlation_tables import average_correlations, correlate, correlate_descriptors
from markermend.evaluation.gaps2021.fillings import COLUMNS_PER_INPUT
from markermend.evaluation.gaps2021.methods import NETWORKS
from markermend.evaluation.gaps2021.options import Gaps2021Options
from markermend.evaluation.gaps2021.row_order import in_order
from markermend.evaluation.gaps2021.runs import CONDITION
from markermend.evaluation.information_criteria import information_criteria
from markermend.evaluation.published_figures import add_sequences, beside
from markermend.prediction.neural_network.architecture import learnable_parameters
from markermend.prediction.neural_network.predictor import KINDS

STATISTICS = ("rmse", "mean", "median", "mode", "deviation", "iqr")
"""The statistics of the errors that the paper prints (Tables 3 and A1 to A5)."""

EXEMPLARY_MARKERS = 5
"""Inputs of the exemplary case of Table 4: its numbers follow from 30 inputs, six for each marker."""

AXES = 3
"""Coordinates of a sample: the test data of a network are coordinates."""


def make_tables(
    runs: pd.DataFrame, descriptors: pd.DataFrame, figures: pd.DataFrame, options: Gaps2021Options
) -> dict[str, pd.DataFrame]:
    """Make the tables of the experiment but that of claims.

    Parameters
    ----------
    runs : DataFrame
        The columns runs.RUN_COLUMNS.
    descriptors : DataFrame
        See runs.describe; one row for each recording.
    figures : DataFrame
        Those of skurowski2021; see published_figures.read_published.
    options : Gaps2021Options
        The networks, and which recordings are like which sequences.

    Returns
    -------
    dict of str to DataFrame
        The tables by the names of their files.
    """
    errors = describe_errors(runs, figures, options.published_as)
    correlated = correlate(errors, descriptors, figures)
    return {
        "errors": errors,
        "descriptors": list_descriptors(descriptors, figures, options.published_as),
        "parameters": list_parameters(options, runs, figures),
        "criteria": list_criteria(runs),
        "correlations": correlated,
        "mean_correlations": average_correlations(correlated, figures),
        "descriptor_correlations": correlate_descriptors(descriptors, figures),
    }


def describe_errors(
    runs: pd.DataFrame, figures: pd.DataFrame, published_as: Mapping[str, Sequence[str]]
) -> pd.DataFrame:
    """Describe the errors of each method (Tables 3 and A1 to A5).

    Parameters
    ----------
    runs : DataFrame
        The columns runs.RUN_COLUMNS.
    figures : DataFrame
        Those of skurowski2021; see published_figures.read_published.
    published_as : mapping of str to sequence of str
        The recordings by the names of the sequences of the paper.

    Returns
    -------
    DataFrame
        One row for each recording, length and method: the sequence of the paper, numbers of runs and gaps, the statistics, and each as
        it is printed.
    """
    table = error_table(runs, CONDITION)
    counts = runs.groupby(CONDITION)["run"].nunique().rename("runs").reset_index()
    table = in_order(table.merge(counts, on=CONDITION))
    table = add_sequences(table, published_as)
    for name in STATISTICS:
        printed = figures[(figures["quantity"] == name) & (figures["sequence"] != "")]
        table = beside(table, printed, on=["sequence", "length", "method"], name=f"{name}_published")
    pairs = [column for name in STATISTICS for column in (name, f"{name}_published")]
    return table[["recording", "sequence", "length", "method", "runs", "gaps", "unfilled", *pairs]]


def arrange_published(figures: pd.DataFrame) -> pd.DataFrame:
    """Arrange the published errors as ours are.

    Parameters
    ----------
    figures : DataFrame
        Those of skurowski2021.

    Returns
    -------
    DataFrame
        One row for each sequence, length and method, with STATISTICS as columns.
    """
    own = figures[figures["quantity"].isin(STATISTICS) & (figures["sequence"] != "")]
    keys = ["sequence", "length", "method"]
    return own.pivot(index=keys, columns="quantity", values="value").reset_index()


def list_descriptors(
    descriptors: pd.DataFrame, figures: pd.DataFrame, published_as: Mapping[str, Sequence[str]]
) -> pd.DataFrame:
    """List the descriptors of recordings (Table 2).

    Parameters
    ----------
    descriptors : DataFrame
        See runs.describe; one row for each recording.
    figures : DataFrame
        Those of skurowski2021.
    published_as : mapping of str to sequence of str
        The recordings by the names of the sequences of the paper.

    Returns
    -------
    DataFrame
        One row for each recording and descriptor: the sequence of the paper, the value, and the printed one.
    """
    table = descriptors.melt("recording", var_name="descriptor", value_name="value")
    table = add_sequences(table, published_as)
    printed = figures[(figures["table"].astype(str) == "2") & (figures["quantity"] == "value")]
    return beside(table, printed, on=["sequence", "descriptor"])


def list_parameters(options: Gaps2021Options, runs: pd.DataFrame, figures: pd.DataFrame) -> pd.DataFrame:
    """Count the parameters of the networks (Table 4).

    Parameters
    ----------
    options : Gaps2021Options
        The sizes of the networks.
    runs : DataFrame
        The columns runs.RUN_COLUMNS.
    figures : DataFrame
        Those of skurowski2021.

    Returns
    -------
    DataFrame
        One row for each network: its number of parameters in the exemplary case, as it is printed, and their least and largest number
        in our runs.
    """
    columns = COLUMNS_PER_INPUT * EXEMPLARY_MARKERS
    rows = []
    for method in NETWORKS:
        own = runs.loc[runs["method"] == method, "parameters"].astype(float)
        rows.append((method, learnable_parameters(KINDS[method], columns, options.networks), own.min(), own.max()))
    table = pd.DataFrame(rows, columns=["method", "parameters", "least_of_runs", "largest_of_runs"])
    printed = figures[figures["quantity"] == "parameters"]
    return beside(table, printed, on=["method"])


def list_criteria(runs: pd.DataFrame) -> pd.DataFrame:
    """Compute the information criteria of the networks over the length of the training sequence (Figure 9).

    Each gap has a network of its own, whose test data are the coordinates in the gap; figures are means over the gaps that were filled.

    Parameters
    ----------
    runs : DataFrame
        The columns runs.RUN_COLUMNS.

    Returns
    -------
    DataFrame
        One row for each recording, length and network: mean training frames, mean square error over all coordinates in mm², Akaike's and the
        Bayesian information criterion.
    """
    own = runs[runs["method"].isin(NETWORKS) & runs["error"].notna() & (runs["error"] > 0)]
    own = own.astype({"parameters": float})  # text without any network
    criteria = information_criteria(
        own["error"].to_numpy(float) ** 2, AXES * own["samples"].to_numpy(), own["parameters"].to_numpy(float)
    )
    squares = own["samples"] * own["error"] ** 2
    groups = own.assign(squares=squares, **criteria).groupby(CONDITION, sort=True)
    table = groups[["training_frames", "parameters", "aic", "bic"]].mean().reset_index()
    mean_square = (groups["squares"].sum() / groups["samples"].sum()).rename("mean_square_error").reset_index()
    return in_order(table.merge(mean_square, on=CONDITION))
