"""Errors of gaps against sums sample by sample, and statistics by the definitions of Matlab."""

from dataclasses import astuple

import numpy as np
import pandas as pd
import pytest

from markermend.core.events import Event
from markermend.evaluation.gap_errors import (
    ErrorStatistics,
    error_statistics,
    error_table,
    gap_errors,
    mode,
    pooled_error,
)
from support.naive import evaluation as naive

MARKERS = ("A", "B", "C")
GAPS = [Event("B", 10, 11, 1.0), Event("A", 5, 40, 1.0), Event("C", 0, 3, 1.0), Event("A", 60, 80, 1.0)]


@pytest.fixture
def truth():
    return np.random.default_rng(0).standard_normal((80, 3, 3)) * 100


def test_errors_are_those_of_the_samples_of_each_gap(truth):
    estimate = truth + np.random.default_rng(1).standard_normal(truth.shape)
    expected = [naive.gap_error(estimate, truth, MARKERS, gap) for gap in GAPS]
    assert gap_errors(estimate, truth, MARKERS, GAPS) == pytest.approx(expected)
    assert len(gap_errors(estimate, truth, MARKERS, [])) == 0


def test_a_known_displacement_is_the_error_of_its_gap(truth):
    estimate = truth.copy()
    estimate[5:40, 0] += (3.0, 0.0, 0.0)
    estimate[41:60, 0] += 1e6  # between the gaps
    assert gap_errors(estimate, truth, MARKERS, GAPS) == pytest.approx([0, np.sqrt(3), 0, 0])


def test_the_error_over_all_gaps_is_that_of_their_samples(truth):
    estimate = truth + np.random.default_rng(2).standard_normal(truth.shape)
    inside = np.concatenate([(estimate - truth)[gap.start : gap.stop, MARKERS.index(gap.marker)] for gap in GAPS])
    lengths = np.array([gap.stop - gap.start for gap in GAPS])
    assert pooled_error(gap_errors(estimate, truth, MARKERS, GAPS), lengths) == pytest.approx(
        np.sqrt((inside**2).mean())
    )
    assert np.isnan(pooled_error(np.empty(0), np.empty(0)))


def test_what_is_not_filled_is_counted_and_left_out(truth):
    estimate = truth + 1.0
    estimate[70, 0, 1] = np.nan
    errors = gap_errors(estimate, truth, MARKERS, GAPS)
    assert np.isnan(errors).tolist() == [False, False, False, True]
    found = error_statistics(errors, np.array([1, 35, 3, 20]))
    assert (found.gaps, found.unfilled, found.rmse, found.mean) == (3, 1, pytest.approx(1), pytest.approx(1))
    none = error_statistics(np.full(2, np.nan), np.array([4, 5]))
    assert (none.gaps, none.unfilled) == (0, 2)
    assert np.isnan(astuple(none)[2:]).all()


def test_statistics_are_those_of_matlab():
    """x = [7 1 4 9]: std 3.5000, quantile(x, [.25 .5 .75]) 2.5 5.5 8.0, iqr 5.5, mode 1."""
    found = error_statistics(np.array([7.0, 1.0, 4.0, 9.0]), np.array([1, 1, 1, 3]))
    assert found == ErrorStatistics(4, 0, pytest.approx(np.sqrt((49 + 1 + 16 + 243) / 6)), 5.25, 5.5, 1.0, 3.5, 5.5)


def test_the_mode_is_the_smallest_of_the_most_frequent():
    assert mode(np.array([3.0, 2.0, 5.0, 5.0, 2.0])) == 2.0
    assert mode(np.array([3.0, 2.0, 5.0, 5.0])) == 5.0
    assert mode(np.array([3.0, 2.0, 5.0])) == 2.0


def test_a_table_has_a_row_for_each_method_and_length():
    errors = pd.DataFrame(
        {
            "length": [20, 10, 10, 20, 10],
            "method": ["spline", "spline", "linear", "linear", "spline"],
            "error": [4.0, 1.0, 2.0, np.nan, 3.0],
            "samples": [20, 8, 11, 19, 12],
        }
    )
    table = error_table(errors, ["length", "method"])
    assert table[["length", "method"]].to_numpy().tolist() == [
        [10, "linear"],
        [10, "spline"],
        [20, "linear"],
        [20, "spline"],
    ]
    assert table["gaps"].tolist() == [1, 2, 0, 1]
    assert table["mean"].tolist() == pytest.approx([2, 2, np.nan, 4], nan_ok=True)
    assert table["rmse"][1] == pytest.approx(np.sqrt((8 + 12 * 9) / 20))
    assert error_table(errors, ["method"])["gaps"].tolist() == [1, 3]
