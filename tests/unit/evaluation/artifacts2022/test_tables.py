"""The tables of the experiment on classification: runs are averaged, published figures stand beside."""

import numpy as np
import pandas as pd
import pytest

from markermend.evaluation.artifacts2022.runs import Condition, run_rows
from markermend.evaluation.artifacts2022.tables import average_runs, measure_runs
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
    assert list(table.loc[5.0].index) == [*CLASSES, "all"]
