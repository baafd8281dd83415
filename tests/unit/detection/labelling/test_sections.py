"""The states in time with the largest sum, and the frames in which labels are judged."""

from itertools import pairwise, product

import numpy as np
import pytest

from markermend.detection.labelling.sections import better_states, find_borders, judged_rows
from markermend.options.detection.labels import LabelsOptions


def worth(value, states, penalty):
    changes = sum(a != b for a, b in pairwise(states))
    return value[list(states)].sum() - penalty * changes


@pytest.mark.parametrize("seed", range(20))
def test_no_other_states_are_worth_more(seed):
    value = np.random.default_rng(seed).normal(0, 2, 9)
    best = max(worth(value, states, 1.5) for states in product((False, True), repeat=9))
    assert worth(value, tuple(better_states(value, 1.5).tolist()), 1.5) == pytest.approx(best)


def test_every_piece_of_a_trajectory_is_looked_at():
    present = np.ones((1000, 2), bool)
    present[300:303, 0] = present[306:310, 0] = False
    border = find_borders(present, np.zeros_like(present))
    assert np.flatnonzero(border[:, 0]).tolist() == [300, 303, 306, 310]
    rows = judged_rows(present, border, rate=100.0, options=LabelsOptions(spacing_s=0.5))
    assert ((rows >= 303) & (rows < 306)).any()
    assert np.diff(rows).max() <= 50
