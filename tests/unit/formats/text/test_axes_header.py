"""The line of axes shows where the trajectories stand, the line above it their names."""

from markermend.formats.text.axes_header import below_axes, consecutive, find_axes, triples
from markermend.formats.text.lines import Sheet

SHEET = Sheet(
    "walk.csv", b"", (b",time,LASI,,,RASI", b"frame,time,X,Y,Z,x,y,z", b",,mm", b"1,0,1,2,3,4,5,6"), b"\n", "utf-8"
)


def test_triples_begin_where_x_y_z_stand_side_by_side() -> None:
    assert triples(["X", "X", "Y", "Z", "x", "y", "z", "Y", "Z"], 0) == [1, 4]
    assert triples(["X", "Y", "Z"], 1) == []
    assert consecutive([1, 4]) == ((1, 2, 3), (4, 5, 6))


def test_names_axes_and_units_in_three_lines() -> None:
    assert find_axes(SHEET, range(4), b",") == 1
    assert find_axes(SHEET, range(2, 4), b",") is None
    layout = below_axes(SHEET, 1, b",", "csv", 50.0)
    assert (layout.names, layout.columns) == (("LASI", "RASI"), ((2, 3, 4), (5, 6, 7)))
    assert (layout.unit, layout.rate, layout.frame, layout.time, layout.rows) == ("mm", 50.0, 0, 1, [3])
