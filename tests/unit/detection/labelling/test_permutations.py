"""Permutations of labels, against names that are moved between slots."""

from itertools import permutations

import numpy as np
import pytest

from markermend.detection.labelling.permutations import Permutation, possible_permutations
from support.naive import labels as naive

MARKERS = (1, 3, 4, 6)


@pytest.mark.parametrize("seed", range(30))
def test_permutations_are_those_of_names_moved_between_slots(seed):
    rng = np.random.default_rng(seed)
    cycles = [rng.permutation(MARKERS).tolist() for _ in range(rng.integers(1, 5))]
    expected = naive.labels_after(MARKERS, cycles)
    possible = possible_permutations(MARKERS, cycles)
    assert [one.labels for one in possible[0]] == expected
    for right, own in enumerate(possible):
        assert own[right].is_identity
        for k, cycle in enumerate(cycles):
            assert own[k].after(cycle) == own[k + 1]


def test_relative_to_itself_a_permutation_is_the_identity():
    for labels in permutations(MARKERS):
        one = Permutation(MARKERS, labels)
        assert one.relative_to(one).is_identity
        assert one.relative_to(Permutation.identity(MARKERS)) == one
