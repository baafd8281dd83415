"""Order statistics of few arrays, against numpy."""

import numpy as np
import pytest

from markermend.numerics import ranks


@pytest.mark.parametrize("count", range(1, 9))
def test_medians_and_ranks_are_those_of_numpy(count):
    values = np.random.default_rng(count).integers(0, 5, (count, 30, 2)).astype(float)
    np.testing.assert_array_equal(ranks.median(list(values)), np.median(values, axis=0))
    for rank in range(count):
        np.testing.assert_array_equal(ranks.sorted_from(list(values), rank)[rank], np.sort(values, axis=0)[rank])
