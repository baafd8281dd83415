"""A mesh that the user supplies: its file, what is wrong with it, and how it meets the markers of the recordings."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from markermend.core.recording import BadRecording
from markermend.mesh.segment_tree import Skeleton, edge_costs


@dataclass(frozen=True)
class Supplied:
    """Segments as a user wrote them: unique names and markers, parents by index (None for a root), no cycles.

    parent_markers: the marker that each segment hangs on, one of its parent; for a root one of any other, or None.
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
        if problem := flaw(part):
            raise bad(f"segment {part.get('name', s)!r}: {problem}")
    names = [part["name"] for part in segments]
    everywhere = [marker for part in segments for marker in part["markers"]]
    for what, values in (("segment", names), ("marker", everywhere)):
        if twice := sorted({value for value in values if values.count(value) > 1}):
            raise bad(f"{what} {twice[0]!r} stands there twice: name it once")
    parents: list[int | None] = []
    for part in segments:
        parent = names.index(part["parent"]) if part["parent"] in names else part["parent"]
        if parent is not None and parent not in range(len(names)):
            raise bad(
                f"segment {part['name']!r}: parent {parent!r} is no segment: give an index from 0, a name, or null"
            )
        hook = part["parent_marker"]
        if hook not in ([*everywhere, None] if parent is None else segments[parent]["markers"]):
            raise bad(f"segment {part['name']!r}: parent_marker {hook!r} is no marker of its parent segment")
        parents.append(parent)
    if (lost := circular(parents)) is not None:
        raise bad(f"segment {names[lost]!r}: its parents run in a circle: one segment of each body needs parent null")
    members = tuple(tuple(part["markers"]) for part in segments)
    return Supplied(tuple(names), members, tuple(parents), tuple(part["parent_marker"] for part in segments))


def flaw(part: dict[str, Any]) -> str | None:
    """What is wrong with one segment by itself, None if nothing is."""
    for key in ("name", "markers", "parent", "parent_marker"):
        if key not in part:
            return f"lacks the key {key!r}"
    markers, parent = part["markers"], part["parent"]
    if not isinstance(part["name"], str) or not part["name"]:
        return "'name' must be a text"
    if not isinstance(markers, list) or not markers or not all(isinstance(marker, str) for marker in markers):
        return "'markers' must be a list of one or more names"
    if isinstance(parent, bool) or not isinstance(parent, int | str | None):
        return f"'parent' must be the index or name of a segment, or null, not {parent!r}"
    return None


def circular(parents: Sequence[int | None]) -> int | None:
    """The first segment whose chain of parents never ends, None if all end at a root."""
    for s in range(len(parents)):
        above, steps = parents[s], 0
        while above is not None and steps <= len(parents):
            above, steps = parents[above], steps + 1
        if above is not None:
            return s
    return None


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
    skeleton = Skeleton(tuple(members), tuple(parents), tuple(hooks), tuple(names))
    if loose := [m for m in seen if not any(m in part for part in members)]:
        remarks.append(f"not named in the mesh file, hung on the nearest: {', '.join(markers[m] for m in loose)}")
    return hang_loose(skeleton, loose, hanging, component_cost), remarks


def hang_loose(skeleton: Skeleton, loose: Sequence[int], hanging: np.ndarray, component_cost: float) -> Skeleton:
    """Add each loose marker as a segment of its own, on the marker of least cost unless that exceeds component_cost."""
    owner = {m: i for i, part in enumerate(skeleton.members) for m in part}
    hooks = [least(hanging, (m,), tuple(owner)) for m in loose]
    hooks = [None if h is None or not hanging[m, h] <= component_cost else h for m, h in zip(loose, hooks, strict=True)]
    return Skeleton(
        members=(*skeleton.members, *((m,) for m in loose)),
        parent=(*skeleton.parent, *(None if hook is None else owner[hook] for hook in hooks)),
        parent_marker=(*skeleton.parent_marker, *hooks),
        names=(*skeleton.names, *(None for _ in loose)),
    )


def least(hanging: np.ndarray, part: Sequence[int], choice: Sequence[int]) -> int | None:
    """The marker of `choice` on which hanging `part` costs least: the first where no cost is known, None of none."""
    return int(edge_costs(hanging, [tuple(part), tuple(choice)])[1][0, 1]) if choice else None
