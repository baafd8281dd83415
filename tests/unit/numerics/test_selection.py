"""Cells of arrays: equal to those that numpy takes by an open mesh."""

import numpy as np
import pytest

from markermend.numerics.selection import cells


@pytest.mark.parametrize("rows", [[0, 5, 5, 2], [], range(9)])
def test_cells_are_those_of_an_open_mesh(rows):
    values = np.random.default_rng(1).normal(size=(9, 4, 3))
    chosen, columns = np.array(rows, int), np.array([3, 0])
    found = cells(values, chosen, columns)
    np.testing.assert_array_equal(found, values[np.ix_(chosen, columns)])
    found[:] = 0
    assert values.all()
