"""The page of the model averaging paper: a chart for each recording and figure, the paper's names."""

import numpy as np
import pandas as pd
import pytest

from markermend.evaluation.pma2018.page import display_name, make_page


def test_methods_have_the_names_of_the_paper():
    assert display_name("local_grnn") == "4 LGRNN"
    assert display_name("pma_1_3_4_5") == "PMA 1, 3, 4, 5"
    assert display_name("default") == "our ensemble"


@pytest.fixture
def tables():
    def figure(column, values):
        rows = [
            {"recording": name, "sequence": "", "gaps": 3, "length_s": 1.0, "duration_s": np.nan, column: value}
            | {"method": method, "error_mm": 5.0, "standard_error_mm": 1.0, "published": ""}
            for name in ("a", "b")
            for value in values
            for method in ("local_grnn", "bolero")
        ]
        return pd.DataFrame(rows)

    own = {"lengths": figure("length_s", (1, 2)), "durations": figure("duration_s", (5,))}
    own |= {"gap_counts": figure("gaps", (1, 3))}
    means = pd.concat([table[table["recording"] == "a"].assign(figure=name) for name, table in own.items()])
    constraints = pd.DataFrame({"recording": ["a"], "constrained_mm": [1.234], "p": [0.00123]})
    return {**own, "means": means, "constraints": constraints}


def test_the_page_has_a_chart_for_each_recording_and_figure(tables):
    page = make_page(tables)
    assert [section.file for section in page.sections] == [
        f"{name}.tsv" for name in ("lengths", "durations", "gap_counts", "means", "constraints")
    ]
    titles = [chart.title for chart in page.sections[0].charts]
    assert titles == ["a", "a, without BoLeRo", "b", "b, without BoLeRo"]
    assert {trace["name"] for trace in page.sections[0].charts[1].figure["data"]} == {"4 LGRNN"}
    assert page.sections[4].table["constrained_mm"].tolist() == [1.2]
    assert page.sections[4].table["p"].tolist() == [0.00123]
