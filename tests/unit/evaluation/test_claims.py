"""Statements of papers as a table."""

import numpy as np

from markermend.evaluation.claims import Claim, claims_table, span, verdict


def test_statements_have_a_row_each():
    table = claims_table(
        [Claim("F is high", "> 0.9", "0.95", verdict(True)), Claim("G is", "1", "", verdict(None), "not run")]
    )
    assert list(table.columns) == ["claim", "published", "ours", "holds", "reason"]
    assert table["holds"].tolist() == ["yes", "not tested"]
    assert claims_table([]).columns.tolist() == table.columns.tolist()
    assert verdict(False) == "no"


def test_a_range_of_figures_is_written_once_where_it_is_one():
    assert span([1.04, 1.03, np.nan]) == "1.0"
    assert span([3.0, 1.0], 2) == "1.00 to 3.00"
    assert span([np.nan]) == ""
