"""Morphology that never looks across a gap: against its naive twin."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from markermend.numerics import morphology
from support.naive import numerics as naive
from support.signals import gappy


@given(st.integers(0, 200), st.sampled_from([1, 3, 7, 13]))
def test_morphology_equals_its_naive_twin(seed, size):
    values = gappy(seed)
    eroded = naive.under_element(values, size, np.min)
    dilated = naive.under_element(values, size, np.max)
    np.testing.assert_array_equal(morphology.erosion(values, size), eroded)
    np.testing.assert_array_equal(morphology.dilation(values, size), dilated)
    opened = naive.under_element(eroded, size, np.max)
    np.testing.assert_array_equal(morphology.opening(values, size), opened)
    np.testing.assert_array_equal(morphology.closing(values, size), naive.under_element(dilated, size, np.min))
    np.testing.assert_array_equal(morphology.top_hat(values, size), values - opened)
    seen = ~np.isnan(values)
    assert (morphology.top_hat(values, size)[seen] >= 0).all()
    assert (morphology.closing(values, size)[seen] >= values[seen]).all()
