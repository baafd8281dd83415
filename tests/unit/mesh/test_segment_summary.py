"""What a mesh states: excitation, residuals and confidence in loops, predictors and neighbours one by one."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.mesh.pair_statistics import PairStatistics
from markermend.mesh.segment_summary import SegmentSummary, assess_excitation, named, rank_markers
from markermend.mesh.segment_tree import Skeleton
from markermend.options.mesh import MeshOptions

OPTIONS = MeshOptions()
SKELETON = Skeleton(((0, 1, 2), (3, 4), (5,)), (None, 0, None), (3, 2, None), ("trunk", None, None))


@pytest.fixture
def statistics():
    rng = np.random.default_rng(1)
    deviation = rng.uniform(0, 40, (6, 6))
    deviation = (deviation + deviation.T) / 2
    deviation[0, 4] = deviation[4, 0] = np.nan
    np.fill_diagonal(deviation, 0)
    return PairStatistics(tuple("abcdef"), np.full(6, 100), np.full((6, 6), 300.0), deviation, np.zeros((6, 6)), 20.0)


def pairs(part):
    return [(a, b) for a in part for b in part if a < b]


def test_segments_equal_the_definitions_in_loops(statistics):
    dissimilarity = statistics.dissimilarity(300.0)
    attachment = statistics.attachment_costs(dissimilarity)
    found = SegmentSummary(SKELETON, statistics, dissimilarity, attachment, 12.0, 0.5).segments()
    for s, (part, segment) in enumerate(zip(SKELETON.members, found, strict=True)):
        inner = np.mean([dissimilarity[pair] for pair in pairs(part)]) if pairs(part) else 12.0
        squares = [statistics.deviation[pair] ** 2 for pair in pairs(part)]
        others = [other for k, other in enumerate(SKELETON.members) if k != s]
        outer = [np.nanmean([dissimilarity[a, b] for a in part for b in other]) for other in others]
        assert segment.residual_mm == pytest.approx(np.sqrt(np.mean(squares) / 2) if squares else 0.0, abs=1e-6)
        assert segment.confidence == pytest.approx(0.5 * max(0.0, 1 - inner / min(outer)), abs=1e-6)
    assert [segment.name for segment in found] == ["trunk", "d+e", "f"]
    assert [segment.parent_marker for segment in found] == ["d", "c", None]
    assert found[0].edge_cost is found[2].edge_cost is None
    assert found[1].edge_cost == pytest.approx(np.mean([attachment[3, 2], attachment[4, 2]]), abs=1e-6)
    assert [segment.component for segment in found] == [0, 0, 1]


def test_a_long_segment_is_named_by_three_markers(statistics):
    skeleton = Skeleton(((0, 1, 2, 3, 4, 5),), (None,), (None,), (None,))
    matrix = np.zeros((6, 6))
    (segment,) = SegmentSummary(skeleton, statistics, matrix, matrix, 12.0, 1.0).segments()
    assert segment.name == "a+b+c+3" and segment.confidence == 1.0


def test_predictors_and_neighbours_equal_those_sorted_one_by_one(statistics):
    dissimilarity = statistics.dissimilarity(300.0)
    predictors, neighbours = rank_markers(SKELETON, dissimilarity, min_predictors=4, max_neighbours=3)
    component, segment = (0, 0, 0, 0, 0, 1), (0, 0, 0, 1, 1, 2)
    for m in range(6):
        related = [o for o in range(6) if o != m and component[o] == component[m]]
        known = sorted(
            (o for o in related if dissimilarity[m, o] == dissimilarity[m, o]), key=lambda o: dissimilarity[m, o]
        )
        assert neighbours[m] == known[:3]
        mates = [o for o in known if segment[o] == segment[m]]
        host = SKELETON.parent_marker[segment[m]]
        first = mates + ([] if host is None else [host])
        assert predictors[m] == first + [o for o in known if o not in first][: max(0, 4 - len(first))]
    assert named({1: [0, 2]}, "abc") == {"a": (), "b": ("a", "c"), "c": ()}


@pytest.mark.parametrize(
    ("changed", "lack"),
    [
        ({"seconds": 4.0}, "only 4.0 s of motion (10 s wanted)"),
        ({"deviation": np.full((6, 6), 12.0)}, "distances vary by only 12 mm (30 mm wanted)"),
    ],
)
def test_what_is_too_little_is_named_and_lowers_the_share(changed, lack, statistics):
    enough = replace(statistics, deviation=np.full((6, 6), 31.0))
    assert assess_excitation(enough, segments=3, markers=6, options=OPTIONS).share == 1.0
    excitation = assess_excitation(replace(enough, **changed), segments=3, markers=6, options=OPTIONS)
    assert excitation.share == pytest.approx(0.4)
    assert excitation.lacks == (lack,)


def test_too_few_segments_are_named(statistics):
    enough = replace(statistics, deviation=np.full((6, 6), 31.0))
    excitation = assess_excitation(enough, segments=1, markers=24, options=OPTIONS)
    assert excitation.share == pytest.approx(0.25)
    assert excitation.lacks[0] == "only 1 segments for 24 markers (4 wanted)"
