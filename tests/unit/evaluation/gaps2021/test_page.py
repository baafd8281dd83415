"""The page of the experiment: every chart has lines, and published points where the paper has figures."""

from markermend.evaluation.gaps2021.jobs import TABLES
from markermend.evaluation.gaps2021.page import make_page
from markermend.evaluation.gaps2021.tables import make_tables

from .conftest import OPTIONS


def test_the_page_shows_every_table(runs, descriptors, figures):
    tables = make_tables(runs, descriptors, figures, OPTIONS)
    page = make_page(tables)
    assert {section.file for section in page.sections} == {f"{name}.tsv" for name in TABLES if name != "claims"}
    errors = page.sections[0]
    assert len(errors.charts) == 2 * 6
    names = [trace["name"] for trace in errors.charts[0].figure["data"]]
    others = [trace["name"] for trace in errors.charts[1].figure["data"]]
    assert "mSVD" in others and "mSVD, published" not in others  # printed is linear interpolation
    assert names[:2] == ["FFNN lin", "FFNN lin, published"] and len(names) == 2 * 5


def test_the_page_of_one_recording_has_no_correlations(runs, descriptors, figures):
    own = runs[runs["recording"] == "static"]
    tables = make_tables(own, descriptors[descriptors["recording"] == "static"], figures, OPTIONS)
    assert not make_page(tables).sections[5].charts
