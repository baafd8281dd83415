"""Graphs, against scipy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.cluster import hierarchy
from scipy.sparse import csgraph, csr_array
from scipy.spatial.distance import squareform

from markermend.numerics import graphs


def costs(seed, count, share=0.3):
    """Costs of the edges of a graph, infinite where there is none."""
    rng = np.random.default_rng(seed)
    upper = np.triu(np.where(rng.random((count, count)) < share, rng.random((count, count)), np.inf), 1)
    upper[np.tril_indices(count)] = np.inf
    return np.minimum(upper, upper.T)


def sparse(weights):
    return csr_array(np.where(np.isfinite(weights), weights, 0.0))


@given(st.integers(0, 100), st.integers(1, 20))
def test_trees_components_paths_and_orders_are_those_of_scipy(seed, count):
    weights = costs(seed, count)
    tree = csgraph.minimum_spanning_tree(sparse(weights)).tocoo()
    expected = sorted(tuple(sorted(edge)) for edge in zip(tree.row.tolist(), tree.col.tolist(), strict=True))
    assert graphs.spanning_tree(weights) == expected
    np.testing.assert_allclose(graphs.shortest_paths(weights), csgraph.shortest_path(sparse(weights)))
    adjacent = graphs.adjacency(expected, count)
    np.testing.assert_array_equal(graphs.components(adjacent), csgraph.connected_components(adjacent)[1])
    order, parent = graphs.breadth_first(adjacent, 0)
    reached, before = csgraph.breadth_first_order(csr_array(adjacent), 0)
    assert order == reached.tolist() and parent == {node: before[node] for node in order[1:]}


@pytest.mark.parametrize("cut", [0.0, 0.2, 0.4, 0.6, 2.0])
@pytest.mark.parametrize("count", [1, 2, 25])
def test_clusters_are_those_of_scipy(cut, count):
    dissimilarity = costs(3, count, share=1.0)
    np.fill_diagonal(dissimilarity, 0.0)
    found = graphs.average_linkage(dissimilarity, cut)
    if count == 1:
        assert found == [(0,)]
        return
    labels = hierarchy.fcluster(hierarchy.linkage(squareform(dissimilarity), "average"), cut, "distance")
    assert found == sorted(tuple(np.flatnonzero(labels == label).tolist()) for label in np.unique(labels))
