"""Infer functional body meshes from recordings, or complete one that a user supplies."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.core.mesh import Mesh
from markermend.core.recording import Recording
from markermend.mesh.continuity import without_displaced_samples
from markermend.mesh.pair_statistics import PairStatistics, pair_statistics, recording_name, thin
from markermend.mesh.segment_summary import Excitation, SegmentSummary, assess_excitation, named, rank_markers
from markermend.mesh.segment_tree import Skeleton, infer_skeleton
from markermend.mesh.user_mesh import UserMesh
from markermend.mesh.user_skeleton import fit_to_recordings
from markermend.mesh.usual_distances import usual_distances
from markermend.options.mesh import MeshOptions


def overlap(a: Sequence[str], b: Sequence[str]) -> float:
    """Compute the Jaccard overlap of two marker sets.

    Parameters
    ----------
    a, b : sequence of str
        Names of markers.

    Returns
    -------
    float
        Share of the markers of both that are in both, 0 to 1.
    """
    return len(set(a) & set(b)) / max(len(set(a) | set(b)), 1)


def group_recordings(recordings: Sequence[Recording], *, marker_overlap: float) -> list[list[Recording]]:
    """Group recordings by their marker sets.

    Parameters
    ----------
    recordings : sequence of Recording
        The recordings.
    marker_overlap : float
        Recordings whose marker sets overlap by at least this (0 to 1), directly or through others, form a group.

    Returns
    -------
    list of list of Recording
        The groups, each sorted by name.
    """
    groups: list[list[Recording]] = []
    for recording in sorted(recordings, key=recording_name):
        near = [g for g in groups if any(overlap(recording.markers, other.markers) >= marker_overlap for other in g)]
        groups = [g for g in groups if not any(g is other for other in near)]
        groups.append([*(other for g in near for other in g), recording])
    return [sorted(group, key=recording_name) for group in groups]


def prepare(recording: Recording, *, options: MeshOptions) -> Recording:
    """Give what a mesh is inferred from: a recording without displaced samples, thinned, so that many fit into memory.

    Parameters
    ----------
    recording : Recording
        The recording at its full rate; it is not modified.
    options : MeshOptions
        Number of frames, and what a displaced sample is.

    Returns
    -------
    Recording
        At most `max_frames` frames, NaN where a marker is missing or displaced.
    """
    continuous = without_displaced_samples(recording, min_jump_mm=options.min_jump_mm, jump_factor=options.jump_factor)
    return thin(continuous, frames=options.max_frames)


def infer_meshes(recordings: Sequence[Recording], *, supplied: Sequence[UserMesh], options: MeshOptions) -> list[Mesh]:
    """Infer one mesh for each group of recordings with similar marker sets.

    Parameters
    ----------
    recordings : sequence of Recording
        All recordings of a subject as `prepare` gives them; their order does not matter.
    supplied : sequence of UserMesh
        Meshes of the user. One serves the recordings whose markers it overlaps by at least `min_marker_overlap`; where
        several do, the one that overlaps most, then the first.
    options : MeshOptions
        How meshes are inferred.

    Returns
    -------
    list of Mesh
        The meshes, by the names of their recordings.
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


def infer_mesh(recordings: Sequence[Recording], *, options: MeshOptions, supplied: UserMesh | None = None) -> Mesh:
    """Infer the functional body mesh of one subject and marker set from all its recordings.

    Parameters
    ----------
    recordings : sequence of Recording
        The recordings, in mm; static ones (by the fact `kind`) count only where there are no others.
    options : MeshOptions
        How the mesh is inferred.
    supplied : UserMesh, optional
        Segments that replace the inferred ones; only their statistics come from the recordings.

    Returns
    -------
    Mesh
        Segments, predictors and neighbours of every marker, and what the motion lacks.

    References
    ----------
    skurowski2021, section 2.2.
    """
    markers = sorted({marker for recording in recordings for marker in recording.markers})
    moving = [recording for recording in recordings if recording.facts.get("kind") != "static"]
    statistics = pair_statistics(
        moving or recordings, frames=options.max_frames, valid_frames=options.min_frames, markers=markers
    )
    dissimilarity = statistics.dissimilarity(options.reference_distance_mm)
    attachment = statistics.attachment_costs(dissimilarity)
    skeleton, remarks = _skeleton(statistics, dissimilarity, attachment, options, supplied)
    excitation = _excitation(statistics, skeleton, options)
    summary = SegmentSummary(skeleton, statistics, dissimilarity, attachment, options.segment_cut_mm, excitation.share)
    predictors, neighbours = rank_markers(
        skeleton, dissimilarity, min_predictors=options.min_predictors, max_neighbours=options.max_neighbours
    )
    little = supplied is None and excitation.share < options.min_excitation_share
    return Mesh(
        recordings=tuple(sorted(recording_name(recording) for recording in recordings)),
        markers=tuple(markers),
        segments=summary.segments(),
        predictors=named(predictors, markers),
        neighbours=named(neighbours, markers),
        warnings=tuple(remarks),
        lacks=excitation.lacks if little else (),
        absent={recording_name(own): lacking for own in recordings if (lacking := _absent(own, markers))},
        distances=usual_distances(
            recordings,
            markers=markers,
            frames=options.max_frames,
            min_frames=options.min_distance_frames,
            static_weight=options.static_weight,
            min_spread_mm=options.min_spread_mm,
        ),
    )


def _skeleton(
    statistics: PairStatistics,
    dissimilarity: np.ndarray,
    attachment: np.ndarray,
    options: MeshOptions,
    supplied: UserMesh | None,
) -> tuple[Skeleton, list[str]]:
    """The segments, inferred or supplied, of the markers with enough data; and how a supplied mesh differs."""
    seen = np.flatnonzero(statistics.valid >= options.min_frames).tolist()
    limit = options.max_edge_cost_mm
    if supplied is not None:
        return fit_to_recordings(supplied, statistics.markers, seen, attachment, max_cost_mm=limit)
    block = np.ix_(seen, seen)
    own = infer_skeleton(dissimilarity[block], attachment[block], cut_mm=options.segment_cut_mm, max_cost_mm=limit)
    return own.renumbered(seen), []


def _excitation(statistics: PairStatistics, skeleton: Skeleton, options: MeshOptions) -> Excitation:
    """How much the subject moved, by what the options want."""
    return assess_excitation(
        statistics,
        segments=len(skeleton.members),
        markers=int(np.count_nonzero(statistics.valid >= options.min_frames)),
        options=options,
    )


def _absent(recording: Recording, markers: Sequence[str]) -> tuple[str, ...]:
    """The markers that a recording does not hold."""
    return tuple(marker for marker in markers if marker not in recording.markers)
