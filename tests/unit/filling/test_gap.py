"""Gaps and their kinds: found one sample at a time, and classified by what they share."""

import numpy as np

from markermend.filling.gap import Gap, GapKind, find_gaps, gap_kind, known_kind
from markermend.prediction.scene import Scene


def naive_gaps(missing):
    """The gaps of a recording, one sample at a time."""
    found = []
    for marker in range(missing.shape[1]):
        for frame in range(len(missing)):
            if missing[frame, marker] and (frame == 0 or not missing[frame - 1, marker]):
                stop = frame
                while stop < len(missing) and missing[stop, marker]:
                    stop += 1
                found.append(Gap(marker, frame, stop))
    return found


def test_gaps_equal_those_found_one_sample_at_a_time():
    missing = np.random.default_rng(1).random((80, 6)) < 0.4
    missing[:, 4], missing[:, 5] = True, False
    assert list(find_gaps(missing)) == naive_gaps(missing)


def test_a_gap_is_an_index_of_its_samples():
    gap = Gap(2, 3, 7)
    samples = np.zeros((9, 4), int)
    samples[gap.samples] = 1
    assert gap.length == samples.sum() == samples[3:7, 2].sum() == 4


def test_a_kind_holds_length_ends_and_missing_neighbours():
    positions = np.zeros((100, 4, 3))
    positions[:10, 0] = positions[5:8, 2] = positions[5:8, 3] = np.nan
    scene = Scene(positions, 100.0, [np.array([3, 1, 2])] * 4)
    kind = gap_kind(scene, Gap(0, 0, 10), length_ratio=2.0, neighbours=2)
    assert kind == GapKind(0, 3, (True, False), frozenset([3]))
    assert gap_kind(scene, Gap(0, 0, 10), length_ratio=2.0, neighbours=3).absent == {2, 3}
    lengths = [
        gap_kind(scene, Gap(1, 20, 20 + n), length_ratio=2.0, neighbours=2).length_class for n in (1, 2, 3, 4, 7, 8)
    ]
    assert lengths == [0, 1, 1, 2, 2, 3]


def test_a_new_kind_is_replaced_only_where_there_are_many_and_by_the_most_similar():
    inner = (False, False)
    known = [GapKind(7, 2, inner, frozenset([1])), GapKind(7, 4, inner, frozenset()), GapKind(8, 3, inner, frozenset())]
    new = GapKind(7, 3, inner, frozenset([1, 2]))
    assert known_kind(new, known, max_kinds=3) == new
    assert known_kind(new, known, max_kinds=2) == known[0]
    assert known_kind(known[1], known, max_kinds=2) == known[1]
    at_start = GapKind(7, 3, (True, False), frozenset())
    assert known_kind(at_start, known, max_kinds=2) == at_start
