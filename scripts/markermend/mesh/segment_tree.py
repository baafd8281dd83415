"""Segments of markers and how they hang on each other: clustering, the cost of an edge, the spanning tree, its root."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.cluster import hierarchy
from scipy.sparse import csgraph, csr_array
from scipy.spatial.distance import squareform

UNRELATED = 1e9
"""Stands for the dissimilarity (mm) of markers that no chain of known pairs connects."""


@dataclass(frozen=True)
class Skeleton:
    """Segments in a tree, markers as indices.

    members: markers of each segment. parent: segment that each hangs on, None for a root. parent_marker: the marker
    that each hangs on; for a root a marker of a child, None where it has none. names: those given by a user.
    """

    members: tuple[tuple[int, ...], ...]
    parent: tuple[int | None, ...]
    parent_marker: tuple[int | None, ...]
    names: tuple[str | None, ...]

    def renumbered(self, markers: list[int]) -> Skeleton:
        """Give the skeleton in which marker m is called markers[m]."""
        return Skeleton(
            members=tuple(tuple(markers[m] for m in part) for part in self.members),
            parent=self.parent,
            parent_marker=tuple(None if hook is None else markers[hook] for hook in self.parent_marker),
            names=self.names,
        )

    @property
    def component(self) -> tuple[int, ...]:
        """Component of each segment, the one with most markers first."""
        roots = []
        for s in range(len(self.members)):
            root, above = s, self.parent[s]
            while above is not None:
                root, above = above, self.parent[above]
            roots.append(root)
        size = {root: 0 for root in roots}
        for root, part in zip(roots, self.members, strict=True):
            size[root] += len(part)
        rank = {root: i for i, root in enumerate(sorted(size, key=lambda root: (-size[root], root)))}
        return tuple(rank[root] for root in roots)


def cluster(dissimilarity: np.ndarray, *, cut_mm: float) -> list[tuple[int, ...]]:
    """Group markers by average linkage, cut at cut_mm; single markers stay on their own.

    dissimilarity: (markers, markers), mm, NaN = unknown: there the shortest chain of known pairs stands in. Returns
    the marker indices of each segment, ordered by their first.
    """
    markers = len(dissimilarity)
    if markers < 2:
        return [(m,) for m in range(markers)]
    known = csgraph.csgraph_from_dense(dissimilarity, null_value=np.nan)
    chained = csgraph.shortest_path(known, directed=False)
    full = np.where(np.isnan(dissimilarity), np.minimum(chained, UNRELATED), dissimilarity)
    tree = hierarchy.linkage(squareform(full, checks=False), method="average")
    labels = hierarchy.fcluster(tree, cut_mm, criterion="distance")
    groups: dict[int, list[int]] = {}
    for m, label in enumerate(labels.tolist()):
        groups.setdefault(label, []).append(m)
    return [tuple(group) for group in groups.values()]


def edge_costs(hanging: np.ndarray, members: Sequence[tuple[int, ...]]) -> tuple[np.ndarray, np.ndarray]:
    """Cost of hanging each segment (row) on its best marker of each other segment (column), and that marker.

    hanging: (markers, markers), mm, cost of hanging marker (row) on marker (column), NaN = unknown. The cost of a
    segment is the mean over its markers with known cost; infinite where none is, and on the diagonal.
    """
    segments = len(members)
    rows = np.array([(np.nan_to_num(hanging[list(part)]).sum(axis=0)) for part in members])
    count = np.array([(~np.isnan(hanging[list(part)])).sum(axis=0) for part in members])
    mean = np.where(count > 0, rows / np.maximum(count, 1), np.inf)
    costs = np.full((segments, segments), np.inf)
    markers = np.zeros((segments, segments), int)
    for b, part in enumerate(members):
        best = np.argmin(mean[:, part], axis=1)
        markers[:, b] = np.array(part)[best]
        costs[:, b] = mean[np.arange(segments), markers[:, b]]
    np.fill_diagonal(costs, np.inf)
    return costs, markers


def spanning_tree(costs: np.ndarray, *, component_cost: float) -> csr_array:
    """Minimum spanning tree over min(cost a->b, cost b->a), without edges above component_cost.

    Returns a symmetric sparse bool matrix (segments, segments).
    """
    either = np.minimum(costs, costs.T)
    a, b = np.nonzero(np.triu(either <= component_cost, k=1))
    edges = csr_array((either[a, b] + 1.0, (a, b)), shape=costs.shape)  # + 1: an edge of cost 0 is still an edge
    tree = csgraph.minimum_spanning_tree(edges)
    return csr_array(tree + tree.T, dtype=bool)


def root_and_order(tree: csr_array, sizes: list[int]) -> tuple[list[int], list[int | None]]:
    """Order of segments, parents first, and the parent of each (by its old index), None for the root of a component.

    The root is the segment of least hop eccentricity, ties to more markers, then to the lower index. Components come
    by number of markers, the largest first.
    """
    count, labels = csgraph.connected_components(tree, directed=False)
    hops = csgraph.shortest_path(tree, directed=False, unweighted=True)
    eccentricity = np.where(np.isfinite(hops), hops, -1).max(axis=1)
    parts = [np.flatnonzero(labels == label).tolist() for label in range(count)]
    order: list[int] = []
    parents: list[int | None] = [None] * len(sizes)
    for part in sorted(parts, key=lambda part: (-sum(sizes[s] for s in part), part[0])):
        root = min(part, key=lambda s: (eccentricity[s], -sizes[s], s))
        reached, before = csgraph.breadth_first_order(tree, root, directed=False)
        order += reached.tolist()
        for s in reached[1:].tolist():
            parents[s] = int(before[s])
    return order, parents


def grow(dissimilarity: np.ndarray, hanging: np.ndarray, *, cut_mm: float, component_cost: float) -> Skeleton:
    """Infer segments and their tree from the pair statistics (markers, markers), mm, NaN = unknown."""
    members = cluster(dissimilarity, cut_mm=cut_mm)
    if not members:
        return Skeleton((), (), (), ())
    costs, markers = edge_costs(hanging, members)
    tree = spanning_tree(costs, component_cost=component_cost)
    order, parents = root_and_order(tree, [len(part) for part in members])
    place = {s: i for i, s in enumerate(order)}
    parent_markers: list[int | None] = []
    for s in order:
        above = parents[s]
        linked = tree[[s]].indices.tolist() if above is None else [above]
        parent_markers.append(int(markers[s, min(linked, key=lambda b: (costs[s, b], b))]) if linked else None)
    return Skeleton(
        members=tuple(members[s] for s in order),
        parent=tuple(None if (above := parents[s]) is None else place[above] for s in order),
        parent_marker=tuple(parent_markers),
        names=(None,) * len(order),
    )
