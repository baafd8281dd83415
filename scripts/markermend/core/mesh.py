"""What a functional body mesh is: rigid segments of markers in a tree, and who predicts whom.

A mesh serves one or more recordings of a subject. Marker names tie it to them, never positions in an array.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Segment:
    """Markers that move as one rigid body.

    residual_mm: deviation of a marker from a rigid body, per axis. parent: index of the parent segment, None for the
    root of a component. parent_marker: the marker that it hangs on (for a root, one of a child stands in).
    edge_cost: cost of hanging on parent_marker, mm, None where unknown. component: subject or prop, counted from 0,
    largest first. confidence: 0 to 1, how clearly the segment stands apart from the others.
    """

    name: str
    markers: tuple[str, ...]
    residual_mm: float
    parent: int | None
    parent_marker: str | None
    edge_cost: float | None
    component: int
    confidence: float


@dataclass(frozen=True)
class Mesh:
    """The functional body mesh of one subject and marker set.

    markers: all that its recordings hold, sorted. segments: parents before their children. predictors: for each marker
    its siblings, then its parent marker, then nearest others while there are too few. neighbours: for each marker the
    others of its component, nearest first. Markers hardly ever seen are in no segment, and their lists are empty.
    absent: by recording, the markers that this recording does not hold.
    """

    recordings: tuple[str, ...]
    markers: tuple[str, ...]
    segments: tuple[Segment, ...]
    predictors: dict[str, tuple[str, ...]]
    neighbours: dict[str, tuple[str, ...]]
    warnings: tuple[str, ...] = ()
    absent: dict[str, tuple[str, ...]] = field(default_factory=dict)

    def segment_of(self, marker: str) -> int | None:
        """Index of the segment that holds a marker, None if none does."""
        return next((s for s, segment in enumerate(self.segments) if marker in segment.markers), None)

    def neighbour_indices(self, markers: Sequence[str]) -> list[np.ndarray]:
        """For each of a recording's markers the places of its neighbours among them, nearest first."""
        return _places(self.neighbours, markers)

    def relative_indices(self, markers: Sequence[str]) -> list[np.ndarray]:
        """For each of a recording's markers the places among them of its siblings and its parent marker."""
        return _places(self.predictors, markers)

    def without(self, markers: Collection[str]) -> Mesh:
        """Give the mesh of a recording that lacks some markers; lists of predictors are refilled with the next nearest.

        Segments keep their places, so that parents stay valid; one may be left without markers.
        """
        if not markers:
            return self

        def present(names: Sequence[str]) -> tuple[str, ...]:
            return tuple(name for name in names if name not in markers)

        neighbours = {marker: present(self.neighbours[marker]) for marker in present(self.markers)}
        predictors = {}
        for marker, near in neighbours.items():
            kept = present(self.predictors[marker])
            spare = [name for name in near if name not in kept]
            predictors[marker] = (*kept, *spare[: len(self.predictors[marker]) - len(kept)])
        segments = tuple(
            replace(
                segment,
                markers=present(segment.markers),
                parent_marker=None if segment.parent_marker in markers else segment.parent_marker,
            )
            for segment in self.segments
        )
        return replace(
            self, markers=present(self.markers), segments=segments, predictors=predictors, neighbours=neighbours
        )

    def as_json(self) -> dict[str, Any]:
        """Give the mesh as JSON values."""
        return asdict(self)


def _places(named: dict[str, tuple[str, ...]], markers: Sequence[str]) -> list[np.ndarray]:
    """For each of a recording's markers the places among them of those that are named for it."""
    place = {marker: m for m, marker in enumerate(markers)}
    return [np.array([place[name] for name in named[marker]], int) for marker in markers]


def from_json(entry: dict[str, Any]) -> Mesh:
    """Build a mesh from one entry of mesh.json."""
    return Mesh(
        recordings=tuple(entry["recordings"]),
        markers=tuple(entry["markers"]),
        segments=tuple(Segment(**{**part, "markers": tuple(part["markers"])}) for part in entry["segments"]),
        predictors={marker: tuple(names) for marker, names in entry["predictors"].items()},
        neighbours={marker: tuple(names) for marker, names in entry["neighbours"].items()},
        warnings=tuple(entry["warnings"]),
        absent={name: tuple(names) for name, names in entry.get("absent", {}).items()},
    )
