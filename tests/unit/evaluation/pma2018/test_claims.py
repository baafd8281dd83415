"""Statements of the model averaging paper: they hold on errors made so, and fail on others."""

from dataclasses import replace
from itertools import product

import numpy as np
import pandas as pd
import pytest

from markermend.evaluation.pma2018.claims import judge
from markermend.evaluation.pma2018.methods import average
from markermend.evaluation.pma2018.options import ConstraintTest, Pma2018Options
from markermend.evaluation.pma2018.runs import RUN_COLUMNS
from markermend.evaluation.pma2018.tables import all_tables
from markermend.evaluation.published_figures import read_published
from support.paths import PROJECT

OPTIONS = Pma2018Options(runs=6, constraint_runs={"text": 6, "program": 6})

SIZES = {
    "linear_regression": 1.2,
    "local_interpolation": 2.0,
    "local_quadratic": 1.3,
    "local_grnn": 1.0,
    "weighted_pca": 1.4,
    "bolero": 5.0,
    "pma_1_2_3_4": 1.0,
    "pma_1_3_4_5": 0.9,
    "pma_1_2_3_4_5": 0.95,
    "pma_1_2_3_4_unconstrained": 1.5,
    "default": 0.5,
}

PROCEDURES = {
    "bolero": ("bolero",),
    "default": ("default",),
    "pma_1_2_3_4": ("text", "test_text"),
    "pma_1_2_3_4_unconstrained": ("test_text",),
    "pma_1_3_4_5": ("text", "test_text"),
    "pma_1_3_4_5_unconstrained": ("test_text",),
}


def judged(sizes, recordings=("85_02", "85_12"), options=OPTIONS):
    """The claims on errors that follow from sizes of the methods, length, number and duration."""
    conditions = [(3, 0.5, None), (3, 1, None), (3, 5, None), (10, 5, None), (1, 1, None), (3, 1, 5), (3, 1, 10)]
    tested, rows = average(options.tested_average, options).name, []
    for (recording, condition), (method, size), run in product(
        product(recordings, conditions), sizes.items(), range(6)
    ):
        gaps, length, duration = condition
        error = 10 * size * length**0.3 * gaps**0.2 * (1.2 if duration == 5 else 1) * (1 + 0.01 * run)
        error += 0.1 * (run % 2) * method.endswith("unconstrained")
        for procedure in PROCEDURES.get(method, ("text",)):
            if procedure == "test_text" and method.removesuffix("_unconstrained") != tested:
                continue
            own = (recording, procedure, *condition)
            rows += [(*own, run, f"M{gap}", 0, method, error) for gap in range(gaps)]
    runs = pd.DataFrame(rows, columns=list(RUN_COLUMNS))
    figures = read_published(PROJECT / "config/evaluate/published/tits2018.tsv")
    return judge(all_tables(runs, figures, options), options)


@pytest.fixture(scope="module")
def claims():
    return judged(SIZES)


def verdict_of(claims, words):
    (found,) = claims[claims["claim"].str.contains(words, regex=False)]["holds"]
    return found


STATEMENTS = (
    "BoLeRo has larger errors",
    "grows with the length",
    "On CMU1 the local GRNN is the best",
    "The averages have errors like",
    "The average of models 1, 3, 4 and 5",
    "Local interpolation is the least",
    "larger in fragments of 5 s",
    "grows with the number",
    "In gaps of 5 s the local GRNN",
    "In fragments of 5 s the local GRNN",
    "significantly reduce the error: CMU1, 3 gaps of 1 s",
    "significantly reduce the error: CMU1, 10 gaps of 5 s",
)


@pytest.mark.parametrize("words", STATEMENTS)
def test_statements_hold_on_errors_made_so(claims, words):
    assert verdict_of(claims, words) == "yes"


def test_what_the_paper_found_without_effect_must_have_none(claims):
    assert verdict_of(claims, "no significant effect: CMU2, 10 gaps of 5 s") == "no"


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"bolero": 1.0}, "BoLeRo has larger errors"),
        ({"linear_regression": 0.9}, "On CMU1 the local GRNN is the best"),
        ({"pma_1_2_3_4": 1.2}, "The averages have errors like"),
        ({"pma_1_2_3_4": 0.5}, "The average of models 1, 3, 4 and 5"),
        ({"local_quadratic": 3.0}, "Local interpolation is the least"),
        ({"pma_1_2_3_4_unconstrained": 0.5}, "significantly reduce the error: CMU1, 3 gaps of 1 s"),
    ],
)
def test_statements_fail_on_other_errors(changed, words):
    assert verdict_of(judged({**SIZES, **changed}), words) == "no"


def test_where_a_regression_extrapolates_beyond_all_bounds_ranks_are_tested():
    claims = judged({**SIZES, "pma_1_2_3_4_unconstrained": np.inf})
    assert verdict_of(claims, "significantly reduce the error: CMU1, 10 gaps of 5 s") == "yes"
    assert claims["ours"].str.contains("inf to 26.* mm, Wilcoxon's p 0.031").any()


def test_what_was_not_run_is_said():
    claims = judged({"pma_1_3_4_5": 1.0}, recordings=("mine",))
    untested = claims[claims["holds"] == "not tested"]
    assert len(untested) >= 6 and (untested["reason"] != "").all()
    assert not claims["claim"].str.contains("constraints").any() or verdict_of(claims, "constraints") == "not tested"


def test_the_best_of_one_is_not_tested():
    for sizes in ({"local_grnn": 1.0, "pma_1_3_4_5": 0.9}, {"bolero": 5.0}):
        assert set(judged(sizes)[lambda table: ~table["claim"].str.contains("grows|larger in")]["holds"]) == {
            "not tested"
        }


def test_a_method_that_was_not_run_is_not_found_to_be_worse():
    claims = judged({name: size for name, size in SIZES.items() if name not in ("pma_1_3_4_5", "local_interpolation")})
    assert verdict_of(claims, "The average of models 1, 3, 4 and 5") == "not tested"
    assert verdict_of(claims, "Local interpolation is the least") == "not tested"


@pytest.mark.parametrize(
    "changes",
    [
        {"constraint_tests": {"2": ConstraintTest(3, 5)}},  # the paper tests gaps of 1 s
        {"published_as": {"CMU9": ("85_02",)}},
        {"tested_average": (1, 3, 4, 5)},
    ],
)
def test_constraints_of_which_nothing_is_printed_are_not_judged(changes):
    sizes = {**SIZES, "pma_1_3_4_5_unconstrained": 1.5}
    claims = judged(sizes, options=replace(OPTIONS, **changes))
    (row,) = claims[claims["claim"].str.contains("constraints")].to_dict("records")
    assert row["holds"] == "not tested" and "prints no figures" in row["reason"]
