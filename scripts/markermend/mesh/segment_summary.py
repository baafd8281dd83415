"""What a mesh says of its segments and markers: residuals, confidence, predictors, neighbours, and what it lacks."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from markermend.core.mesh import Segment
from markermend.mesh.pair_statistics import DECIMALS, PairStatistics
from markermend.mesh.segment_tree import Skeleton


def excitation(
    statistics: PairStatistics,
    segments: int,
    markers: int,
    excitation_s: float,
    excitation_sigma_mm: float,
    segments_ratio: float,
) -> tuple[float, list[str]]:
    """Judge whether the subject moved enough: a share from 0 to 1 of what is wanted, and a warning for each lack."""
    known = np.triu(~np.isnan(statistics.deviation), k=1)
    sigma = float(np.median(statistics.deviation[known])) if known.any() else 0.0
    wanted = markers / segments_ratio
    advice = "record a range-of-motion trial or supply a mesh"
    lacks = []
    if statistics.seconds < excitation_s:
        lacks.append(f"only {statistics.seconds:.1f} s of motion ({excitation_s:g} s wanted): {advice}")
    if segments < wanted:
        lacks.append(f"only {segments} segments for {markers} markers ({math.ceil(wanted)} wanted): {advice}")
    if sigma < excitation_sigma_mm:
        lacks.append(f"distances vary by only {sigma:.0f} mm ({excitation_sigma_mm:g} mm wanted): {advice}")
    share = min(1.0, statistics.seconds / excitation_s, segments / max(wanted, 1.0), sigma / excitation_sigma_mm)
    return share, lacks


def describe(
    skeleton: Skeleton,
    statistics: PairStatistics,
    dissimilarity: np.ndarray,
    hanging: np.ndarray,
    cut_mm: float,
    share: float,
) -> tuple[Segment, ...]:
    """Give each segment its name, rigid residual, edge cost and confidence.

    residual: root mean square over pairs of siblings of the deviation of their distance / sqrt 2. confidence: 1 - mean
    dissimilarity within / to the nearest other segment (cut_mm stands for the inside of a single marker), times share.
    """
    segments = []
    for s, part in enumerate(skeleton.members):
        inside = dissimilarity[np.ix_(part, part)][np.triu_indices(len(part), k=1)]
        deviations = statistics.deviation[np.ix_(part, part)][np.triu_indices(len(part), k=1)]
        inner = mean(inside, cut_mm)
        outer = [mean(dissimilarity[np.ix_(part, o)], np.inf) for i, o in enumerate(skeleton.members) if i != s]
        nearest = min(outer, default=np.inf)
        clear = 1.0 - inner / nearest if nearest > inner else 0.0
        hook = skeleton.parent_marker[s]
        cost = np.nan if hook is None or skeleton.parent[s] is None else mean(hanging[list(part), hook], np.nan)
        names = [statistics.markers[m] for m in part]
        segments.append(
            Segment(
                name=skeleton.names[s] or "+".join(names[:3]) + (f"+{len(names) - 3}" if len(names) > 3 else ""),
                markers=tuple(names),
                residual_mm=round(float(np.sqrt(mean(np.square(deviations), 0.0) / 2)), DECIMALS),
                parent=skeleton.parent[s],
                parent_marker=None if hook is None else statistics.markers[hook],
                edge_cost=None if np.isnan(cost) else round(cost, DECIMALS),
                component=skeleton.component[s],
                confidence=round(float(clear * share), DECIMALS),
            )
        )
    return tuple(segments)


def mean(values: np.ndarray, otherwise: float) -> float:
    """Mean of the values that are known, `otherwise` if none is."""
    known = values[~np.isnan(values)]
    return float(known.mean()) if known.size else otherwise


def rank(
    skeleton: Skeleton, dissimilarity: np.ndarray, minimum_predictors: int, neighbours: int
) -> tuple[dict[int, list[int]], dict[int, list[int]]]:
    """List the predictors and the neighbours of each marker in a segment, by marker index.

    Predictors: siblings, then the segment's parent marker, then the nearest of the component up to minimum_predictors.
    Neighbours: the nearest of the component; pairs with unknown dissimilarity are no neighbours.
    """
    component = {m: c for part, c in zip(skeleton.members, skeleton.component, strict=True) for m in part}
    nearest = np.argsort(dissimilarity, axis=1, kind="stable")
    predictors, near = {}, {}
    for part, hook in zip(skeleton.members, skeleton.parent_marker, strict=True):
        for m in part:
            others = [int(o) for o in nearest[m] if o != m and component.get(int(o)) == component[m]]
            ranked = [o for o in others if not np.isnan(dissimilarity[m, o])]
            chosen = [o for o in others if o in part] + ([] if hook is None else [hook])
            spare = [o for o in ranked if o not in chosen]
            predictors[m] = chosen + spare[: max(minimum_predictors - len(chosen), 0)]
            near[m] = ranked[:neighbours]
    return predictors, near


def named(lists: dict[int, list[int]], markers: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """Replace indices by names; markers in no list get an empty one."""
    return {marker: tuple(markers[o] for o in lists.get(m, [])) for m, marker in enumerate(markers)}
