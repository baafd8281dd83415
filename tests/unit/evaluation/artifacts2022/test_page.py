"""The page of the artifact detection paper: a section for each experiment that was run."""

import numpy as np
import pandas as pd
import pytest

from markermend.evaluation.artifacts2022 import operators, slow_sweep
from markermend.evaluation.artifacts2022.page import make_page
from markermend.evaluation.artifacts2022.repairs import COLUMNS
from markermend.evaluation.artifacts2022.runs import Condition, reading_rows, run_rows
from markermend.evaluation.artifacts2022.tables import make_tables
from markermend.evaluation.published_figures import read_published
from support.paths import PROJECT


@pytest.fixture
def runs():
    """Runs of all experiments."""
    condition = Condition("paper", 10.0, 20.0)
    counted = [(0, np.random.default_rng(2).integers(1, 100, (5, 5)).astype(float))]
    count = slow_sweep.SlowCount(5, 5, 20, 1000, 18, 0.6, 1.5)
    errors = [("walk", 153, "peaks", 10.0, 20.0, 0, *own) for own in (("distorted", "perfect", 0.4), ("linear", "perfect", 0.01))]  # fmt: skip
    persons = [("walk", "sees all", "paper", "all", 5, 6, 4, 4, 4, 1, 2)]
    return {
        "runs": run_rows("walk", condition, counted),
        "readings": reading_rows("walk", condition, {"as read": counted, "other": counted}),
        "slow": slow_sweep.sweep_rows("walk", condition, [(0, {("clean", 200, 10, "marker", 0.5, 0.3): count})]),
        "repairs": pd.DataFrame(errors, columns=list(COLUMNS)),
        "operators": pd.DataFrame(persons, columns=list(operators.COLUMNS)),
    }


def page_of(runs):
    return make_page(make_tables(runs, read_published(PROJECT / "config/evaluate/published/skurowski2022.tsv")))


def test_each_experiment_has_a_section_with_charts(runs):
    sections = page_of(runs).sections
    assert [own.file for own in sections] == [
        "measures.tsv",
        "confusion.tsv",
        "readings.tsv",
        "slow.tsv",
        "repairs.tsv",
        "operators.tsv",
    ]
    assert [len(own.charts) for own in sections] == [2, 1, 2, 2, 1, 0]
    bars = sections[4].charts[0].figure["data"]
    assert [trace["name"] for trace in bars] == ["perfect", "perfect, published"]


def test_experiments_that_were_not_run_have_none(runs):
    assert [own.file for own in page_of({"runs": runs["runs"]}).sections] == ["measures.tsv", "confusion.tsv"]
