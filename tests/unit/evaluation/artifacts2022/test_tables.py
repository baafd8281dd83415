"""The tables of the experiment on classification: runs are averaged, published figures stand beside."""

import numpy as np
import pandas as pd
import pytest

from markermend.evaluation.artifacts2022 import operators
from markermend.evaluation.artifacts2022.jobs import TABLES
from markermend.evaluation.artifacts2022.repairs import COLUMNS
from markermend.evaluation.artifacts2022.runs import Condition, run_rows
from markermend.evaluation.artifacts2022.tables import (
    READING,
    average_repairs,
    average_runs,
    join_operators,
    make_tables,
    measure_runs,
)
from markermend.evaluation.classification import CLASSES
from markermend.evaluation.published_figures import read_published
from support.paths import PROJECT


@pytest.fixture
def runs():
    rng = np.random.default_rng(2)
    parts = [
        run_rows(
            "walk",
            Condition("paper", amplitude, 20.0),
            [(run, rng.integers(1, 100, (5, 5)).astype(float)) for run in range(3)],
        )
        for amplitude in (5.0, 10.0)
    ]
    return pd.concat(parts, ignore_index=True)


def test_runs_are_averaged_by_condition(runs):
    table = average_runs(runs)
    assert len(table) == 2 * 5 and set(table["runs"]) == {3}
    own = runs[(runs["amplitude_mm"] == 10) & (runs["true"] == "steps") & (runs["found"] == "slow")]["samples"]
    row = table[(table["amplitude_mm"] == 10) & (table["true"] == "steps")]
    assert row["slow"].item() == pytest.approx(own.mean())


def test_published_figures_stand_beside(runs):
    published = read_published(PROJECT / "config/evaluate/published/skurowski2022.tsv")
    table = measure_runs(runs, published).set_index(["amplitude_mm", "class"])
    assert table.loc[(5.0, "peaks"), "TPR_published"] == "66" and table.loc[(10.0, "peaks"), "TPR_published"] == "90"
    assert table.loc[(10.0, "noise"), "FDR_published"] == "4 to 8"
    assert table.loc[(5.0, "all"), "F_published"] == "> 0.999"
    ours = measure_runs(runs.assign(preset="default"), published)
    assert (ours[["TPR_published", "FDR_published", "F_published"]] == "").all(axis=None)
    assert list(table.loc[5.0].index) == [*CLASSES, "all"]


FIGURES = read_published(PROJECT / "config/evaluate/published/skurowski2022.tsv")


def test_errors_of_repair_are_averaged_and_scaled_to_the_coordinates_of_the_paper():
    rows = [
        ("walk", 318, kind, 10.0, 20.0, run, method, located, error)
        for kind in ("peaks", "slow")
        for run, error in enumerate((0.2, 0.4))
        for method, located in (
            ("distorted", "perfect"),
            ("linear", "perfect"),
            ("linear", "classified"),
            ("default", "perfect"),
        )
    ]
    table = average_repairs(pd.DataFrame(rows, columns=list(COLUMNS)), FIGURES).set_index(
        ["class", "method", "located"]
    )
    assert table["runs"].eq(2).all() and table["rmse_mm"].tolist() == pytest.approx([0.3] * 8)
    assert table["rmse_159_mm"].tolist() == pytest.approx([0.3 * np.sqrt(2)] * 8)
    assert table.loc[("peaks", "distorted", "perfect"), "formula_mm"] == pytest.approx(0.38228, rel=0.002)
    assert table.loc[("slow", "distorted", "perfect"), "formula_mm"] == pytest.approx(0.21676, rel=0.02)
    assert table["published"].tolist()[:4] == ["0.38228", "0.00273", "0.07007", ""]


def test_published_findings_of_persons_stand_below_ours():
    ours = pd.DataFrame([("walk", "sees all", "paper", "all", 5, 6, 4, 4, 4, 1, 2)], columns=list(operators.COLUMNS))
    table = join_operators(ours, FIGURES)
    assert table["source"].tolist() == ["ours"] + ["published"] * 5
    none = table[table["operator"] == "none"].iloc[0]
    assert (none["human"], none["algorithm"], none["algorithm_confirmed"], none["only_algorithm"]) == (20, 29, 16, 13)


def test_tables_of_experiments_that_were_not_run_have_no_rows(runs):
    tables = make_tables({"runs": runs}, FIGURES)
    assert tuple(tables) == TABLES
    assert [name for name, own in tables.items() if own.empty] == ["readings", "slow", "repairs", "operators"]
    assert set(tables["claims"]["holds"]) >= {"not tested"}


def test_readings_are_measured_each_by_itself(runs):
    reading = runs.rename(columns={"preset": "reading"})
    table = measure_runs(pd.concat([reading, reading.assign(reading="other")]), FIGURES, READING)
    assert set(table["reading"]) == {"paper", "other"} and len(table) == 2 * 2 * 6
