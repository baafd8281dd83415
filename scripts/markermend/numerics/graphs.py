"""Graphs of markers and segments: spanning trees, components, paths and clusters, for at most some hundred nodes.

scipy has all of these; importing it takes longer than they do.
"""

from __future__ import annotations

from collections import deque

import numpy as np


def spanning_tree(costs: np.ndarray) -> list[tuple[int, int]]:
    """Find the minimum spanning tree of each component of a graph.

    Parameters
    ----------
    costs : np.ndarray
        Cost of each edge (n, n), symmetric; infinite where there is none.

    Returns
    -------
    list of tuple of int
        The edges, each with its smaller node first, sorted.

    References
    ----------
    Prim (1957), Bell System Technical Journal 36(6).
    """
    count, edges = len(costs), []
    least, nearest, outside = np.full(count, np.inf), np.full(count, -1), np.ones(count, bool)
    for _ in range(count):
        node = (
            int(np.where(outside, least, np.inf).argmin())
            if np.isfinite(least[outside]).any()
            else int(outside.argmax())
        )
        if nearest[node] >= 0:
            edges.append((min(node, int(nearest[node])), max(node, int(nearest[node]))))
        outside[node], least[node] = False, np.inf
        nearer = outside & (costs[node] < least)
        least[nearer], nearest[nearer] = costs[node, nearer], node
    return sorted(edges)


def adjacency(edges: list[tuple[int, int]], count: int) -> np.ndarray:
    """Make the symmetric matrix of a graph.

    Parameters
    ----------
    edges : list of tuple of int
        The edges.
    count : int
        Number of nodes.

    Returns
    -------
    np.ndarray
        Whether two nodes share an edge, bool (count, count).
    """
    adjacent = np.zeros((count, count), bool)
    for one, other in edges:
        adjacent[one, other] = adjacent[other, one] = True
    return adjacent


def breadth_first(adjacent: np.ndarray, root: int) -> tuple[list[int], dict[int, int]]:
    """Visit the nodes of a component, those with fewer edges to the root first, among these the nodes of the same parent by number.

    Parameters
    ----------
    adjacent : np.ndarray
        Whether two nodes share an edge, bool (n, n), symmetric.
    root : int
        Where to begin.

    Returns
    -------
    order : list of int
        The nodes, the root first.
    parent : dict of int to int
        The node from which each other one was reached.
    """
    order, parent, waiting = [root], dict[int, int](), deque([root])
    seen = np.zeros(len(adjacent), bool)
    seen[root] = True
    while waiting:
        node = waiting.popleft()
        reached = np.flatnonzero(adjacent[node] & ~seen).tolist()
        seen[reached] = True
        parent |= dict.fromkeys(reached, node)
        order += reached
        waiting.extend(reached)
    return order, parent


def components(adjacent: np.ndarray) -> np.ndarray:
    """Number the components of a graph.

    Parameters
    ----------
    adjacent : np.ndarray
        Whether two nodes share an edge, bool (n, n), symmetric.

    Returns
    -------
    np.ndarray
        Number of the component (n,) of each node, by first nodes.
    """
    labels, count = np.full(len(adjacent), -1), 0
    for node in range(len(adjacent)):
        if labels[node] < 0:
            labels[breadth_first(adjacent, node)[0]], count = count, count + 1
    return labels


def shortest_paths(lengths: np.ndarray) -> np.ndarray:
    """Compute the lengths of the shortest paths between all nodes.

    Parameters
    ----------
    lengths : np.ndarray
        Lengths of the edges (n, n), symmetric, at least 0; infinite where there is none.

    Returns
    -------
    np.ndarray
        Lengths of the paths (n, n), 0 from a node to itself; infinite where there is none.

    References
    ----------
    Floyd (1962), Communications of the ACM 5(6).
    """
    paths = lengths.astype(float)
    np.fill_diagonal(paths, 0.0)
    for node in range(len(paths)):
        paths = np.minimum(paths, paths[:, [node]] + paths[node])
    return paths


def average_linkage(dissimilarity: np.ndarray, cut: float) -> list[tuple[int, ...]]:
    """Cluster nodes by average linkage.

    Parameters
    ----------
    dissimilarity : np.ndarray
        Dissimilarity of each pair (n, n), symmetric.
    cut : float
        Clusters are joined up to this mean dissimilarity of their pairs.

    Returns
    -------
    list of tuple of int
        The nodes of each cluster, ascending; ordered by their first.

    References
    ----------
    Sokal, Michener (1958), University of Kansas Science Bulletin 38: UPGMA.
    """
    between = dissimilarity.astype(float)
    np.fill_diagonal(between, np.inf)
    clusters = {node: [node] for node in range(len(between))}
    while len(clusters) > 1:
        one, other = sorted(divmod(int(between.argmin()), len(between)))
        if not between[one, other] <= cut:
            break
        sizes = len(clusters[one]), len(clusters[other])
        joined = (sizes[0] * between[one] + sizes[1] * between[other]) / sum(sizes)
        between[one], between[:, one] = joined, joined
        between[one, one] = np.inf
        between[other], between[:, other] = np.inf, np.inf
        clusters[one] += clusters.pop(other)
    return sorted(tuple(sorted(cluster)) for cluster in clusters.values())
