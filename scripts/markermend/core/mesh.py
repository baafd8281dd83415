"""The functional body mesh: rigid segments of markers in a tree, and the neighbours that each marker is predicted from.

A mesh serves one or more recordings of a subject. It refers to markers by name, never by their index in an array.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np

from markermend.core.shape import Shape, shape_of


@dataclass(frozen=True)
class Segment:
    """Markers that move as one rigid body.

    Attributes
    ----------
    name : str
        Of the segment.
    markers : tuple of str
        Its markers.
    residual_mm : float
        Deviation of a marker from a rigid body, per axis, in mm.
    parent : int or None
        Index of the parent segment, None for the root of a component.
    parent_marker : str or None
        The marker of the parent that the segment is attached to; for a root, a marker of one of its children.
    edge_cost : float or None
        Cost of the attachment in mm, None where unknown.
    component : int
        Number of the subject or prop that it belongs to, from 0, the largest first.
    confidence : float
        How clearly the segment is separated from the others, 0 to 1.
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

    Markers that are hardly ever seen are in no segment, and their lists are empty.

    Attributes
    ----------
    recordings : tuple of str
        Names of the recordings that it was inferred from.
    markers : tuple of str
        All markers of these recordings, sorted.
    segments : tuple of Segment
        Parents before their children.
    predictors : dict[str, tuple[str, ...]]
        For each marker its segment mates, then the marker that its segment is attached to, then the nearest others
        while there are too few.
    neighbours : dict[str, tuple[str, ...]]
        For each marker the others of its component, nearest first.
    warnings : tuple of str
        How a supplied mesh differs from the recordings, one sentence each.
    lacks : tuple of str
        What the motion of these recordings has so little of that segments may be wrong.
    absent : dict[str, tuple[str, ...]]
        By recording, the markers that it does not hold.
    distances : dict[str, dict[str, tuple[float, float, float]]]
        The usual shape: for each marker, by the name of each later one, the usual distance over all recordings, static ones
        included, its robust standard deviation and its spread, mm (`markermend.core.shape.Shape`).
    """

    recordings: tuple[str, ...]
    markers: tuple[str, ...]
    segments: tuple[Segment, ...]
    predictors: dict[str, tuple[str, ...]]
    neighbours: dict[str, tuple[str, ...]]
    warnings: tuple[str, ...] = ()
    lacks: tuple[str, ...] = ()
    absent: dict[str, tuple[str, ...]] = field(default_factory=dict)
    distances: dict[str, dict[str, tuple[float, float, float]]] = field(default_factory=dict)

    def neighbour_indices(self, markers: Sequence[str]) -> list[np.ndarray]:
        """Give the neighbours of each marker of a recording.

        Parameters
        ----------
        markers : sequence of str
            Markers of the recording.

        Returns
        -------
        list of ndarray of int
            For each marker the indices of its neighbours, nearest first.
        """
        return _indices(self.neighbours, markers)

    def segment_mate_indices(self, markers: Sequence[str]) -> list[np.ndarray]:
        """Give the segment mates of each marker of a recording, and the marker that its segment is attached to.

        Parameters
        ----------
        markers : sequence of str
            Markers of the recording.

        Returns
        -------
        list of ndarray of int
            For each marker the indices of its `predictors`.
        """
        return _indices(self.predictors, markers)

    def segment_indices(self, markers: Sequence[str]) -> dict[str, np.ndarray]:
        """Give the markers of each segment.

        Parameters
        ----------
        markers : sequence of str
            Markers of a recording.

        Returns
        -------
        dict of str to ndarray of int
            By name of the segment the indices of its markers.
        """
        place = {marker: m for m, marker in enumerate(markers)}
        return {own.name: np.array([place[name] for name in own.markers], int) for own in self.segments}

    def shape(self, markers: Sequence[str]) -> Shape:
        """Give the usual shape of the markers of a recording.

        Parameters
        ----------
        markers : sequence of str
            Markers of the recording.

        Returns
        -------
        Shape
            Usual distances in the order of the markers; NaN where a pair was never seen.
        """
        return shape_of(self.distances, markers, len(self.recordings))

    def without(self, markers: Collection[str]) -> Mesh:
        """Give the mesh of a recording that lacks some markers.

        Segments keep their places, so that parents stay valid; one may be left without markers. Lists of predictors are
        refilled with the nearest neighbours.

        Parameters
        ----------
        markers : collection of str
            The markers that it lacks.

        Returns
        -------
        Mesh
            The mesh of the others.
        """
        if not markers:
            return self

        def present(names: Sequence[str]) -> tuple[str, ...]:
            return tuple(name for name in names if name not in markers)

        neighbours = {marker: present(self.neighbours[marker]) for marker in present(self.markers)}
        predictors = {}
        for marker, nearest in neighbours.items():
            left = present(self.predictors[marker])
            spare = [name for name in nearest if name not in left]
            predictors[marker] = (*left, *spare[: len(self.predictors[marker]) - len(left)])
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

    def fitted(self, markers: Collection[str]) -> Mesh:
        """Give the mesh of a recording that it was not inferred from.

        Parameters
        ----------
        markers : collection of str
            All markers of the recording.

        Returns
        -------
        Mesh
            The mesh of these markers. Those that it lacks are in no segment, and their lists are empty.
        """
        mesh = self.without({*self.markers} - {*markers})
        unknown = {marker: () for marker in sorted({*markers} - {*self.markers})}
        if not unknown:
            return mesh
        missed = f"the recordings that the mesh was inferred from lack {', '.join(unknown)}"
        return replace(
            mesh,
            markers=tuple(sorted({*mesh.markers, *unknown})),
            predictors={**mesh.predictors, **unknown},
            neighbours={**mesh.neighbours, **unknown},
            warnings=(*mesh.warnings, missed),
        )

    def as_json(self) -> dict[str, Any]:
        """Give the mesh as JSON values.

        Returns
        -------
        dict of str to Any
            What from_json takes.
        """
        return asdict(self)


def _indices(named: dict[str, tuple[str, ...]], markers: Sequence[str]) -> list[np.ndarray]:
    """For each marker of a recording the indices of those that are listed for it."""
    place = {marker: m for m, marker in enumerate(markers)}
    return [np.array([place[name] for name in named[marker]], int) for marker in markers]


def from_json(entry: dict[str, Any]) -> Mesh:
    """Build a mesh from an entry of mesh.json.

    Parameters
    ----------
    entry : dict of str to Any
        As Mesh.as_json gives it.

    Returns
    -------
    Mesh
        The mesh.
    """
    return Mesh(
        recordings=tuple(entry["recordings"]),
        markers=tuple(entry["markers"]),
        segments=tuple(Segment(**{**part, "markers": tuple(part["markers"])}) for part in entry["segments"]),
        predictors={marker: tuple(names) for marker, names in entry["predictors"].items()},
        neighbours={marker: tuple(names) for marker, names in entry["neighbours"].items()},
        warnings=tuple(entry["warnings"]),
        lacks=tuple(entry.get("lacks", ())),
        absent={name: tuple(names) for name, names in entry.get("absent", {}).items()},
        distances={
            first: {
                second: (float(usual), float(deviation), float(spread)) for second, (usual, deviation, spread) in own
            }
            for first, own in ((first, others.items()) for first, others in entry.get("distances", {}).items())
        },
    )
