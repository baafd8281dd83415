"""Infer functional body meshes from recordings, or complete one that a user supplies."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from markermend.core.mesh import Mesh
from markermend.core.recording import Recording
from markermend.mesh import segment_summary, segment_tree, user_mesh
from markermend.mesh.pair_statistics import PairStatistics, name, pair_statistics
from markermend.mesh.user_mesh import Supplied


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

    Source: Skurowski & Pawlyta 2016, outlined in Skurowski & Pawlyta 2021, section 2.2.
    """
    every = sorted({marker for recording in recordings for marker in recording.markers})
    moving = [recording for recording in recordings if recording.facts.get("kind") != "static"]
    statistics = pair_statistics(moving or recordings, frames=frames, valid_frames=valid_frames, markers=every)
    dissimilarity = statistics.dissimilarity(scale_mm)
    hanging = statistics.hanging(dissimilarity)
    seen = np.flatnonzero(statistics.valid >= valid_frames).tolist()
    remarks: list[str] = []
    if supplied is None:
        block = np.ix_(seen, seen)
        own = segment_tree.grow(dissimilarity[block], hanging[block], cut_mm=cut_mm, component_cost=component_cost)
        skeleton = own.renumbered(seen)
    else:
        skeleton, remarks = user_mesh.adopt(supplied, every, seen, hanging, component_cost=component_cost)
    share, lacks = segment_summary.excitation(
        statistics, len(skeleton.members), len(seen), excitation_s, excitation_sigma_mm, segments_ratio
    )
    predictors, near = segment_summary.rank(skeleton, dissimilarity, minimum_predictors, neighbours)
    return Mesh(
        recordings=tuple(sorted(name(recording) for recording in recordings)),
        markers=tuple(every),
        segments=segment_summary.describe(skeleton, statistics, dissimilarity, hanging, cut_mm, share),
        predictors=segment_summary.named(predictors, every),
        neighbours=segment_summary.named(near, every),
        warnings=(*unseen(statistics, valid_frames), *remarks, *(lacks if supplied is None else ())),
        absent={name(recording): lacking for recording in recordings if (lacking := absent(recording, every))},
    )


def unseen(statistics: PairStatistics, valid_frames: int) -> list[str]:
    """Warn of the markers with too little data to tell what they move with."""
    names = [statistics.markers[m] for m in np.flatnonzero(statistics.valid < valid_frames)]
    return [f"seen on fewer than {valid_frames} frames: {', '.join(names)}"] if names else []


def absent(recording: Recording, markers: Sequence[str]) -> tuple[str, ...]:
    """The markers that a recording does not hold."""
    return tuple(marker for marker in markers if marker not in recording.markers)
