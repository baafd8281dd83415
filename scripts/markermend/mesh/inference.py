"""Infer functional body meshes from recordings, or complete one that a user supplies."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.core.mesh import Mesh
from markermend.core.recording import Recording
from markermend.mesh import segment_summary, segment_tree, user_mesh
from markermend.mesh.pair_statistics import PairStatistics, name, pair_statistics
from markermend.mesh.user_mesh import Supplied
from markermend.options.mesh import MeshOptions


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


def infer_meshes(recordings: Sequence[Recording], *, supplied: Sequence[Supplied], options: MeshOptions) -> list[Mesh]:
    """Infer one mesh for each group of recordings with like marker sets.

    A supplied mesh serves the recordings whose markers it overlaps by at least marker_overlap; where several do, the
    one that overlaps most, then the first. The order of the recordings does not matter.
    """
    served: dict[int, list[Recording]] = {}
    others = []
    for recording in recordings:
        overlaps = [overlap(own.markers, recording.markers) for own in supplied]
        best = int(np.argmax(overlaps)) if overlaps else 0
        if overlaps and overlaps[best] >= options.min_marker_overlap:
            served.setdefault(best, []).append(recording)
        else:
            others.append(recording)
    meshes = [infer_mesh(group, supplied=supplied[own], options=options) for own, group in sorted(served.items())]
    groups = group_recordings(others, marker_overlap=options.min_marker_overlap)
    meshes += [infer_mesh(group, options=options) for group in groups]
    return sorted(meshes, key=lambda mesh: mesh.recordings)


def infer_mesh(
    recordings: Sequence[Recording],
    *,
    options: MeshOptions,
    supplied: Supplied | None = None,
) -> Mesh:
    """Infer the functional body mesh of one subject and marker set from all its recordings.

    recordings: mm, NaN = missing; static ones (facts["kind"]) count only where there is nothing else. supplied: segments that win over inferred ones; only their statistics come from the data.

    Source: Skurowski & Pawlyta 2016, outlined in Skurowski & Pawlyta 2021, section 2.2.
    """
    every = sorted({marker for recording in recordings for marker in recording.markers})
    moving = [recording for recording in recordings if recording.facts.get("kind") != "static"]
    statistics = pair_statistics(
        moving or recordings, frames=options.max_frames, valid_frames=options.min_frames, markers=every
    )
    dissimilarity = statistics.dissimilarity(options.reference_distance_mm)
    hanging = statistics.hanging(dissimilarity)
    seen = np.flatnonzero(statistics.valid >= options.min_frames).tolist()
    remarks: list[str] = []
    if supplied is None:
        block = np.ix_(seen, seen)
        own = segment_tree.grow(
            dissimilarity[block], hanging[block], cut_mm=options.segment_cut_mm, component_cost=options.max_edge_cost_mm
        )
        skeleton = own.renumbered(seen)
    else:
        skeleton, remarks = user_mesh.adopt(supplied, every, seen, hanging, component_cost=options.max_edge_cost_mm)
    share, lacks = segment_summary.excitation(
        statistics,
        len(skeleton.members),
        len(seen),
        options.min_excitation_s,
        options.min_excitation_mm,
        options.max_markers_per_segment,
    )
    predictors, near = segment_summary.rank(skeleton, dissimilarity, options.min_predictors, options.max_neighbours)
    return Mesh(
        recordings=tuple(sorted(name(recording) for recording in recordings)),
        markers=tuple(every),
        segments=segment_summary.describe(skeleton, statistics, dissimilarity, hanging, options.segment_cut_mm, share),
        predictors=segment_summary.named(predictors, every),
        neighbours=segment_summary.named(near, every),
        warnings=(*unseen(statistics, options.min_frames), *remarks, *(lacks if supplied is None else ())),
        absent={name(recording): lacking for recording in recordings if (lacking := absent(recording, every))},
    )


def unseen(statistics: PairStatistics, valid_frames: int) -> list[str]:
    """Warn of the markers with too little data to tell what they move with."""
    names = [statistics.markers[m] for m in np.flatnonzero(statistics.valid < valid_frames)]
    return [f"seen on fewer than {valid_frames} frames: {', '.join(names)}"] if names else []


def absent(recording: Recording, markers: Sequence[str]) -> tuple[str, ...]:
    """The markers that a recording does not hold."""
    return tuple(marker for marker in markers if marker not in recording.markers)
