"""Exchanges of two labels: the frames at which two markers change places, and the stretches between them."""

import numpy as np
import pytest

from markermend.detection.labelling.pairs import (
    PairChange,
    exchanged_stretches,
    find_pair_changes,
    find_pair_exchanges,
)
from markermend.detection.labels import sudden_steps
from markermend.options.detection.labels import LabelsOptions
from markermend.prediction.scene import Scene
from support.exchanged import NEAR, scene

OPTIONS = LabelsOptions()


def everywhere(one):
    sudden = np.ones(one.present.shape, bool)
    sudden[0] = False
    return sudden


def changes(one):
    found = find_pair_changes(one, everywhere(one), window=11, options=OPTIONS)
    return [(change.first, change.second, change.frame) for change in found]


@pytest.mark.parametrize("seed", range(5))
def test_two_markers_change_places_at_the_ends_of_a_span(seed):
    assert changes(scene((40, 60), seed=seed)) == [(0, 1, 40), (0, 1, 60)]
    assert changes(scene(seed=seed)) == []


def test_one_goes_to_where_the_other_was_a_frame_before():
    half = scene((40, 60))
    half.positions[40:60, 1] = np.nan
    sudden = sudden_steps(half.positions, window=11, options=OPTIONS)
    found = find_pair_changes(half, sudden, window=11, options=OPTIONS)
    assert [(change.first, change.second, change.frame) for change in found] == [(0, 1, 40), (0, 1, 60)]


def test_a_marker_takes_part_in_its_strongest_change_alone():
    positions = scene((40, 60)).positions
    positions[40:60, 2] = positions[40:60, 1] + 2
    found = find_pair_changes(Scene(positions, 100.0, NEAR), everywhere(scene()), window=11, options=OPTIONS)
    at = [change for change in found if change.frame == 40]
    assert len({m for change in at for m in (change.first, change.second)}) == 2 * len(at)


@pytest.mark.parametrize("spans", [[(40, 60)], [(100, 120)], [(0, 30)], [(20, 30), (50, 70)]])
def test_the_stretches_between_changes_that_the_shape_and_their_length_call_exchanged(spans):
    one = scene(*spans)
    found = find_pair_exchanges(one, everywhere(one), window=11, options=OPTIONS)
    assert [(stretch.start, stretch.stop) for stretch in found] == spans
    assert {(stretch.permutation.markers, stretch.permutation.labels) for stretch in found} == {((0, 1), (1, 0))}


def test_without_a_change_or_a_clear_shape_nothing_is_exchanged():
    assert exchanged_stretches(scene((40, 60)), (0, 1), [], OPTIONS) == []
    alike = scene()
    alike.positions[:, 1] = alike.positions[:, 0]
    assert exchanged_stretches(alike, (0, 1), [PairChange(0, 1, 60, 2.0)], OPTIONS) == []
