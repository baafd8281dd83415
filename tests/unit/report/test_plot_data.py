"""What a plot shows is the trajectory around a finding, to a hundredth of a mm."""

import numpy as np

from markermend.core.changes import Change, Outcome
from markermend.report.plot_data import delta, excerpt


def unpack(series):
    """Plain reading of a packed series: (offset, values) for each run."""
    return [(offset, np.cumsum(columns, axis=1).T / 100) for offset, *columns in series]


def test_an_excerpt_holds_the_window_to_a_hundredth(before, after, changes):
    gap = changes[0]
    cut = excerpt(gap, before, after, context_s=0.2, frames=100)
    assert (cut["first"], cut["step"], cut["frames"], cut["span"], cut["origin"]) == (103, 1, 6, [105, 107], 101)
    (first, early), (second, late) = unpack(cut["before"])
    assert (first, second) == (0, 5)
    np.testing.assert_allclose(early, before.positions[2:4, 1], atol=0.005)
    np.testing.assert_allclose(late, before.positions[7:8, 1], atol=0.005)
    ((offset, filled),) = unpack(cut["after"])
    assert offset == 1, "one measured sample joins the filled ones to the curve"
    np.testing.assert_allclose(filled[:, :3], after.positions[3:6, 1], atol=0.005)
    np.testing.assert_allclose(filled[:, 3:], [[0, 0], [2, 4], [6, 12]], atol=0.005)


def test_a_long_excerpt_thins_its_frames(before, after, changes):
    cut = excerpt(changes[0], before, after, context_s=9.0, frames=4)
    assert (cut["first"], cut["step"], cut["frames"]) == (101, 3, 4)


def test_a_swap_shows_its_partner(before, after):
    cut = excerpt(Change("A", 2, 4, ("swap",), Outcome.LEFT, partner="C"), before, after, context_s=0.1, frames=100)
    ((offset, values),) = unpack(cut["partner"])
    np.testing.assert_allclose(values, before.positions[1:5, 2], atol=0.005)
    assert offset == 0


def test_differences_restore_the_numbers():
    values = np.random.default_rng(3).normal(0, 2000, 500)
    np.testing.assert_allclose(np.cumsum(delta(values)) / 100, values, atol=0.00501)
