"""Exchanges of labels in cycles, against brute force over all orders of all markers."""

import numpy as np
import pytest

from markermend.detection.labelling.cycles import (
    find_cycle_changes,
    find_cycle_exchanges,
    map_cycles,
)
from markermend.options.detection.labels import LabelsOptions
from markermend.prediction.scene import Scene
from support.exchanged import moving
from support.naive import labels as naive

OPTIONS = LabelsOptions()


def first_lowest(cycle):
    at = cycle.index(min(cycle))
    return tuple(cycle[at:] + cycle[:at])


@pytest.mark.parametrize("seed", range(12))
def test_changes_are_those_of_brute_force_over_all_cycles(seed):
    recorded, cycle = moving(seed)
    recorded[np.random.default_rng(seed).random(recorded.shape[:2]) < 0.01] = np.nan
    sudden = np.zeros(recorded.shape[:2], bool)
    sudden[12:19] = True
    found = [(change.frame, change.cycle) for change in find_cycle_changes(recorded, sudden, OPTIONS)]
    expected = naive.cycle_changes(recorded, sudden, ratio=OPTIONS.max_remaining_fraction, floor_mm=OPTIONS.floor_mm)
    assert sorted(found) == sorted(expected)
    if seed < 5:
        complete, cycle = moving(seed)
        assert (15, first_lowest(cycle)) in [
            (change.frame, change.cycle) for change in find_cycle_changes(complete, sudden, OPTIONS)
        ]


def test_the_cycles_of_a_map():
    assert map_cycles(np.array([1, 2, 0, 4, 3, 3])) == [[0, 1, 2]]
    assert map_cycles(np.array([1, 2, 3, 1, 0])) == [[1, 2, 3]]
    assert map_cycles(np.array([0, 1, 2])) == []


@pytest.mark.parametrize("seed", range(5))
def test_the_shorter_part_is_the_exchanged_one(seed):
    rng = np.random.default_rng(seed)
    places = rng.uniform(-200, 200, (6, 3))
    positions = places + rng.normal(0, 0.5, (120, 6, 3))
    recorded = positions.copy()
    cycle = rng.permutation(6)[:3]
    recorded[80:100, np.roll(cycle, -1)] = positions[80:100, cycle]
    near = [np.delete(np.arange(6), m) for m in range(6)]
    sudden = np.ones(recorded.shape[:2], bool)
    [stretch] = find_cycle_exchanges(Scene(recorded, 100.0, near), sudden, OPTIONS)
    assert (stretch.start, stretch.stop) == (80, 100)
    under = dict(zip(stretch.permutation.markers, stretch.permutation.labels, strict=True))
    assert under == dict(zip(cycle.tolist(), np.roll(cycle, -1).tolist(), strict=True))
    assert stretch.score > 1
