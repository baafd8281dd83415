"""Segments of markers in a tree: clustering, the cost of an edge, the spanning tree, and its root."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.numerics import graphs

UNRELATED = 1e9
"""Stands for the dissimilarity (mm) of markers that no chain of known pairs connects."""


@dataclass(frozen=True)
class Skeleton:
    """Segments in a tree, markers as indices.

    Attributes
    ----------
    members : tuple of tuple of int
        The markers of each segment.
    parent : tuple of int or None
        The segment to which each is attached, None for a root.
    parent_marker : tuple of int or None
        The marker to which each is attached; for a root a marker of a child, None where it has none.
    names : tuple of str or None
        The names that a user gave.
    """

    members: tuple[tuple[int, ...], ...]
    parent: tuple[int | None, ...]
    parent_marker: tuple[int | None, ...]
    names: tuple[str | None, ...]

    def renumbered(self, markers: Sequence[int]) -> Skeleton:
        """Rename the markers.

        Parameters
        ----------
        markers : sequence of int
            The new index of each marker.

        Returns
        -------
        Skeleton
            The skeleton in which marker m is markers[m].
        """
        return Skeleton(
            members=tuple(tuple(markers[m] for m in part) for part in self.members),
            parent=self.parent,
            parent_marker=tuple(None if marker is None else markers[marker] for marker in self.parent_marker),
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


def cluster_markers(dissimilarity: np.ndarray, *, cut_mm: float) -> list[tuple[int, ...]]:
    """Group markers into rigid segments by average linkage.

    Parameters
    ----------
    dissimilarity : ndarray, shape (markers, markers)
        Dissimilarity of each pair, mm; where it is unknown (NaN), that of the shortest chain of known pairs stands in.
    cut_mm : float
        Dissimilarity at which the dendrogram is cut, mm.

    Returns
    -------
    list of tuple of int
        The markers of each segment, ordered by their first; single markers are segments.
    """
    markers = len(dissimilarity)
    if markers < 2:
        return [(m,) for m in range(markers)]
    unknown = np.isnan(dissimilarity)
    chained = graphs.shortest_paths(np.where(unknown, np.inf, dissimilarity))
    return graphs.average_linkage(np.where(unknown, np.minimum(chained, UNRELATED), dissimilarity), cut_mm)


def edge_costs(attachment: np.ndarray, members: Sequence[tuple[int, ...]]) -> tuple[np.ndarray, np.ndarray]:
    """Compute the cost of attaching each segment to the best marker of each other segment.

    Parameters
    ----------
    attachment : ndarray, shape (markers, markers)
        Cost of attaching the marker of the row to that of the column, mm; NaN = unknown.
    members : sequence of tuple of int
        The markers of each segment.

    Returns
    -------
    costs : ndarray, shape (segments, segments)
        Cost of attaching the segment of the row to that of the column, mm: the mean over its markers with known cost;
        infinite where none is known, and on the diagonal.
    markers : ndarray of int, shape (segments, segments)
        The marker of the column's segment at which that cost arises.
    """
    segments = len(members)
    rows = np.array([(np.nan_to_num(attachment[list(part)]).sum(axis=0)) for part in members])
    count = np.array([(~np.isnan(attachment[list(part)])).sum(axis=0) for part in members])
    mean = np.where(count > 0, rows / np.maximum(count, 1), np.inf)
    costs = np.full((segments, segments), np.inf)
    markers = np.zeros((segments, segments), int)
    for b, part in enumerate(members):
        best = np.argmin(mean[:, part], axis=1)
        markers[:, b] = np.array(part)[best]
        costs[:, b] = mean[np.arange(segments), markers[:, b]]
    np.fill_diagonal(costs, np.inf)
    return costs, markers


def cheapest_marker(attachment: np.ndarray, part: Sequence[int], choice: Sequence[int]) -> int | None:
    """Find the marker to which a segment is attached at the least cost.

    Parameters
    ----------
    attachment : ndarray, shape (markers, markers)
        Cost of attaching the marker of the row to that of the column, mm; NaN = unknown.
    part : sequence of int
        The markers of the segment.
    choice : sequence of int
        The markers to choose from.

    Returns
    -------
    int or None
        A marker of `choice`: the first where no cost is known, None where there is no choice.
    """
    return int(edge_costs(attachment, [tuple(part), tuple(choice)])[1][0, 1]) if choice else None


def spanning_tree(costs: np.ndarray, *, max_cost_mm: float) -> np.ndarray:
    """Find the minimum spanning tree of the segments.

    Parameters
    ----------
    costs : ndarray, shape (segments, segments)
        Cost of attaching the segment of the row to that of the column, mm; the smaller of both directions counts.
    max_cost_mm : float
        Largest cost of an edge, mm.

    Returns
    -------
    ndarray of bool, shape (segments, segments)
        Whether two segments share an edge; one tree for each component.
    """
    either = np.minimum(costs, costs.T)
    possible = (either <= max_cost_mm) & ~np.eye(len(costs), dtype=bool)
    return graphs.adjacency(graphs.spanning_tree(np.where(possible, either, np.inf)), len(costs))


def root_and_order(tree: np.ndarray, sizes: Sequence[int]) -> tuple[list[int], list[int | None]]:
    """Choose the root of each component and order its segments, parents first.

    The root is the segment of least hop eccentricity, of these the one with most markers, then the first. Components
    come by number of markers, the largest first.

    Parameters
    ----------
    tree : ndarray of bool, shape (segments, segments)
        Whether two segments share an edge.
    sizes : sequence of int
        Number of markers of each segment.

    Returns
    -------
    order : list of int
        The segments, parents before their children.
    parents : list of int or None
        The parent of each segment (by its old index), None for a root.
    """
    labels = graphs.components(tree)
    hops = graphs.shortest_paths(np.where(tree, 1.0, np.inf))
    eccentricity = np.where(np.isfinite(hops), hops, -1).max(axis=1)
    parts = [np.flatnonzero(labels == label).tolist() for label in range(labels.max() + 1)]
    order: list[int] = []
    parents: list[int | None] = [None] * len(sizes)
    for part in sorted(parts, key=lambda part: (-sum(sizes[s] for s in part), part[0])):
        root = min(part, key=lambda s: (eccentricity[s], -sizes[s], s))
        reached, before = graphs.breadth_first(tree, root)
        order += reached
        for s, above in before.items():
            parents[s] = above
    return order, parents


def infer_skeleton(dissimilarity: np.ndarray, attachment: np.ndarray, *, cut_mm: float, max_cost_mm: float) -> Skeleton:
    """Infer segments and their tree.

    Parameters
    ----------
    dissimilarity : ndarray, shape (markers, markers)
        Dissimilarity of each pair, mm; NaN = unknown.
    attachment : ndarray, shape (markers, markers)
        Cost of attaching the marker of the row to that of the column, mm; NaN = unknown.
    cut_mm : float
        Dissimilarity at which markers no longer share a segment, mm.
    max_cost_mm : float
        Largest cost of an edge within a component, mm.

    Returns
    -------
    Skeleton
        The segments, parents before their children.

    References
    ----------
    skurowski2021, section 2.2.
    """
    members = cluster_markers(dissimilarity, cut_mm=cut_mm)
    if not members:
        return Skeleton((), (), (), ())
    costs, markers = edge_costs(attachment, members)
    tree = spanning_tree(costs, max_cost_mm=max_cost_mm)
    order, parents = root_and_order(tree, [len(part) for part in members])
    place = {s: i for i, s in enumerate(order)}
    parent_markers: list[int | None] = []
    for s in order:
        above = parents[s]
        linked = np.flatnonzero(tree[s]).tolist() if above is None else [above]
        parent_markers.append(int(markers[s, min(linked, key=lambda b: (costs[s, b], b))]) if linked else None)
    return Skeleton(
        members=tuple(members[s] for s in order),
        parent=tuple(None if (above := parents[s]) is None else place[above] for s in order),
        parent_marker=tuple(parent_markers),
        names=(None,) * len(order),
    )
