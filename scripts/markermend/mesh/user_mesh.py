"""A mesh that the user supplies: what it holds, and what is wrong with it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from markermend.core.recording import BadRecording


@dataclass(frozen=True)
class UserMesh:
    """Segments as a user wrote them: unique names and markers, and no segment above itself.

    Attributes
    ----------
    names : tuple of str
        Name of each segment.
    members : tuple of tuple of str
        Names of the markers of each segment.
    parents : tuple of int or None
        Index of the parent of each segment, None for a root.
    parent_markers : tuple of str or None
        The marker to which each segment is attached, one of its parent; for a root any other or None.
    """

    names: tuple[str, ...]
    members: tuple[tuple[str, ...], ...]
    parents: tuple[int | None, ...]
    parent_markers: tuple[str | None, ...]

    @property
    def markers(self) -> tuple[str, ...]:
        """All markers named."""
        return tuple(marker for part in self.members for marker in part)


def parse_file(content: Any, file: str) -> list[UserMesh]:
    """Check the meshes of a user's file.

    Parameters
    ----------
    content : Any
        JSON value of the file: one mesh, or a whole mesh.json.
    file : str
        Name of the file, for messages.

    Returns
    -------
    list of UserMesh
        The meshes.

    Raises
    ------
    BadRecording
        Where the content is malformed, with the place.
    """
    entries = content.get("meshes", [content]) if isinstance(content, dict) else None
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise BadRecording(f"mesh file {file}: holds no JSON object with the key 'segments'")
    return [parse(entry, file) for entry in entries]


def parse(entry: Mapping[str, Any], file: str) -> UserMesh:
    """Check one mesh.

    Parameters
    ----------
    entry : mapping of str
        Its key `segments` lists objects with the keys name, markers, parent (index or name, null for a root) and
        parent_marker.
    file : str
        Name of the file, for messages.

    Returns
    -------
    UserMesh
        The mesh.

    Raises
    ------
    BadRecording
        Where the entry is malformed, with the place.
    """
    segments = entry.get("segments")
    if not isinstance(segments, list) or not segments or not all(isinstance(part, dict) for part in segments):
        raise BadRecording(f"mesh file {file}: 'segments' must be a list of one or more objects")
    problem = _segment_problem(segments) or _repeated_name(segments)
    if problem is not None:
        raise BadRecording(f"mesh file {file}: {problem}")
    names = [part["name"] for part in segments]
    parents = [names.index(part["parent"]) if part["parent"] in names else part["parent"] for part in segments]
    problem = _parent_problem(segments, parents)
    if problem is not None:
        raise BadRecording(f"mesh file {file}: {problem}")
    members = tuple(tuple(part["markers"]) for part in segments)
    return UserMesh(tuple(names), members, tuple(parents), tuple(part["parent_marker"] for part in segments))


def _segment_problem(segments: Sequence[Mapping[str, Any]]) -> str | None:
    """What is wrong with the first segment that is malformed by itself, None if none is."""
    for s, part in enumerate(segments):
        if problem := _malformed(part):
            return f"segment {part.get('name', s)!r}: {problem}"
    return None


def _malformed(part: Mapping[str, Any]) -> str | None:
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


def _repeated_name(segments: Sequence[Mapping[str, Any]]) -> str | None:
    """The first segment or marker that is named twice."""
    names = [part["name"] for part in segments]
    for what, values in (("segment", names), ("marker", _all_markers(segments))):
        if repeated := sorted({value for value in values if values.count(value) > 1}):
            return f"{what} {repeated[0]!r} is named twice: name it once"
    return None


def _parent_problem(segments: Sequence[Mapping[str, Any]], parents: Sequence[Any]) -> str | None:
    """What is wrong with the parents of the segments (by index, or as written where there is no such segment)."""
    for part, parent in zip(segments, parents, strict=True):
        if parent is not None and parent not in range(len(segments)):
            return f"segment {part['name']!r}: parent {parent!r} is no segment: give an index from 0, a name, or null"
        marker = part["parent_marker"]
        if marker not in ([*_all_markers(segments), None] if parent is None else segments[parent]["markers"]):
            return f"segment {part['name']!r}: parent_marker {marker!r} is no marker of its parent segment"
    if (s := first_in_cycle(parents)) is not None:
        return f"segment {segments[s]['name']!r}: its parents form a cycle: one segment of each body needs parent null"
    return None


def _all_markers(segments: Sequence[Mapping[str, Any]]) -> list[str]:
    """The markers of all segments."""
    return [marker for part in segments for marker in part["markers"]]


def first_in_cycle(parents: Sequence[int | None]) -> int | None:
    """Find a segment that no root is above.

    Parameters
    ----------
    parents : sequence of int or None
        Index of the parent of each segment, None for a root.

    Returns
    -------
    int or None
        The first segment whose chain of parents never ends, None if all end at a root.
    """
    for s in range(len(parents)):
        above, steps = parents[s], 0
        while above is not None and steps <= len(parents):
            above, steps = parents[above], steps + 1
        if above is not None:
            return s
    return None
