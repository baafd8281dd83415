"""What a recording is: shapes that fit, names that are unique, runs and gaps as half-open intervals."""

import numpy as np
import pytest

from markermend.core.recording import Recording, gaps
from markermend.numerics.intervals import runs


def test_runs_are_half_open():
    assert list(runs(np.array([1, 1, 0, 0, 1, 0, 1], bool))) == [(0, 2), (4, 5), (6, 7)]
    assert list(runs(np.zeros(4, bool))) == []
    assert list(runs(np.ones(4, bool))) == [(0, 4)]
    assert list(runs(np.zeros(0, bool))) == []


def test_gaps_by_marker_then_start():
    positions = np.zeros((6, 2, 3))
    positions[:2, 1] = positions[4:, 1] = np.nan
    positions[3, 0, 1] = np.nan
    assert gaps(Recording(("A", "B"), positions, 100.0)) == [(0, 3, 4), (1, 0, 2), (1, 4, 6)]


def test_what_does_not_fit_is_refused():
    with pytest.raises(ValueError, match="do not fit"):
        Recording(("A",), np.zeros((4, 2, 3)), 100.0)
    with pytest.raises(ValueError, match="unique"):
        Recording(("A", "A"), np.zeros((4, 2, 3)), 100.0)
