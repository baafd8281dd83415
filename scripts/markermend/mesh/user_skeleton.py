"""The skeleton of a supplied mesh: its segments among the markers of the recordings, and the markers that it lacks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from markermend.mesh.segment_tree import Skeleton, cheapest_marker
from markermend.mesh.user_mesh import UserMesh


def fit_to_recordings(
    supplied: UserMesh, markers: Sequence[str], seen: Sequence[int], attachment: np.ndarray, *, max_cost_mm: float
) -> tuple[Skeleton, list[str]]:
    """Fit a supplied mesh to the markers of the recordings.

    Supplied markers that no recording holds are left out; segments that so become empty pass their children to their
    parent. Seen markers that the mesh does not name become segments of one marker.

    Parameters
    ----------
    supplied : UserMesh
        The mesh.
    markers : sequence of str
        Names of all markers in the recordings.
    seen : sequence of int
        Indices of those with enough data.
    attachment : ndarray, shape (markers, markers)
        Cost of attaching the marker of the row to that of the column, mm; NaN = unknown.
    max_cost_mm : float
        Largest cost at which an unnamed marker is attached to a named one, mm; otherwise it is a root.

    Returns
    -------
    skeleton : Skeleton
        The segments.
    remarks : list of str
        How the mesh and the recordings differ.
    """
    place = {marker: m for m, marker in enumerate(markers)}
    skeleton = _attached(_held_segments(supplied, place), attachment)
    named = {m for part in skeleton.members for m in part}
    unnamed = [m for m in seen if m not in named]
    remarks = []
    if unknown := [marker for marker in supplied.markers if marker not in place]:
        remarks.append(f"named in the mesh file, held by no recording: {', '.join(sorted(unknown))}")
    if unnamed:
        names = ", ".join(markers[m] for m in unnamed)
        remarks.append(f"not named in the mesh file, attached to the nearest marker: {names}")
    return attach_unnamed(skeleton, unnamed, attachment, max_cost_mm=max_cost_mm), remarks


def attach_unnamed(
    skeleton: Skeleton, unnamed: Sequence[int], attachment: np.ndarray, *, max_cost_mm: float
) -> Skeleton:
    """Add markers as segments of their own, each attached to the named marker of least cost.

    Parameters
    ----------
    skeleton : Skeleton
        The named segments.
    unnamed : sequence of int
        The markers to add.
    attachment : ndarray, shape (markers, markers)
        Cost of attaching the marker of the row to that of the column, mm; NaN = unknown.
    max_cost_mm : float
        A marker whose least cost exceeds this, mm, becomes a root.

    Returns
    -------
    Skeleton
        The segments, the added ones last.
    """
    owner = {m: s for s, part in enumerate(skeleton.members) for m in part}
    nearest = [cheapest_marker(attachment, (m,), tuple(owner)) for m in unnamed]
    hosts = [
        None if host is None or not attachment[m, host] <= max_cost_mm else host
        for m, host in zip(unnamed, nearest, strict=True)
    ]
    return Skeleton(
        members=(*skeleton.members, *((m,) for m in unnamed)),
        parent=(*skeleton.parent, *(None if host is None else owner[host] for host in hosts)),
        parent_marker=(*skeleton.parent_marker, *hosts),
        names=(*skeleton.names, *(None for _ in unnamed)),
    )


def _held_segments(supplied: UserMesh, place: Mapping[str, int]) -> Skeleton:
    """The segments of which a recording holds a marker; place: index of each marker by its name."""
    members = [tuple(sorted(place[marker] for marker in part if marker in place)) for part in supplied.members]
    held = [s for s, part in enumerate(members) if part]
    parents: list[int | None] = []
    for s in held:
        above = supplied.parents[s]
        while above is not None and not members[above]:
            above = supplied.parents[above]
        parents.append(None if above is None else held.index(above))
    return Skeleton(
        members=tuple(members[s] for s in held),
        parent=tuple(parents),
        parent_marker=tuple(place.get(supplied.parent_markers[s] or "") for s in held),
        names=tuple(supplied.names[s] for s in held),
    )


def _attached(skeleton: Skeleton, attachment: np.ndarray) -> Skeleton:
    """Choose a parent marker where the one named is not in the parent, or for a root not in a child."""
    chosen: list[int | None] = []
    for s, part in enumerate(skeleton.members):
        above = skeleton.parent[s]
        linked = [above] if above is not None else [b for b, parent in enumerate(skeleton.parent) if parent == s]
        choice = [m for b in linked for m in skeleton.members[b]]
        named = skeleton.parent_marker[s]
        chosen.append(named if named in choice else cheapest_marker(attachment, part, choice))
    return replace(skeleton, parent_marker=tuple(chosen))
