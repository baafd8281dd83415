"""Segments and their tree: against naive twins, and on small examples."""

import itertools

import numpy as np
import pytest

from markermend.mesh import segment_tree


def naive_cost(attachment, a, b):
    """Least mean cost of attaching markers a to one marker of b, and that marker."""
    best = (np.inf, b[0])
    for p in b:
        known = [attachment[c, p] for c in a if not np.isnan(attachment[c, p])]
        if known and sum(known) / len(known) < best[0]:
            best = (sum(known) / len(known), p)
    return best


def naive_tree_weight(weights):
    """Weight of the lightest spanning tree, by trying every set of edges."""
    nodes = len(weights)
    best = np.inf
    for edges in itertools.combinations(itertools.combinations(range(nodes), 2), nodes - 1):
        joined = list(range(nodes))
        for a, b in edges:
            joined = [joined[a] if x == joined[b] else x for x in joined]
        if len(set(joined)) == 1:
            best = min(best, sum(weights[a, b] for a, b in edges))
    return best


def test_edge_costs_equal_the_naive_twin():
    rng = np.random.default_rng(1)
    attachment = rng.uniform(0, 100, (12, 12))
    attachment[rng.random((12, 12)) < 0.3] = np.nan
    attachment[0, 3:6] = np.nan
    members = [(0,), (1, 2), (3, 4, 5), (6, 7, 8, 9), (10, 11)]
    costs, markers = segment_tree.edge_costs(attachment, members)
    for a, b in itertools.permutations(range(5), 2):
        assert (costs[a, b], markers[a, b]) == pytest.approx(naive_cost(attachment, members[a], members[b]))
    assert np.isinf(costs[0, 2])
    assert np.isinf(np.diagonal(costs)).all()


def test_spanning_tree_is_the_lightest_and_keeps_edges_of_cost_zero():
    costs = np.random.default_rng(2).uniform(0, 100, (5, 5))
    costs[0, 1] = 0.0
    np.fill_diagonal(costs, np.inf)
    tree = segment_tree.spanning_tree(costs, max_cost_mm=200.0)
    either = np.minimum(costs, costs.T)
    a, b = np.nonzero(np.triu(tree))
    assert either[a, b].sum() == pytest.approx(naive_tree_weight(either))
    assert (0, 1) in zip(a.tolist(), b.tolist(), strict=True)


def test_edges_above_the_component_cost_are_cut():
    costs = np.full((4, 4), 201.0)
    costs[0, 1], costs[3, 2] = 200.0, 10.0
    tree = segment_tree.spanning_tree(costs, max_cost_mm=200.0)
    assert np.argwhere(np.triu(tree)).tolist() == [[0, 1], [2, 3]]


@pytest.mark.parametrize(
    ("edges", "sizes", "root"),
    [
        ([(0, 1), (1, 2), (2, 3), (3, 4)], [1, 1, 1, 1, 1], 2),
        ([(0, 1), (1, 2), (2, 3)], [1, 1, 2, 1], 2),
        ([(0, 1), (1, 2), (2, 3)], [1, 1, 1, 1], 1),
        ([(3, 0), (3, 1), (3, 2)], [9, 9, 9, 1], 3),
    ],
)
def test_root_has_least_eccentricity_then_most_markers(edges, sizes, root):
    costs = np.full((len(sizes), len(sizes)), np.inf)
    for a, b in edges:
        costs[a, b] = 1.0
    order, parents = segment_tree.root_and_order(segment_tree.spanning_tree(costs, max_cost_mm=200.0), sizes)
    assert order[0] == root
    assert parents[root] is None
    for s in range(len(sizes)):
        assert s == root or order.index(parents[s]) < order.index(s)


def test_unknown_pairs_are_bridged_by_the_chain_of_known_ones():
    dissimilarity = np.array([[0, 1, np.nan, np.nan], [1, 0, 1, np.nan], [np.nan, 1, 0, np.nan], [np.nan] * 3 + [0]])
    assert segment_tree.cluster_markers(dissimilarity, cut_mm=12.0) == [(0, 1, 2), (3,)]


def test_cluster_cuts_average_linkage():
    near = np.array([[0, 4, 20, 22], [4, 0, 24, 26], [20, 24, 0, 0], [22, 26, 0, 0]], float)
    assert segment_tree.cluster_markers(near, cut_mm=12.0) == [(0, 1), (2, 3)]
    assert segment_tree.cluster_markers(near, cut_mm=22.9) == [(0, 1), (2, 3)]
    assert segment_tree.cluster_markers(near, cut_mm=23.1) == [(0, 1, 2, 3)]
    assert segment_tree.cluster_markers(near, cut_mm=3.9) == [(0,), (1,), (2, 3)]


@pytest.mark.parametrize("markers", [0, 1])
def test_too_few_markers_for_pairs(markers):
    empty = np.zeros((markers, markers))
    skeleton = segment_tree.infer_skeleton(empty, empty, cut_mm=12.0, max_cost_mm=200.0)
    assert skeleton.members == ((0,),) * markers
    assert skeleton.parent == skeleton.parent_marker == (None,) * markers


def naive_clusters(dissimilarity, cut):
    """Average linkage, one merge at a time, until the nearest two groups are farther apart than the cut."""
    groups = [[m] for m in range(len(dissimilarity))]
    while len(groups) > 1:
        means = {
            (a, b): np.mean([dissimilarity[i, j] for i in groups[a] for j in groups[b]])
            for a, b in itertools.combinations(range(len(groups)), 2)
        }
        (a, b), least = min(means.items(), key=lambda pair: pair[1])
        if least > cut:
            break
        groups[a] += groups.pop(b)
    return sorted(tuple(sorted(group)) for group in groups)


@pytest.mark.parametrize("seed", range(5))
def test_clusters_equal_the_naive_twin(seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(0, 10, (9, 3))
    dissimilarity = np.linalg.norm(points[:, None] - points[None], axis=2)
    for cut in (3.0, 10.0, 20.0):
        assert segment_tree.cluster_markers(dissimilarity, cut_mm=cut) == naive_clusters(dissimilarity, cut)


def test_the_cheapest_marker_is_that_of_least_mean_cost():
    attachment = np.random.default_rng(3).uniform(0, 100, (8, 8))
    attachment[0, 4] = np.nan
    part, choice = (0, 1), (3, 4, 6, 7)
    assert segment_tree.cheapest_marker(attachment, part, choice) == naive_cost(attachment, part, choice)[1]
    assert segment_tree.cheapest_marker(np.full((8, 8), np.nan), part, choice) == 3
    assert segment_tree.cheapest_marker(attachment, part, ()) is None


def test_components_come_by_number_of_markers():
    skeleton = segment_tree.Skeleton(((0,), (1, 2), (3,), (4, 5)), (None, None, 1, None), (None,) * 4, (None,) * 4)
    assert skeleton.component == (2, 0, 0, 1)
    moved = skeleton.renumbered([10, 11, 12, 13, 14, 15])
    assert moved.members == ((10,), (11, 12), (13,), (14, 15)) and moved.parent == skeleton.parent
