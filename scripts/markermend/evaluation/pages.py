"""The pages of the experiments: one a paper, and one over all. They work offline, in the style of the report.

Every number on them comes from a table that a rule wrote and that the page links to.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import pandas as pd
from jinja2 import Environment, FileSystemLoader

from markermend import __version__
from markermend.evaluation.charts import Chart
from markermend.evaluation.claims import NO, UNTESTED, YES
from markermend.report import rendering

TEMPLATES = Path(__file__).with_name("templates")

SIGNIFICANT_DIGITS = 4
"""Digits of numbers in the tables of pages; the files have more."""

LONG_TABLE = 24
"""Rows above which a table is folded."""


@dataclass(frozen=True)
class Section:
    """A part of a page.

    Attributes
    ----------
    heading : str
        What was measured, with the number of the published table or figure.
    sentences : sequence of str
        Paragraphs above the chart.
    file : str
        Name of the table, a file beside the page.
    table : DataFrame or None
        What is shown of it; None for all.
    charts : sequence of Chart
        The charts.
    """

    heading: str
    sentences: Sequence[str] = ()
    file: str = ""
    table: pd.DataFrame | None = None
    charts: Sequence[Chart] = ()


@dataclass(frozen=True)
class Page:
    """The page of a paper.

    Attributes
    ----------
    title : str
        What the paper is about.
    reference : str
        The paper, as it is cited.
    lead : sequence of str
        Paragraphs on what was run and what differs from the paper.
    sections : sequence of Section
        Its parts.
    """

    title: str
    reference: str
    lead: Sequence[str]
    sections: Sequence[Section]


def paper_page(
    page: Page, tables: Mapping[str, pd.DataFrame], *, sizes: pd.DataFrame, options: Mapping[str, Any]
) -> str:
    """Write the page of a paper.

    Parameters
    ----------
    page : Page
        The paper's own parts.
    tables : mapping of str to DataFrame
        The tables by their names, of which `claims` is one.
    sizes : DataFrame
        The sizes of the recordings.
    options : mapping of str to Any
        The options of the experiments, JSON values.

    Returns
    -------
    str
        HTML.
    """
    claims = tables["claims"]
    return _render(
        "paper.html.j2",
        page=page,
        tables=tables,
        claims=claims.to_dict("records"),
        counts=count_claims(claims),
        sizes=sizes,
        options={name: json.dumps(value, ensure_ascii=False) for name, value in options.items()},
        long=LONG_TABLE,
    )


def papers_page(papers: Mapping[str, tuple[Page, pd.DataFrame]]) -> str:
    """Write the page over all papers.

    Parameters
    ----------
    papers : mapping of str to (Page, DataFrame)
        The page and the claims of each paper, by the name of its folder.

    Returns
    -------
    str
        HTML.
    """
    rows = {
        name: {"page": page, "counts": count_claims(claims), "claims": claims.to_dict("records")}
        for name, (page, claims) in papers.items()
    }
    return _render("papers.html.j2", papers=rows)


def count_claims(claims: pd.DataFrame) -> dict[str, int]:
    """Count the statements of a paper by whether they hold.

    Parameters
    ----------
    claims : DataFrame
        See claims.claims_table.

    Returns
    -------
    dict of str to int
        Numbers for YES, NO and UNTESTED.
    """
    return {holds: int((claims["holds"] == holds).sum()) for holds in (YES, NO, UNTESTED)}


def cell(value: Any) -> str:
    """Write a value of a table.

    Parameters
    ----------
    value : Any
        Text or number.

    Returns
    -------
    str
        Numbers with SIGNIFICANT_DIGITS at most; an en dash where there is none.
    """
    if isinstance(value, str):
        return value
    if value is None or value is pd.NA or value != value:
        return "–"
    if float(value).is_integer() and abs(value) < 1e9:
        return f"{int(value)}"
    if abs(value) < 1e-4 or abs(value) >= 1e6:
        return f"{value:.2e}"
    digits = math.floor(math.log10(abs(value))) + 1
    decimals = f"{value:.{max(0, SIGNIFICANT_DIGITS - digits)}f}"
    return decimals.rstrip("0").rstrip(".") if "." in decimals else decimals


def without_empty_columns(table: pd.DataFrame) -> pd.DataFrame:
    """Leave out columns that say nothing.

    Parameters
    ----------
    table : DataFrame
        A table of a page.

    Returns
    -------
    DataFrame
        The columns in which any value is neither missing nor "".
    """
    return table.loc[:, [bool((table[name].notna() & (table[name] != "")).any()) for name in table]]


def _render(template: str, **parts: Any) -> str:
    """Fill in a template."""
    return _environment().get_template(template).render(version=__version__, **parts) + "\n"


@cache
def _environment() -> Environment:
    """The templates of these pages, on top of those of the report."""
    made = rendering.environment().overlay(loader=FileSystemLoader([TEMPLATES, rendering.TEMPLATES]))
    made.filters = {**made.filters, "cell": cell, "without_empty_columns": without_empty_columns}
    return made
