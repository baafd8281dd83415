"""Tables of the model averaging paper: means over gaps, runs and recordings, paired tests, published figures beside."""

from itertools import product

import numpy as np
import pandas as pd
import pytest
from scipy.stats import ttest_rel

from markermend.evaluation.pma2018 import tables
from markermend.evaluation.pma2018.options import Pma2018Options
from markermend.evaluation.pma2018.runs import RUN_COLUMNS
from markermend.evaluation.published_figures import read_published
from support.paths import PROJECT

OPTIONS = Pma2018Options(runs=5, constraint_runs={"text": 8, "program": 8})

METHODS = ("linear_regression", "local_grnn", "pma_1_2_3_4", "pma_1_3_4_5")

TESTED = ("pma_1_2_3_4", "pma_1_2_3_4_unconstrained")


@pytest.fixture(scope="module")
def figures():
    return read_published(PROJECT / "config/evaluate/published/tits2018.tsv")


@pytest.fixture(scope="module")
def runs():
    rng = np.random.default_rng(4)
    conditions = [(3, 1.0, None), (3, 5.0, None), (10, 5.0, None), (3, 1.0, 5.0), (1, 1.0, None)]
    rows = []
    for recording, procedure, condition in product(
        ("85_02", "mine"), ("text", "test_text", "test_program"), conditions
    ):
        tested = procedure.startswith("test")
        for run, method in product(range(8 if tested else 5), TESTED if tested else METHODS):
            loss = 10.0 * method.endswith("unconstrained")
            for gap in range(condition[0]):
                rows.append((recording, procedure, *condition, run, f"M{gap}", 3, method, loss + rng.uniform(1, 9)))
    return pd.DataFrame(rows, columns=list(RUN_COLUMNS))


@pytest.fixture(scope="module")
def made(runs, figures):
    return tables.all_tables(runs, figures, OPTIONS)


def test_a_figure_has_the_mean_of_its_runs_and_the_published_one_beside(runs, made):
    table = made["lengths"].set_index(["recording", "length_s", "method"])
    own = runs[(runs["recording"] == "85_02") & (runs["procedure"] == "text") & (runs["gaps"] == 3)]
    own = own[(own["length_s"] == 5) & (own["method"] == "local_grnn")]
    row = table.loc[("85_02", 5.0, "local_grnn")]
    means = own.groupby("run")["error_mm"].mean()
    assert row["error_mm"] == pytest.approx(means.mean()) and row["runs"] == 5
    assert row["standard_error_mm"] == pytest.approx(means.std() / np.sqrt(5))
    assert row["sequence"] == "CMU1" and row["published"] == "20.2"
    assert table.loc[("mine", 5.0, "local_grnn"), "published"] == ""
    assert not table.index.get_level_values("method").str.endswith("unconstrained").any()
    assert set(made["durations"]["duration_s"]) == {5.0} and set(made["gap_counts"]["gaps"]) == {1, 3}


def test_figures_of_whole_recordings_do_not_stand_beside_those_of_fragments(runs, figures):
    fragments = runs[runs["duration_s"] == 5].assign(length_s=5.0)
    options = Pma2018Options(length_s=5)
    made = tables.all_tables(pd.concat([runs, fragments]), figures, options)
    whole, part = (made[name].set_index(["recording", "length_s", "method"]) for name in ("lengths", "durations"))
    assert whole.loc[("85_02", 5.0, "local_grnn"), "published"] == "20.2"
    assert part.loc[("85_02", 5.0, "local_grnn"), "published"] == ""
    means = made["means"].set_index(["figure", "method"])
    assert means.loc[("durations", "local_grnn"), "published"] == ""


def test_a_run_with_an_open_gap_does_not_count(runs, figures):
    holed = runs.copy()
    holed.loc[(holed["run"] == 2) & (holed["marker"] == "M1") & (holed["method"] == "local_grnn"), "error_mm"] = np.nan
    table = tables.all_tables(holed, figures, OPTIONS)["lengths"].set_index("method")
    assert set(table.loc["local_grnn", "unfilled"]) == {1} and table.loc["local_grnn", "error_mm"].notna().all()
    assert set(table.loc["pma_1_2_3_4", "unfilled"]) == {0}


def test_means_over_recordings(made):
    table = made["lengths"]
    own = table[(table["length_s"] == 5) & (table["method"] == "local_grnn")]
    means = made["means"]
    row = means[(means["figure"] == "lengths") & (means["length_s"] == 5) & (means["method"] == "local_grnn")].iloc[0]
    assert row["recordings"] == 2 and row["error_mm"] == pytest.approx(own["error_mm"].mean())
    assert row["standard_error_mm"] == pytest.approx(np.hypot(*own["standard_error_mm"]) / 2)
    assert row["published"] == "10"
    short = means[(means["figure"] == "durations") & (means["method"] == "local_grnn")]
    assert short["published"].tolist() == ["12"]


def test_a_recording_that_was_not_filled_does_not_make_the_standard_error_smaller(runs, figures):
    held = (runs["recording"] == "mine") & (runs["method"] == "local_grnn")
    made = tables.all_tables(runs.assign(error_mm=runs["error_mm"].where(~held)), figures, OPTIONS)
    own, means = (
        made[name][lambda table: (table["length_s"] == 5) & (table["method"] == "local_grnn")]
        for name in ("lengths", "means")
    )
    own, mean = own[own["recording"] == "85_02"].iloc[0], means[means["figure"] == "lengths"].iloc[0]
    assert mean["recordings"] == 1 and mean["standard_error_mm"] == pytest.approx(own["standard_error_mm"])


def test_the_constraints_are_tested_in_pairs(runs, made):
    table = made["constraints"]
    assert len(table) == 2 * 2 * 2
    row = table[(table["table"] == "3") & (table["recording"] == "85_02") & (table["variant"] == "text")].iloc[0]
    own = runs[(runs["recording"] == "85_02") & (runs["procedure"] == "test_text") & (runs["gaps"] == 10)]
    without, constrained = (
        own[own["method"] == name].groupby("run")["error_mm"].mean()
        for name in ("pma_1_2_3_4_unconstrained", "pma_1_2_3_4")
    )
    assert row["runs"] == 8 and row["p"] == pytest.approx(ttest_rel(without, constrained).pvalue)
    assert row["difference_mm"] == pytest.approx(without.mean() - constrained.mean()) and row["difference_mm"] > 5
    assert row["unconstrained_standard_error_mm"] == pytest.approx(without.sem())
    printed = [f"{name}_published" for name in ("unconstrained", "constrained", "p")]
    assert row[printed].tolist() == ["80.8", "39.1", "< 10e-10"]
    assert table[table["recording"] == "mine"][printed].to_numpy().tolist() == [["", "", ""]] * 4


def test_equal_errors_have_no_p(runs, figures):
    same = runs.assign(error_mm=1.0)
    assert tables.all_tables(same, figures, OPTIONS)["constraints"]["p"].isna().all()


def test_without_tested_conditions_the_table_is_empty(runs, figures):
    made = tables.all_tables(runs[runs["method"] == "local_grnn"], figures, OPTIONS)
    assert made["constraints"].empty and "p_published" in made["constraints"] and len(made["lengths"])
