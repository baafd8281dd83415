"""The page of the model averaging paper: a chart for each recording and figure, and the tests with their standard errors."""

import numpy as np
import pandas as pd
import pytest

from markermend.evaluation.pma2018.page import make_page


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
    row = {
        "sequence": "CMU1",
        "recording": "a",
        "table": 2,
        "variant": "text",
        "runs": 8,
        "p": 0.00123,
        "p_published": "0.008",
    }
    for name in ("unconstrained", "constrained"):
        row |= {
            f"{name}_mm": 1.234,
            f"{name}_standard_error_mm": 0.26,
            f"{name}_median_mm": 1.06,
            f"{name}_published": "2.1",
        }
    constraints = pd.DataFrame([{**row, "p_wilcoxon": 0.5}])
    return {**own, "means": means, "constraints": constraints}


def test_the_page_has_a_chart_for_each_recording_and_figure(tables):
    page = make_page(tables)
    assert [section.file for section in page.sections] == [
        f"{name}.tsv" for name in ("lengths", "durations", "gap_counts", "means", "constraints")
    ]
    titles = [chart.title for chart in page.sections[0].charts]
    assert titles == ["a", "a, without BoLeRo", "b", "b, without BoLeRo"]
    assert {trace["name"] for trace in page.sections[0].charts[1].figure["data"]} == {"4 LGRNN"}
    shown = page.sections[4].table.iloc[0]
    assert shown["with constraints, mm"] == "1.2 ± 0.3" and shown["with, published"] == "2.1"
    assert shown["p"] == 0.00123 and shown["constrained median, mm"] == 1.1
