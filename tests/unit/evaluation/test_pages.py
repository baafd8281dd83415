"""Pages of the papers: what is in the tables is on them, escaped, with the figures for the charts."""

import json
import re

import numpy as np
import pandas as pd
import pytest

from markermend.evaluation.charts import Axes, lines
from markermend.evaluation.claims import Claim, claims_table
from markermend.evaluation.pages import (
    LONG_TABLE,
    Page,
    Section,
    cell,
    count_claims,
    paper_page,
    papers_page,
    without_empty_columns,
)
from support.html_pages import Page as HtmlPage
from support.html_pages import assert_one_program

TABLES = {
    "errors": pd.DataFrame({"recording": ["<b>walk"] * 2, "length": [10, 20], "rmse": [0.123456, np.nan], "rmse_published": ["0.35", ""]}),
    "long": pd.DataFrame({"value": np.arange(LONG_TABLE + 1)}),
    "claims": claims_table([Claim("A < B", "1", "2", "no", "because"), Claim("C", "3", "3", "yes")]),
}  # fmt: skip
CHART = lines(TABLES["errors"], Axes("length", "rmse", "frames", "mm"), by="recording", title="errors")
PAGE = Page("Gaps", "Somebody (2021)", ["What was run."], [
    Section("Errors (Table 3)", ["Errors in mm."], "errors.tsv", charts=[CHART]),
    Section("All", file="long.tsv"),
])  # fmt: skip
SIZES = pd.DataFrame({"recording": ["<b>walk"], "frames": [1200]})


@pytest.fixture(scope="module")
def html():
    return paper_page(PAGE, TABLES, sizes=SIZES, options={"runs": 2, "methods": ["spline"]})


def test_a_page_is_well_formed_and_names_cannot_become_markup(html):
    assert_one_program(HtmlPage(html))
    assert "<b>walk" not in html and "&lt;b&gt;walk" in html


def test_a_page_has_the_tables_and_links_to_their_files(html):
    assert "0.1235" in html and "0.35" in html and "rmse published" in html
    for name in ("errors", "claims", "recordings", "options"):
        assert f'href="tables/{name}.tsv"' in html
    assert f"<details><summary>{LONG_TABLE + 1} rows</summary>" in html


def test_a_page_has_the_figures_of_its_charts(html):
    figures = json.loads(re.search(r'id="figures">(.*)</script>', html)[1])
    assert figures == [CHART.figure] and html.count('class="chart"') == 1


def test_the_page_over_all_counts_statements():
    assert count_claims(TABLES["claims"]) == {"yes": 1, "no": 1, "not tested": 0}
    html = papers_page({"gaps2021": (PAGE, TABLES["claims"])})
    assert_one_program(HtmlPage(html))
    assert 'href="gaps2021/index.html"' in html and "A &lt; B" in html


@pytest.mark.parametrize(
    ("value", "text"),
    [
        ("> 99", "> 99"), (np.nan, "–"), (None, "–"), (3.0, "3"), (0.5, "0.5"), (99.3226, "99.32"), (0.0307412, "0.03074"), (1234.56, "1235"),
        (-0.0011699, "-0.00117"), (1.5e-5, "1.50e-05"), (2.5e7, "25000000"),
    ],
)  # fmt: skip
def test_numbers_have_four_significant_digits(value, text):
    assert cell(value) == text


def test_columns_that_say_nothing_are_left_out():
    table = pd.DataFrame({"a": ["", "x"], "b": ["", ""], "c": [np.nan, np.nan], "d": [0, 0]})
    assert list(without_empty_columns(table)) == ["a", "d"]
