"""Scenes: what is observed, what is hidden, and results that are computed once."""

from dataclasses import replace

import numpy as np

from markermend.core.cache import CACHE_SIZE
from support.fillings import rigid_body, scene


def test_a_marker_is_observed_where_no_coordinate_is_missing():
    positions = rigid_body(frames=20, markers=4)
    positions[3, 1, 2] = np.nan
    seen = scene(positions)
    assert np.argwhere(~seen.present).tolist() == [[3, 1]]


def test_a_scene_without_a_marker_hides_it_and_nothing_else():
    seen = replace(scene(rigid_body(frames=50)), inherited_std=np.zeros((50, 6)))
    hidden = seen.without(2, 10, 20)
    assert np.isnan(hidden.positions[10:20, 2]).all() and np.isfinite(seen.positions).all()
    assert np.count_nonzero(~hidden.present) == 10
    assert hidden.measured is None and hidden.inherited_std is None
    assert hidden.without(2, 12, 18) is hidden


def test_gaps_have_two_borders_and_those_outside_the_recording_are_left_out():
    seen = scene(rigid_body(frames=30))
    assert seen.bordered(5, 8).tolist() == [4, 5, 6, 7, 8]
    assert seen.bordered(0, 2).tolist() == [0, 1, 2]
    assert seen.bordered(28, 30).tolist() == [27, 28, 29]


def test_results_are_computed_once_and_the_oldest_are_dropped():
    seen = scene(np.zeros((5, 2, 3)))
    calls = []
    for key in [*range(CACHE_SIZE), 0, CACHE_SIZE, 0, 2]:
        assert seen.cached(key, lambda key=key: calls.append(key) or key) == key
    assert calls == [*range(CACHE_SIZE + 1), 0]
