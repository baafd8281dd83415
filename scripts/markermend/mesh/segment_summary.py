"""What a mesh states about its segments and markers: residuals, confidence, predictors, neighbours, and what it lacks."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.core.mesh import Segment
from markermend.mesh.pair_statistics import DECIMALS, PairStatistics
from markermend.mesh.segment_tree import Skeleton
from markermend.options.mesh import MeshOptions


@dataclass(frozen=True)
class Excitation:
    """How much the subject moved.

    Attributes
    ----------
    share : float
        The least of the quantities below as a share of what is wanted, 0 to 1.
    lacks : tuple of str
        What there is too little of.
    """

    share: float
    lacks: tuple[str, ...]


def assess_excitation(statistics: PairStatistics, *, segments: int, markers: int, options: MeshOptions) -> Excitation:
    """Assess whether the subject moved enough for a mesh to be inferred.

    Parameters
    ----------
    statistics : PairStatistics
        The statistics of the pairs.
    segments, markers : int
        Number of segments, and of markers with enough data.
    options : MeshOptions
        What is wanted.

    Returns
    -------
    Excitation
        The share of what is wanted, and what there is too little of.
    """
    known = np.triu(~np.isnan(statistics.deviation), k=1)
    deviation = float(np.median(statistics.deviation[known])) if known.any() else 0.0
    min_seconds, min_deviation = options.min_excitation_s, options.min_excitation_mm
    wanted = markers / options.max_markers_per_segment
    lacks = []
    if statistics.seconds < min_seconds:
        lacks.append(f"only {statistics.seconds:.1f} s of motion ({min_seconds:g} s wanted)")
    if segments < wanted:
        lacks.append(f"only {segments} segments for {markers} markers ({math.ceil(wanted)} wanted)")
    if deviation < min_deviation:
        lacks.append(f"distances vary by only {deviation:.0f} mm ({min_deviation:g} mm wanted)")
    share = min(1.0, statistics.seconds / min_seconds, segments / max(wanted, 1.0), deviation / min_deviation)
    return Excitation(share, tuple(lacks))


@dataclass(frozen=True)
class SegmentSummary:
    """Describes the segments of a skeleton.

    Attributes
    ----------
    skeleton : Skeleton
        The segments.
    statistics : PairStatistics
        The statistics of the pairs.
    dissimilarity, attachment : ndarray, shape (markers, markers)
        Dissimilarity of each pair, and cost of attaching one marker to another, mm; NaN = unknown.
    cut_mm : float
        Stands for the dissimilarity within a segment of one marker, mm.
    excitation : float
        Share of the wanted motion, 0 to 1, by which every confidence is multiplied.
    """

    skeleton: Skeleton
    statistics: PairStatistics
    dissimilarity: np.ndarray
    attachment: np.ndarray
    cut_mm: float
    excitation: float

    def segments(self) -> tuple[Segment, ...]:
        """Describe every segment.

        Returns
        -------
        tuple of Segment
            Name, rigid residual, edge cost and confidence of each.
        """
        return tuple(self._segment(s) for s in range(len(self.skeleton.members)))

    def _segment(self, s: int) -> Segment:
        """One segment; its residual is the root mean square over pairs of their deviation / sqrt 2."""
        skeleton, part = self.skeleton, self.skeleton.members[s]
        pairs = np.triu_indices(len(part), k=1)
        deviations = self.statistics.deviation[np.ix_(part, part)][pairs]
        marker, cost = skeleton.parent_marker[s], self._edge_cost(s)
        names = [self.statistics.markers[m] for m in part]
        return Segment(
            name=skeleton.names[s] or "+".join(names[:3]) + (f"+{len(names) - 3}" if len(names) > 3 else ""),
            markers=tuple(names),
            residual_mm=round(float(np.sqrt(_known_mean(np.square(deviations), 0.0) / 2)), DECIMALS),
            parent=skeleton.parent[s],
            parent_marker=None if marker is None else self.statistics.markers[marker],
            edge_cost=None if np.isnan(cost) else round(cost, DECIMALS),
            component=skeleton.component[s],
            confidence=round(float(self._separation(s) * self.excitation), DECIMALS),
        )

    def _edge_cost(self, s: int) -> float:
        """Mean cost of attaching a segment to its parent marker; NaN for roots and where none is known."""
        marker = self.skeleton.parent_marker[s]
        if marker is None or self.skeleton.parent[s] is None:
            return math.nan
        return _known_mean(self.attachment[list(self.skeleton.members[s]), marker], math.nan)

    def _separation(self, s: int) -> float:
        """1 - mean dissimilarity within a segment / that to the nearest other segment, at least 0."""
        members = self.skeleton.members
        part = members[s]
        inner = _known_mean(self.dissimilarity[np.ix_(part, part)][np.triu_indices(len(part), k=1)], self.cut_mm)
        outer = [
            _known_mean(self.dissimilarity[np.ix_(part, other)], np.inf) for i, other in enumerate(members) if i != s
        ]
        nearest = min(outer, default=np.inf)
        return 1.0 - inner / nearest if nearest > inner else 0.0


def rank_markers(
    skeleton: Skeleton, dissimilarity: np.ndarray, *, min_predictors: int, max_neighbours: int
) -> tuple[dict[int, list[int]], dict[int, list[int]]]:
    """List the predictors and the neighbours of each marker in a segment.

    Parameters
    ----------
    skeleton : Skeleton
        The segments.
    dissimilarity : ndarray, shape (markers, markers)
        Dissimilarity of each pair, mm; NaN = unknown.
    min_predictors : int
        Smallest number of predictors of a marker, as far as its component has them.
    max_neighbours : int
        Largest number of neighbours of a marker.

    Returns
    -------
    predictors : dict of int to list of int
        For each marker its segment mates, then the segment's parent marker, then the nearest of the component.
    neighbours : dict of int to list of int
        For each marker the others of its component with known dissimilarity, the nearest first.
    """
    component = {m: c for part, c in zip(skeleton.members, skeleton.component, strict=True) for m in part}
    nearest = np.argsort(dissimilarity, axis=1, kind="stable")
    predictors, neighbours = {}, {}
    for part, marker in zip(skeleton.members, skeleton.parent_marker, strict=True):
        for m in part:
            others = [int(o) for o in nearest[m] if o != m and component.get(int(o)) == component[m]]
            ranked = [o for o in others if not np.isnan(dissimilarity[m, o])]
            chosen = [o for o in others if o in part] + ([] if marker is None else [marker])
            spare = [o for o in ranked if o not in chosen]
            predictors[m] = chosen + spare[: max(min_predictors - len(chosen), 0)]
            neighbours[m] = ranked[:max_neighbours]
    return predictors, neighbours


def named(lists: Mapping[int, Sequence[int]], markers: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """Replace indices by names.

    Parameters
    ----------
    lists : mapping of int to sequence of int
        A list for some of the markers.
    markers : sequence of str
        Names of all markers.

    Returns
    -------
    dict of str to tuple of str
        A list for every marker; markers that had none get an empty one.
    """
    return {marker: tuple(markers[o] for o in lists.get(m, [])) for m, marker in enumerate(markers)}


def _known_mean(values: np.ndarray, otherwise: float) -> float:
    """Mean of the values that are known, `otherwise` if none is."""
    known = values[~np.isnan(values)]
    return float(known.mean()) if known.size else otherwise
