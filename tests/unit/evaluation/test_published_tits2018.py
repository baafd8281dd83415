"""The published figures of tits2018: that they are what was printed."""

import pytest

from markermend.evaluation.published_figures import read_published
from support.paths import PROJECT

SEQUENCES = {*(f"HDM{number}" for number in range(1, 6)), *(f"CMU{number}" for number in range(1, 4))}


def test_the_constraints_of_tits2018_reduce_the_error_in_every_row():
    figures = read_published(PROJECT / "config/evaluate/published/tits2018.tsv")
    errors = figures[(figures["quantity"] == "error_mm") & figures["table"].isin(["2", "3"])]
    for table, largest in (("2", 2.1), ("3", 41.7)):
        own = errors[errors["table"] == table].pivot(index="sequence", columns="method", values="value")
        gains = own["pma_1_2_3_4_unconstrained"] - own["pma_1_2_3_4"]
        assert set(own.index) == SEQUENCES
        assert gains.min() > 0 and gains.max() == pytest.approx(largest, abs=0.051)
