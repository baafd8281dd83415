"""The tables of the experiment: made of the published errors and descriptors they are the published ones."""

import numpy as np
import pandas as pd
import pytest

from markermend.evaluation.gaps2021.correlation_tables import DESCRIPTORS
from markermend.evaluation.gaps2021.methods import METHODS, NETWORKS
from markermend.evaluation.gaps2021.page import make_page
from markermend.evaluation.gaps2021.tables import make_tables

from .conftest import OPTIONS


@pytest.fixture(scope="module")
def tables(runs, descriptors, figures):
    return make_tables(runs, descriptors, figures, OPTIONS)


def test_errors_stand_beside_the_published_ones(tables):
    table = tables["errors"]
    assert len(table) == 6 * 5 * 10
    assert np.allclose(table["rmse"], pd.to_numeric(table["rmse_published"]))
    assert (table["gaps"] == 4).all() and (table["runs"] == 2).all() and (table["unfilled"] == 0).all()
    assert table[:10]["method"].tolist() == [method for method in METHODS if method != "default"]
    row = table[(table["sequence"] == "static") & (table["length"] == 50) & (table["method"] == "network_linear")].iloc[
        0
    ]
    assert row[["mean_published", "mode_published", "iqr_published"]].tolist() == ["3.401", "1.326", "1.421"]


def test_a_recording_that_is_like_none_has_no_published_figures(runs, descriptors, figures):
    own = runs.assign(recording="golf")
    table = make_tables(own, descriptors.assign(recording="golf")[:1], figures, OPTIONS)["errors"]
    assert set(table["rmse_published"]) == {""} and set(table["sequence"]) == {""}


def away(table, ours, published):
    """How far a column is from the printed one: within rounding, that of complexity more, of which Table 2 prints one or two digits."""
    distance = (table[ours] - pd.to_numeric(table[published])).abs()
    rounded = (table[[name for name in ("descriptor", "other") if name in table]] == "complexity").any(axis=1)
    return distance[~rounded].max(), distance[rounded].max()


def test_correlations_are_the_published_ones(tables):
    table = tables["correlations"]
    assert len(table) == 7 * 5 * 10 and (table["recordings"] == 6).all()
    for name in ("correlation", "p"):
        exact, rounded = away(table, name, f"{name}_published")
        assert exact < 0.002 and rounded < 0.02


def test_mean_correlations_are_the_published_ones(tables):
    table = tables["mean_correlations"]
    assert len(table) == 7 * 10
    exact, rounded = away(table, "correlation", "published")
    assert exact < 0.001 and rounded < 0.02


def test_correlations_of_descriptors_are_the_published_ones(tables):
    table = tables["descriptor_correlations"]
    assert len(table) == 7 * 6 and set(table["other"]) == set(DESCRIPTORS)
    exact, rounded = away(table, "correlation", "correlation_published")
    assert exact < 0.001 and rounded < 0.02


def test_two_recordings_have_no_correlations(runs, descriptors, figures):
    two = ["static", "walking"]
    own = make_tables(
        runs[runs["recording"].isin(two)], descriptors[descriptors["recording"].isin(two)], figures, OPTIONS
    )
    assert all(own[name].empty for name in ("correlations", "mean_correlations", "descriptor_correlations"))
    assert len(own["errors"]) == 2 * 5 * 10


def test_descriptors_stand_beside_the_published_ones(tables):
    table = tables["descriptors"].set_index(["recording", "descriptor"])
    assert table.loc[("falling", "monotonicity"), "published"] == "0.745"
    assert table.loc[("falling", "signed_monotonicity"), "published"] == ""


def test_parameters_are_those_of_the_exemplary_case(tables):
    table = tables["parameters"].set_index("method")
    assert table["parameters"].tolist() == [275, 275, 22023, 16563, 44043]
    assert table["published"].tolist() == ["275", "275", "22023", "16563", "47043"]
    assert (table["least_of_runs"] == 275).all() and (table["largest_of_runs"] == 275).all()


def test_criteria_are_means_over_the_gaps(runs, tables):
    table = tables["criteria"].set_index(["recording", "length", "method"])
    assert len(table) == 6 * 5 * len(NETWORKS)
    row = table.loc[("static", 50, "network_gru")]
    assert row["mean_square_error"] == pytest.approx(4.041**2)
    assert row["aic"] == pytest.approx(150 * np.log(4.041**2) + 2 * 275)
    assert row["bic"] == pytest.approx(150 * np.log(4.041**2) + 275 * np.log(150))


def test_networks_can_be_left_out(runs, descriptors, figures):
    own = runs[~runs["method"].isin(NETWORKS)].assign(parameters="")  # as read from files
    made = make_tables(own, descriptors, figures, OPTIONS)
    assert made["criteria"].empty and made["parameters"]["least_of_runs"].isna().all()
    assert len(make_page(made).sections) == 8


def test_gaps_that_were_not_filled_are_counted_and_left_out(runs, descriptors, figures):
    first = (runs["run"] == 0) & (runs["marker"] == "M0")
    own = make_tables(runs.assign(error=runs["error"].where(~first)), descriptors, figures, OPTIONS)
    assert (own["errors"]["unfilled"] == 1).all() and (own["errors"]["gaps"] == 3).all()
    assert np.allclose(own["errors"]["rmse"], pd.to_numeric(own["errors"]["rmse_published"]))
    assert own["criteria"]["aic"].notna().all()
