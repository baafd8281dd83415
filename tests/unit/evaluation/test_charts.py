"""Charts: ours are lines, published figures points of the same colour, and all of it is JSON."""

import json

import numpy as np
import pandas as pd

from markermend.evaluation import charts
from markermend.evaluation.charts import Axes

TABLE = pd.DataFrame(
    {
        "length": [10, 50, 10, 50],
        "method": ["spline", "spline", "linear", "linear"],
        "rmse": [0.5, 9.0, 1.8, np.nan],
        "published": ["0.348", "> 5", "1.27", ""],
        "standard_error": [0.1, 0.2, 0.3, np.nan],
    }
)
AXES = Axes("length", "rmse", "length, frames", "RMSE, mm", log_y=True)


def test_ours_are_lines_and_published_figures_are_points():
    figure = charts.lines(
        TABLE, AXES, by="method", title="static", published="published", error="standard_error"
    ).figure
    json.dumps(figure, allow_nan=False)
    ours, printed, other, _ = figure["data"]
    assert ours["name"] == "spline" and ours["y"] == [0.5, 9.0] and ours["error_y"]["array"] == [0.1, 0.2]
    assert printed["y"] == [0.348, None]  # a bound is no point
    assert printed["marker"]["color"] == ours["line"]["color"] != other["line"]["color"]
    assert other["y"] == [1.8, None]
    assert figure["layout"]["yaxis"]["type"] == "log"


def test_each_value_has_its_points():
    figure = charts.points(TABLE, AXES, by="method", title="static").figure
    json.dumps(figure, allow_nan=False)
    assert [(trace["name"], trace["mode"], trace["y"]) for trace in figure["data"]] == [
        ("spline", "markers", [0.5, 9.0]), ("linear", "markers", [1.8, None]),
    ]  # fmt: skip


def test_each_value_has_its_bars():
    figure = charts.bars(TABLE, AXES, by="method", title="static").figure
    json.dumps(figure, allow_nan=False)
    assert [trace["name"] for trace in figure["data"]] == ["spline", "linear"]


def test_a_matrix_shows_numbers_coloured_by_their_share_of_the_row():
    table = pd.DataFrame({"clean": [99, 0], "peaks": [1, 0]}, index=["clean", "peaks"])
    heat = charts.matrix(table, columns=["clean", "peaks"], title="", x_title="found", y_title="true").figure["data"][0]
    assert heat["z"] == [[99, 1], [0, 0]] and heat["text"] == [["99", "1"], ["0", "0"]]
