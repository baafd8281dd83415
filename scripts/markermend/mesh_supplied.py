"""A mesh that the user supplies: its file, what is wrong with it, and how it meets the markers of the recordings."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from markermend.mesh_tree import Skeleton
from markermend.recording import BadRecording


@dataclass(frozen=True)
class Supplied:
    """Segments as a user wrote them: unique names and markers, parents by index (None for a root), no cycles.

    parent_markers: the marker that each segment hangs on, a marker of its parent; for a root of any other segment, or None.
    """

    names: tuple[str, ...]
    members: tuple[tuple[str, ...], ...]
    parents: tuple[int | None, ...]
    parent_markers: tuple[str | None, ...]

    @property
    def markers(self) -> tuple[str, ...]:
        """All markers named."""
        return tuple(marker for part in self.members for marker in part)


def read(path: Path) -> list[Supplied]:
    """Read the meshes of a user's file: one entry, or a whole mesh.json; raises BadRecording where it is malformed."""
    try:
        value = json.loads(path.read_text(encoding="utf-8-sig"))
    except (ValueError, OSError) as error:
        raise BadRecording(f"mesh file {path.name}: {error}: give a JSON file") from error
    entries = value.get("meshes", [value]) if isinstance(value, dict) else None
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise BadRecording(f"mesh file {path.name}: holds no JSON object with the key 'segments'")
    return [parse(entry, path.name) for entry in entries]


def parse(entry: dict[str, Any], where: str) -> Supplied:
    """Check one mesh: segments with name, markers, parent (index or name, null for a root) and parent_marker."""

    def bad(problem: str) -> BadRecording:
        return BadRecording(f"mesh file {where}: {problem}")

    segments = entry.get("segments")
    if not isinstance(segments, list) or not segments or not all(isinstance(part, dict) for part in segments):
        raise bad("'segments' must be a list of one or more objects")
    for s, part in enumerate(segments):
        for key in ("name", "markers", "parent", "parent_marker"):
            if key not in part:
                raise bad(f"segment {part.get('name', s)!r} lacks the key {key!r}")
        if not isinstance(part["name"], str) or not part["name"]:
            raise bad(f"segment {s} needs a name, not {part['name']!r}")
        markers = part["markers"]
        if not isinstance(markers, list) or not markers or not all(isinstance(marker, str) for marker in markers):
            raise bad(f"'markers' of segment {part['name']!r} must be a list of one or more names")
    names = [part["name"] for part in segments]
    everywhere = [marker for part in segments for marker in part["markers"]]
    for what, values in (("segment", names), ("marker", everywhere)):
        if twice := sorted({value for value in values if values.count(value) > 1}):
            raise bad(f"{what} {twice[0]!r} stands there twice: each belongs to one place")
    parents = [parent_index(part, names, bad) for part in segments]
    for s, part in enumerate(segments):
        hook, above = part["parent_marker"], parents[s]
        allowed = everywhere if above is None else segments[above]["markers"]
        if hook not in allowed and not (above is None and hook is None):
            raise bad(f"parent_marker {hook!r} of segment {part['name']!r} is no marker of its parent segment")
        above, steps = parents[s], 0
        while above is not None:
            above, steps = parents[above], steps + 1
            if steps > len(segments):
                raise bad(f"the parents of segment {part['name']!r} run in a circle: one segment needs parent null")
    members = tuple(tuple(part["markers"]) for part in segments)
    hooks = tuple(None if part["parent_marker"] in part["markers"] else part["parent_marker"] for part in segments)
    return Supplied(tuple(names), members, tuple(parents), hooks)


def parent_index(part: dict[str, Any], names: list[str], bad: Any) -> int | None:
    """Index of a segment's parent, which may be given by index or name."""
    parent = part["parent"]
    if parent is None:
        return None
    if isinstance(parent, str) and parent in names:
        return names.index(parent)
    if isinstance(parent, int) and not isinstance(parent, bool) and 0 <= parent < len(names):
        return parent
    raise bad(f"parent {parent!r} of segment {part['name']!r} is no segment: give an index from 0, a name, or null")


def adopt(
    supplied: Supplied, markers: Sequence[str], seen: Sequence[int], hanging: np.ndarray, *, component_cost: float
) -> tuple[Skeleton, list[str]]:
    """Fit a supplied mesh to the markers of the recordings.

    markers: names in the recordings; seen: indices of those with enough data; hanging: (markers, markers), mm, cost of
    hanging one on another, NaN = unknown. Supplied markers that no recording holds are left out; segments that so
    become empty pass their children to their parent. Seen markers that the mesh does not name become segments of one
    marker, hung on the named marker of least cost if that is at most component_cost. Returns what was done as remarks.
    """
    place = {marker: m for m, marker in enumerate(markers)}
    remarks = []
    if strange := [marker for marker in supplied.markers if marker not in place]:
        remarks.append(f"named in the mesh file, held by no recording: {', '.join(sorted(strange))}")
    members = [tuple(sorted(place[marker] for marker in part if marker in place)) for part in supplied.members]
    kept = [s for s, part in enumerate(members) if part]
    parents: list[int | None] = []
    for s in kept:
        above = supplied.parents[s]
        while above is not None and not members[above]:
            above = supplied.parents[above]
        parents.append(None if above is None else kept.index(above))
    members = [members[s] for s in kept]
    names: list[str | None] = [supplied.names[s] for s in kept]
    hooks: list[int | None] = [place.get(supplied.parent_markers[s] or "") for s in kept]
    for i, part in enumerate(members):
        above = parents[i]
        linked = [above] if above is not None else [b for b, parent in enumerate(parents) if parent == i]
        choice = [m for b in linked for m in members[b]]
        if hooks[i] not in choice:
            hooks[i] = least(hanging, part, choice)
    owner = {m: i for i, part in enumerate(members) for m in part}
    if loose := [m for m in seen if m not in owner]:
        remarks.append(f"not named in the mesh file, hung on the nearest: {', '.join(markers[m] for m in loose)}")
    for m in loose:
        hook = least(hanging, (m,), list(owner))
        near = hook is not None and hanging[m, hook] <= component_cost
        members.append((m,))
        names.append(None)
        parents.append(owner[hook] if near and hook is not None else None)
        hooks.append(hook if near else None)
    return Skeleton(tuple(members), tuple(parents), tuple(hooks), tuple(names)), remarks


def least(hanging: np.ndarray, part: Sequence[int], choice: Sequence[int]) -> int | None:
    """The marker of `choice` on which hanging `part` costs least: the first where no cost is known, None of none."""
    if not choice:
        return None
    costs = hanging[np.ix_(list(part), list(choice))]
    known = ~np.isnan(costs)
    mean = np.where(known.any(axis=0), np.nan_to_num(costs).sum(axis=0) / np.maximum(known.sum(axis=0), 1), np.inf)
    return int(choice[int(np.argmin(mean))])
