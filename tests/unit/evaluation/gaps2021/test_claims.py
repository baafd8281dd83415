"""What the paper states holds of its own figures; methods are compared on the runs that they share."""

import numpy as np
import pandas as pd
import pytest

from markermend.evaluation.claims import NO, UNTESTED, YES
from markermend.evaluation.gaps2021.claims import judge
from markermend.evaluation.gaps2021.comparisons import common_errors
from markermend.evaluation.gaps2021.methods import RECURRENT
from markermend.evaluation.gaps2021.tables import arrange_published, make_tables

from .conftest import OPTIONS


def judged(runs, descriptors, figures):
    return judge(runs, make_tables(runs, descriptors, figures, OPTIONS), arrange_published(figures))


def test_the_statements_hold_of_the_published_figures(runs, descriptors, figures):
    table = judged(runs, descriptors, figures)
    compared = table["published"].str.contains(" of ")
    assert compared.sum() == 10
    wrong = table[table["holds"] != YES]
    # equal errors of all gaps have neither deviation nor interquartile range
    assert [claim.split()[0] for claim in wrong["claim"]] == ["All", "BILSTM"]
    same = table[:8]
    assert (same["published"] == same["ours"]).all()


def test_methods_are_compared_on_the_runs_that_they_share(runs):
    fewer = runs[~(runs["method"].isin(RECURRENT) & (runs["run"] == 1))]
    fewer = fewer.assign(error=np.where(fewer["run"] == 1, 1000.0, fewer["error"]))
    shared = common_errors(fewer, ["network_linear", *RECURRENT], (10,))
    assert shared.loc[("static", 10), "network_linear"] == pytest.approx(3.830)
    alone = common_errors(fewer, ["network_linear"], (10,))
    assert alone.loc[("static", 10), "network_linear"] == pytest.approx(np.sqrt((3.83**2 + 1000**2) / 2))


def test_methods_are_compared_on_the_runs_that_they_fill(runs):
    error = runs["error"].where(runs["run"] == 0, 1000.0)
    left = (runs["method"] == "spline") & (runs["run"] == 1) & (runs["marker"] == "M0")
    shared = common_errors(runs.assign(error=error.where(~left)), ["linear", "spline"], (10,))
    assert shared.loc[("static", 10), "linear"] == pytest.approx(
        runs["error"][(runs["recording"] == "static") & (runs["length"] == 10) & (runs["method"] == "linear")].iloc[0]
    )


def test_what_was_not_run_is_not_tested(runs, descriptors, figures):
    own = runs[~runs["method"].isin(RECURRENT) & (runs["length"] == 10)]
    two = own[own["recording"].isin(["static", "walking"])]
    table = judged(two, descriptors[descriptors["recording"].isin(["static", "walking"])], figures)
    untested = table[table["holds"] == UNTESTED]
    assert len(untested) == 11 and untested["reason"].ne("").all() and untested["ours"].eq("").all()


def test_a_statement_that_fails_names_where(runs, descriptors, figures):
    worse = (runs["method"] == "spline") & (runs["length"] == 20)
    table = judged(runs.assign(error=runs["error"].where(~worse, 500.0)), descriptors, figures)
    row = table[table["claim"].str.contains("spline")].iloc[0]
    assert row["holds"] == NO and row["ours"] == "5 of 12" and "walking at 20" in row["reason"]


def test_networks_whose_errors_do_not_grow_with_the_gap_are_said(runs, descriptors, figures):
    network = runs["method"].str.startswith("network")
    table = judged(runs.assign(error=runs["error"].where(~network, 30.0)), descriptors, figures)
    row = table[table["claim"].str.startswith("At 10 and 20 samples the recurrent")].iloc[0]
    assert row["holds"] == NO
    assert "the errors of networks grow 1.0 times here, 16.5 times in the paper" in row["reason"]
    spline = table[table["claim"].str.contains("spline")].iloc[0]
    assert "networks" not in spline["reason"]


def test_networks_whose_errors_grow_with_the_gap_as_printed_are_no_reason(runs, descriptors, figures):
    worse = (runs["method"] == "network_linear") & (runs["length"] >= 50)
    table = judged(runs.assign(error=runs["error"].where(~worse, 3000.0)), descriptors, figures)
    failing = table[table["claim"].str.startswith("From 50 samples") & (table["holds"] == NO)]
    assert len(failing) and not failing["reason"].str.contains("grow").any()


def test_low_rank_completion_that_is_no_interpolation_is_said(runs, descriptors, figures):
    own = runs.assign(error=np.where(runs["method"] == "msvd", 0.5 * runs["error"], runs["error"]))
    row = judged(own, descriptors, figures).iloc[-1]
    assert row["holds"] == NO and row["ours"] == "0.50 times"


def test_fewer_recordings_have_less_power(runs, descriptors, figures):
    some = ["static", "walking", "sitting"]
    table = judged(runs[runs["recording"].isin(some)], descriptors[descriptors["recording"].isin(some)], figures)
    row = table[table["claim"].str.contains("significant")].iloc[0]
    assert "above 0.997" in row["reason"] and isinstance(table, pd.DataFrame)
