"""Charts of the pages: figures of plotly as plain dictionaries; ours are lines, published figures are points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

PALETTE = ("#0072b2", "#d98c00", "#009e73", "#cc79a7", "#56b4e9", "#c44e00", "#8a6d00", "#7a5195", "#5a6472", "#2cc69a")
"""Colours that remain different without red or green (Okabe & Ito), on white and on dark ground."""

DASHES = ("solid", "dash", "dot")
"""Lines by how often their colour was used before."""


@dataclass(frozen=True)
class Axes:
    """What is drawn against what.

    Attributes
    ----------
    x, y : str
        Columns of the table.
    x_title, y_title : str
        Titles, with units.
    log_x, log_y : bool
        Whether the axis is logarithmic.
    """

    x: str
    y: str
    x_title: str
    y_title: str
    log_x: bool = False
    log_y: bool = False


@dataclass(frozen=True)
class Chart:
    """A chart.

    Attributes
    ----------
    title : str
        Its title.
    figure : dict
        `data` and `layout` of plotly.
    """

    title: str
    figure: dict[str, Any]


def lines(
    table: pd.DataFrame, axes: Axes, *, by: str, title: str, published: str | None = None, error: str | None = None
) -> Chart:
    """Draw a line for each value of a column; published figures as open points of the same colour.

    Parameters
    ----------
    table : DataFrame
        One row a point.
    axes : Axes
        What is drawn against what.
    by : str
        The column whose values have a line each.
    title : str
        Title of the chart.
    published : str, optional
        The column of published figures; text that is no number is not drawn.
    error : str, optional
        The column of standard errors.

    Returns
    -------
    Chart
        The chart.
    """
    data: list[dict[str, Any]] = []
    for number, (name, own) in enumerate(table.groupby(by, sort=False)):
        color, x = PALETTE[number % len(PALETTE)], _values(own[axes.x])
        trace = {"type": "scatter", "x": x, "legendgroup": str(name), "hovertemplate": "%{x}: %{y:.4g}"}
        bars = {} if error is None else {"error_y": {"array": _values(own[error]), "thickness": 1, "width": 3}}
        ours = {
            "name": str(name),
            "mode": "lines+markers",
            "line": {"color": color, "width": 2, "dash": DASHES[number // len(PALETTE) % len(DASHES)]},
            "y": _values(own[axes.y]),
        }
        data.append({**trace, **ours, **bars})
        printed = pd.to_numeric(own[published], errors="coerce") if published else pd.Series(dtype=float)
        if printed.notna().any():
            marker = {"color": color, "size": 11, "symbol": "diamond-open", "line": {"width": 2}}
            drawn = {"name": f"{name}, published", "mode": "markers", "showlegend": False}
            data.append({**trace, **drawn, "marker": marker, "y": _values(printed)})
    return Chart(title, {"data": data, "layout": _layout(axes)})


def points(table: pd.DataFrame, axes: Axes, *, by: str, title: str) -> Chart:
    """Draw points, with a colour for each value of a column.

    Parameters
    ----------
    table : DataFrame
        One row a point.
    axes : Axes
        What is drawn against what.
    by : str
        The column whose values have a colour each.
    title : str
        Title of the chart.

    Returns
    -------
    Chart
        The chart.
    """
    data = [
        {
            "type": "scatter",
            "mode": "markers",
            "name": str(name),
            "x": _values(own[axes.x]),
            "y": _values(own[axes.y]),
            "marker": {"color": PALETTE[number % len(PALETTE)], "size": 7, "opacity": 0.8},
            "hovertemplate": "%{x}: %{y:.4g}",
        }
        for number, (name, own) in enumerate(table.groupby(by, sort=False))
    ]
    return Chart(title, {"data": data, "layout": _layout(axes)})


def bars(table: pd.DataFrame, axes: Axes, *, by: str, title: str) -> Chart:
    """Draw groups of bars, of which each has one bar for each value of a column.

    Parameters
    ----------
    table : DataFrame
        One row a bar.
    axes : Axes
        What is drawn against what; the groups are on the x axis.
    by : str
        The column whose values have a bar each, such as ours and published.
    title : str
        Title of the chart.

    Returns
    -------
    Chart
        The chart.
    """
    data = [
        {
            "type": "bar",
            "name": str(name),
            "x": _values(own[axes.x]),
            "y": _values(own[axes.y]),
            "marker": {"color": PALETTE[number % len(PALETTE)]},
        }
        for number, (name, own) in enumerate(table.groupby(by, sort=False))
    ]
    return Chart(title, {"data": data, "layout": {**_layout(axes), "barmode": "group"}})


def matrix(table: pd.DataFrame, *, columns: Sequence[str], title: str, x_title: str, y_title: str) -> Chart:
    """Draw a table of numbers as a map: numbers in cells, coloured by their share of the row.

    Parameters
    ----------
    table : DataFrame
        The index has the names of the rows.
    columns : sequence of str
        The columns that are drawn.
    title, x_title, y_title : str
        Titles of the chart and its axes.

    Returns
    -------
    Chart
        The chart; colours are in per cent.
    """
    values = table[list(columns)].to_numpy(float)
    total = values.sum(axis=1, keepdims=True)
    shares = 100 * np.divide(values, total, out=np.zeros_like(values), where=total > 0)
    heat = {
        "type": "heatmap",
        "x": list(columns),
        "y": [str(name) for name in table.index],
        "z": shares.round(3).tolist(),
        "text": [[f"{value:.0f}" if value >= 1000 else f"{value:.4g}" for value in row] for row in values],
        "texttemplate": "%{text}",
        "hovertemplate": "%{y} → %{x}: %{text} (%{z:.1f} %)<extra></extra>",
        "colorscale": [[0, "#f2f5f9"], [0.02, "#cfe3f3"], [0.5, "#5aa7d6"], [1, "#0072b2"]],
        "zmin": 0,
        "zmax": 100,
        "showscale": False,
    }
    layout = {"xaxis": {"title": {"text": x_title}}, "yaxis": {"title": {"text": y_title}, "autorange": "reversed"}}
    return Chart(title, {"data": [heat], "layout": layout})


def _layout(axes: Axes) -> dict[str, Any]:
    """The axes of a chart."""
    kinds = {True: {"type": "log"}, False: {"rangemode": "tozero"}}
    return {
        "xaxis": {"title": {"text": axes.x_title}, **({"type": "log"} if axes.log_x else {})},
        "yaxis": {"title": {"text": axes.y_title}, **kinds[axes.log_y]},
    }


def _values(column: pd.Series) -> list[Any]:
    """Values as JSON has them; None where there is none."""
    plain = column.tolist()
    return [None if value != value else value for value in plain]
