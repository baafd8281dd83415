"""The usual shape: named distances in the order of a recording, and the steadiest markers."""

import numpy as np
import pytest

from markermend.core.shape import Shape, shape_of

DISTANCES = {
    "a": {"b": (100.0, 1.0, 2.0), "c": (300.0, 20.0, 25.0), "d": (80.0, 0.5, 4.0)},
    "b": {"c": (250.0, 9.0, 9.0)},
}


def test_distances_are_arranged_in_the_order_of_the_markers():
    shape = shape_of(DISTANCES, ["c", "a", "b", "x"])
    assert shape.distance[0, 1] == shape.distance[1, 0] == 300.0
    assert shape.deviation[1, 2] == 1.0
    assert shape.spread[2, 0] == 9.0
    assert np.isnan(shape.distance[3, :3]).all()
    assert (np.diag(shape.distance) == 0).all()


@pytest.mark.parametrize(("count", "among", "expected"), [(2, "abcd", "db"), (9, "abcd", "dbc"), (9, "abc", "bc")])
def test_steadiest_markers_come_first(count, among, expected):
    names = "abcd"
    shape = shape_of(DISTANCES, names)
    listed = shape.steadiest(0, count, among=np.array([name in among for name in names]))
    assert "".join(names[m] for m in listed) == expected


def test_markers_without_known_distances_are_not_listed():
    assert len(shape_of(DISTANCES, "dbx").steadiest(2, 5)) == 0


def test_rigid_mates_keep_their_distance():
    spread = np.array([[0, 1, 5, 2], [1, 0, 1, np.nan], [5, 1, 0, 9], [2, np.nan, 9, 0]])
    shape = Shape(spread, spread, spread)
    assert [shape.rigid_mates(m, max_spread_mm=2.0).tolist() for m in range(4)] == [[1, 3], [0, 2], [1], [0]]
