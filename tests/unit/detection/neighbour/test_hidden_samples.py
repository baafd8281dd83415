"""Hidden samples: markers are predicted without what is candidates of their neighbours, and none is left unpredicted."""

import numpy as np
import pytest

from markermend.core.events import Event
from markermend.detection.neighbour.hidden_samples import event_mask, hide_candidates, residuals_without
from markermend.prediction.scene import Scene
from support.predictors import MeanOfOthers, NeedsFrames


def scene(positions):
    count = positions.shape[1]
    return Scene(positions, 100.0, [np.delete(np.arange(count), m) for m in range(count)])


def test_events_are_marked_with_their_borders():
    mask = event_mask([Event("B", 1, 3, 1.0), Event("A", 8, 10, 1.0)], 10, "AB", border=2)
    assert np.flatnonzero(mask[:, 0]).tolist() == [6, 7, 8, 9]
    assert np.flatnonzero(mask[:, 1]).tolist() == [0, 1, 2, 3, 4]


@pytest.mark.parametrize("seed", range(5))
def test_a_marker_is_judged_as_recorded_among_neighbours_without_their_hidden_samples(seed):
    rng = np.random.default_rng(seed)
    positions, hidden = rng.normal(0, 10, (30, 4, 3)), rng.random((30, 4)) < 0.2
    found = residuals_without(MeanOfOthers(), scene(positions), hidden, [0, 2])
    assert found.shape == (30, 2, 3)
    for place, m in enumerate((0, 2)):
        seen = np.where(hidden[:, :, None], np.nan, positions)
        seen[:, m] = positions[:, m]
        np.testing.assert_allclose(found[:, place], MeanOfOthers().residuals(scene(seen), [m])[:, m])


def test_candidates_are_released_where_a_marker_could_not_be_predicted_any_more():
    positions = np.random.default_rng(1).normal(0, 10, (40, 3, 3))
    all_at_once = [Event(name, 10, 15, 2.0) for name in "ABC"]
    hidden, residual = hide_candidates(MeanOfOthers(), scene(positions), all_at_once, markers="ABC", border=0)
    assert not hidden.any() and np.isfinite(residual).all()
    two = all_at_once[:2]
    hidden, residual = hide_candidates(MeanOfOthers(), scene(positions), two, markers="ABC", border=0)
    assert hidden[10:15, :2].all() and hidden.sum() == 10
    assert np.isfinite(residual[:, :2]).all()


def test_candidates_are_released_where_too_few_frames_would_be_left():
    positions = np.random.default_rng(1).normal(0, 10, (40, 4, 3))
    long = [Event("A", 10, 30, 2.0)]
    hidden, residual = hide_candidates(NeedsFrames(), scene(positions), long, markers="ABCD", border=0)
    assert not hidden.any() and np.isfinite(residual).all()


def test_a_predictor_that_nothing_helps_ends_the_search():
    class Never:
        def residuals(self, scene, markers=None):
            return np.full(scene.positions.shape, np.nan)

    positions = np.zeros((20, 3, 3))
    hidden, _ = hide_candidates(Never(), scene(positions), [Event("A", 5, 9, 2.0)], markers="ABC", border=1)
    assert np.flatnonzero(hidden[:, 0]).tolist() == [4, 5, 6, 7, 8, 9]
