"""Correlations over recordings: against scipy, and of the published errors with the published descriptors."""

import numpy as np
import pandas as pd
import pytest
from scipy.stats import pearsonr

from markermend.evaluation.correlations import correlations
from markermend.evaluation.published_figures import published_descriptors, published_errors, read_published
from support.paths import PROJECT


def drawn(sequences=6, seed=0):
    rng = np.random.default_rng(seed)
    names = [f"S{number}" for number in range(sequences)]
    columns = pd.MultiIndex.from_product([[10, 20], ["linear", "spline"]], names=["length", "method"])
    return (
        pd.DataFrame(rng.standard_normal((sequences, 2)), index=names, columns=["jerk", "entropy"]),
        pd.DataFrame(rng.standard_normal((sequences, 4)), index=names[::-1], columns=columns),
    )


def test_correlations_are_those_of_scipy_whatever_the_order_of_the_recordings():
    descriptors, errors = drawn()
    found = correlations(descriptors, errors)
    assert list(found.columns) == ["descriptor", "length", "method", "correlation", "p", "sequences"]
    assert len(found) == 8
    for row in found.itertuples():
        expected = pearsonr(descriptors[row.descriptor], errors[::-1][row.length, row.method])
        assert (row.correlation, row.p, row.sequences) == (*map(pytest.approx, expected), 6)


def test_recordings_without_an_error_are_left_out_and_constants_have_no_correlation():
    descriptors, errors = drawn()
    errors.loc["S2", (10, "linear")] = np.nan
    errors[20, "spline"] = 3.0
    found = correlations(descriptors, errors).set_index(["descriptor", "length", "method"])
    kept = [name for name in descriptors.index if name != "S2"]
    expected = pearsonr(descriptors.loc[kept, "jerk"], errors.loc[kept, (10, "linear")])
    assert found.loc[("jerk", 10, "linear")].tolist() == pytest.approx([*expected, 5])
    assert np.isnan(found.loc[("jerk", 20, "spline"), "correlation"])


def test_a_correlation_of_two_recordings_is_refused():
    with pytest.raises(ValueError, match="need 3 recordings with errors and descriptors: there are 2"):
        correlations(*drawn(2))


@pytest.mark.parametrize("length", [10, 20, 50, 100, 200])
def test_the_published_correlations_come_from_the_published_errors(length):
    """Tables A6 to A12 from Tables 2, 3 and A1 to A5; complexity is printed with three decimals of 0.000 to 0.027."""
    figures = read_published(PROJECT / "config/evaluate/published/skurowski2021.tsv")
    keys = ["descriptor", "length", "method"]
    found = correlations(published_descriptors(figures), published_errors(figures, "rmse")).set_index(keys)
    tables = figures[figures["table"].str.match("A[6-9]|A1[0-2]") & (figures["length"] == length)]
    for quantity, printed in tables.groupby("quantity"):
        ours = found[quantity].loc[[tuple(key) for key in printed[keys].to_numpy()]].to_numpy()
        rounded = (printed["descriptor"] == "complexity").to_numpy()
        difference = np.abs(ours - printed["value"].to_numpy())
        assert len(printed) == 70
        assert difference[~rounded].max() < 0.002
        assert difference[rounded].max() < 0.02


def test_the_published_mean_correlations_are_those_over_the_lengths():
    """Table 5 from Tables A6 to A12."""
    figures = read_published(PROJECT / "config/evaluate/published/skurowski2021.tsv")
    each = figures[figures["table"].str.match("A[6-9]|A1[0-2]") & (figures["quantity"] == "correlation")]
    printed = figures[figures["table"] == "5"].set_index(["descriptor", "method"])["value"]
    mean = each.groupby(["descriptor", "method"])["value"].mean()
    assert len(printed) == 70
    assert (mean - printed).abs().max() < 0.0015


def test_the_published_correlations_of_descriptors_come_from_the_published_descriptors():
    """Table 6 from Table 2, but for complexity, of which too few digits are printed."""
    figures = read_published(PROJECT / "config/evaluate/published/skurowski2021.tsv")
    descriptors = published_descriptors(figures).drop(columns="complexity")
    found = correlations(descriptors, descriptors.rename_axis(columns="other")).set_index(["descriptor", "other"])
    printed = figures[figures["table"] == "6"].set_index(["descriptor", "quantity"])["value"]
    for one, other in found.index:
        for quantity in ("correlation", "p") if one != other else ("correlation",):
            assert found.loc[(one, other), quantity] == pytest.approx(
                printed[one, f"{quantity}_with_{other}"], abs=0.002
            )
