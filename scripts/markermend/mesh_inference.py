"""Infer functional body meshes from recordings (after Skurowski & Pawlyta 2016), or complete one that a user supplies."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from markermend import mesh_supplied, mesh_tree
from markermend.mesh import Mesh, Segment
from markermend.mesh_statistics import DECIMALS, PairStatistics, name, pair_statistics
from markermend.mesh_supplied import Supplied
from markermend.mesh_tree import Skeleton
from markermend.recording import Recording


def overlap(a: Sequence[str], b: Sequence[str]) -> float:
    """Jaccard overlap of two marker sets, 0 to 1."""
    return len(set(a) & set(b)) / max(len(set(a) | set(b)), 1)


def group_recordings(recordings: Sequence[Recording], *, marker_overlap: float) -> list[list[Recording]]:
    """Group recordings whose marker sets overlap by at least marker_overlap, directly or through others."""
    groups: list[list[Recording]] = []
    for recording in sorted(recordings, key=name):
        near = [g for g in groups if any(overlap(recording.markers, other.markers) >= marker_overlap for other in g)]
        groups = [g for g in groups if not any(g is other for other in near)]
        groups.append([*(other for g in near for other in g), recording])
    return [sorted(group, key=name) for group in groups]


def infer_meshes(
    recordings: Sequence[Recording], *, supplied: Sequence[Supplied], marker_overlap: float, **options: Any
) -> list[Mesh]:
    """Infer one mesh for each group of recordings with like marker sets.

    A supplied mesh serves the recordings whose markers it overlaps by at least marker_overlap; where several do, the
    one that overlaps most, then the first. options: as infer_mesh. The order of the recordings does not matter.
    """
    served: dict[int, list[Recording]] = {}
    others = []
    for recording in recordings:
        overlaps = [overlap(own.markers, recording.markers) for own in supplied]
        best = int(np.argmax(overlaps)) if overlaps else 0
        if overlaps and overlaps[best] >= marker_overlap:
            served.setdefault(best, []).append(recording)
        else:
            others.append(recording)
    meshes = [infer_mesh(group, supplied=supplied[own], **options) for own, group in sorted(served.items())]
    meshes += [infer_mesh(group, **options) for group in group_recordings(others, marker_overlap=marker_overlap)]
    return sorted(meshes, key=lambda mesh: mesh.recordings)


def infer_mesh(
    recordings: Sequence[Recording],
    *,
    frames: int,
    valid_frames: int,
    scale_mm: float,
    cut_mm: float,
    component_cost: float,
    minimum_predictors: int,
    neighbours: int,
    excitation_s: float,
    excitation_sigma_mm: float,
    segments_ratio: float,
    supplied: Supplied | None = None,
) -> Mesh:
    """Infer the functional body mesh of one subject and marker set from all its recordings.

    recordings: mm, NaN = missing; static ones (facts["kind"]) count only where there is nothing else. frames: most
    frames taken of each. valid_frames: least joint frames of a pair, and least frames of a marker in a segment.
    scale_mm, cut_mm: scale and cut of the dissimilarity. component_cost: largest edge within a body, mm.
    minimum_predictors: least number of predictors of a marker, neighbours: longest list of neighbours. excitation_s,
    excitation_sigma_mm, segments_ratio: warn below this duration (s), this median deviation (mm) and one segment per
    so many markers. supplied: segments that win over inferred ones; only their statistics come from the data.

    Source: Skurowski & Pawlyta 2016, as restated by Skurowski & Pawlyta 2021, section 2.
    """
    names = tuple(sorted(name(recording) for recording in recordings))
    every = sorted({marker for recording in recordings for marker in recording.markers})
    moving = [recording for recording in recordings if recording.facts.get("kind") != "static"]
    statistics = pair_statistics(moving or recordings, frames=frames, valid_frames=valid_frames, markers=every)
    dissimilarity = statistics.dissimilarity(scale_mm)
    hanging = statistics.hanging(dissimilarity)
    seen = np.flatnonzero(statistics.valid >= valid_frames)
    if supplied is None:
        block = np.ix_(seen, seen)
        own = mesh_tree.grow(dissimilarity[block], hanging[block], cut_mm=cut_mm, component_cost=component_cost)
        skeleton, remarks = own.renumbered(seen.tolist()), []
    else:
        skeleton, remarks = mesh_supplied.adopt(
            supplied, statistics.markers, seen.tolist(), hanging, component_cost=component_cost
        )
    unseen = [statistics.markers[m] for m in np.flatnonzero(statistics.valid < valid_frames)]
    if unseen:
        remarks.append(
            f"seen on fewer than {valid_frames} frames, so without a mesh of their own data: {', '.join(unseen)}"
        )
    shortfall, lacks = excitation(
        statistics, len(skeleton.members), len(seen), excitation_s, excitation_sigma_mm, segments_ratio
    )
    segments = describe(skeleton, statistics, dissimilarity, hanging, cut_mm, shortfall)
    predictors, near = rank(skeleton, dissimilarity, minimum_predictors, neighbours)
    return Mesh(
        recordings=names,
        markers=statistics.markers,
        segments=segments,
        predictors=named(predictors, statistics.markers),
        neighbours=named(near, statistics.markers),
        warnings=(*remarks, *([] if supplied else lacks)),
        absent={
            name(recording): lacking
            for recording in sorted(recordings, key=name)
            if (lacking := tuple(marker for marker in every if marker not in recording.markers))
        },
    )


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
        lacks.append(f"only {segments} segments for {markers} markers ({wanted:.0f} wanted): {advice}")
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
