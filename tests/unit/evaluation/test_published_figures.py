"""The table of published figures is whole and consistent, and others like it are read with care."""

from itertools import product

import pandas as pd
import pytest

from markermend.evaluation.published_figures import (
    add_sequences,
    beside,
    published_descriptors,
    published_errors,
    read_published,
)
from markermend.prediction.registry import REGISTRY
from support.paths import PROJECT

PATH = PROJECT / "config/evaluate/published/skurowski2021.tsv"
LENGTHS = [10, 20, 50, 100, 200]
SEQUENCES = {"static", "walking", "running", "sitting", "boxing", "falling"}
HEADER = "table\tsequence\tlength\tmethod\tdescriptor\tquantity\tvalue\n"


@pytest.fixture(scope="module")
def figures():
    return read_published(PATH)


def test_every_method_is_a_predictor_of_ours(figures):
    methods = set(figures["method"]) - {""}
    assert len(methods) == 10
    assert methods <= set(REGISTRY)


@pytest.mark.parametrize("quantity", ["rmse", "mean", "median", "mode", "deviation", "iqr"])
def test_errors_of_every_sequence_length_and_method(figures, quantity):
    errors = published_errors(figures, quantity)
    assert set(errors.index) == SEQUENCES
    assert sorted(errors.columns) == sorted(product(LENGTHS, {*figures["method"]} - {""}))
    assert errors.notna().all(axis=None)
    assert (errors >= 0).all(axis=None)


def test_some_figures_are_those_printed(figures):
    errors = published_errors(figures, "rmse")
    assert errors.loc["static", (10, "spline")] == 0.348
    assert errors.loc["sitting", (50, "network_gru")] == 5.952
    assert errors.loc["falling", (200, "pchip")] == 177.973
    assert published_descriptors(figures).loc["running"].to_dict() == {
        "entropy": 15.710, "deviation": 982.342, "velocity": 0.895, "acceleration": 6.176, "jerk": 643.337,
        "monotonicity": 0.379, "complexity": 0.001,
    }  # fmt: skip


def test_matrix_completion_is_printed_with_the_figures_of_linear_interpolation(figures):
    """In all rows of all tables: what is printed of mSVD is no result of it."""
    keys = ["table", "sequence", "length", "descriptor", "quantity"]
    one, other = (figures[figures["method"] == name].set_index(keys)["value"] for name in ("msvd", "linear"))
    assert len(one) > 250
    assert one.equals(other.reindex(one.index))


def test_the_printed_mode_is_the_smallest_error(figures):
    """Errors that are all different have no mode but the smallest: it lies below the mean by what the smallest of 200 may."""
    mean, mode, deviation = (published_errors(figures, quantity) for quantity in ("mean", "mode", "deviation"))
    assert (mode < published_errors(figures, "median")).all(axis=None)
    assert ((mean - mode) / deviation).stack(level=[0, 1], future_stack=True).between(0.5, 3.5).all()


def test_the_printed_errors_agree_with_each_other_and_with_lengths_that_are_poisson_counts(figures):
    """The square of the error over all samples against the mean square of the gaps: 1 if all are of one length."""
    rmse, mean, deviation = (published_errors(figures, quantity) for quantity in ("rmse", "mean", "deviation"))
    ratio = rmse**2 / (mean**2 + deviation**2)
    assert ratio.stack(level=[0, 1], future_stack=True).between(0.9, 1.2).all()
    assert ratio[10, "linear"].between(1.07, 1.15).all()
    assert ratio[200, "linear"].between(0.985, 1.02).all()


def test_tables_that_are_no_such_tables_are_refused(tmp_path):
    path = tmp_path / "figures.tsv"
    path.write_text("table\tvalue\n1\t2\n", encoding="utf-8")
    with pytest.raises(ValueError, match="there is no column quantity"):
        read_published(path)
    path.write_text(HEADER + 2 * "1\tstatic\t10\tspline\t\trmse\t0.3\n", encoding="utf-8")
    with pytest.raises(ValueError, match="line 3: this figure was there before"):
        read_published(path)


def test_figures_stand_beside_ours_the_one_with_more_keys_first(tmp_path):
    path = tmp_path / "figures.tsv"
    path.write_text(
        "table\tamplitude_mm\tclass\tmethod\tquantity\trelation\tvalue\n"
        "1\t\tpeaks\t\tTPR\t>\t50\n1\t10\tpeaks\t\tTPR\t\t90\n1\t\tnoise\t\tTPR\t>=\t4\n1\t\tnoise\t\tTPR\t<=\t8.0\n"
        "1\t\tsteps\tlinear\tTPR\t\t1\n",
        encoding="utf-8",
    )
    figures = read_published(path)
    ours = pd.DataFrame(
        {"amplitude_mm": [5.0, 10.0, 5.0, 5.0], "class": ["peaks", "peaks", "noise", "steps"], "TPR": 1.0}
    )
    found = beside(ours, figures, on=["amplitude_mm", "class"])
    assert found["published"].tolist() == ["> 50", "90", "4 to 8.0", ""]
    assert found.drop(columns="published").equals(ours)


def test_recordings_are_named_as_the_sequences_that_they_are_like():
    table = pd.DataFrame({"recording": ["walk", "my walk", "jump"], "error": 1.0})
    named = add_sequences(table, {"walking": ("my walk", "walk"), "static": ()})
    assert named["sequence"].tolist() == ["walking", "walking", ""]
    assert list(named) == ["recording", "sequence", "error"] and "sequence" not in table


@pytest.mark.parametrize(
    ("row", "message"), [("1\ta\tx\t\tmuch", "no number"), ("1\ta\tx\t~\t1", "the relation is none of")]
)
def test_wrong_figures_are_named(tmp_path, row, message):
    path = tmp_path / "figures.tsv"
    path.write_text(f"table\tmethod\tquantity\trelation\tvalue\n{row}\n", encoding="utf-8")
    with pytest.raises(ValueError, match=f"line 2: .*{message}"):
        read_published(path)
