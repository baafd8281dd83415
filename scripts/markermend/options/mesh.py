"""Options of the stage that infers the body mesh."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from markermend.options.declaration import (
    Count,
    CountOrNone,
    Factor,
    Laboratory,
    Millimetres,
    NotNegative,
    Planned,
    PositiveMillimetres,
    Seconds,
    Share,
)


@dataclass(frozen=True)
class MeshOptions:
    """Infer the body mesh of each subject."""

    files: Annotated[tuple[str, ...], Laboratory, Planned] = ()
    """Mesh files that replace the inferred mesh, for subjects for whom the table of recordings names none.

    Change it when the motion is too small to infer the body from: draw the mesh yourself."""

    max_recordings: Annotated[Count, Planned] = 250
    """Recordings of a subject from which its mesh is inferred and its poses are sampled, at most. Of more, those are taken whose names have
    the smallest checksums: an unsystematic choice, which another recording hardly ever changes."""

    max_frames: CountOrNone = 2500
    """Frames of a recording that are used, at most; they are evenly spaced."""

    min_frames: CountOrNone = 60
    """Frames on which a marker, or both markers of a pair, must be seen."""

    min_jump_mm: Millimetres = 300
    """Samples that a marker reaches and leaves in jumps of at least this length are left out, such as ghosts and numbers that
    stand for missing samples."""

    jump_factor: Factor = 3
    """Shortest such jump, where it is longer, as a multiple of a fast step (which 9 of 10 steps of all markers do not exceed)."""

    reference_distance_mm: Millimetres = 300
    """Distance between two markers that scales their dissimilarity (deviation * distance / this)."""

    segment_cut_mm: Millimetres = 12
    """Dissimilarity above which markers do not share a segment.

    Change it when segments are too large (lower) or fall apart (higher)."""

    max_edge_cost_mm: Millimetres = 200
    """Largest cost of an edge within one subject or prop.

    Change it when two subjects, or a subject and a prop, form one body (lower)."""

    min_predictors: CountOrNone = 3
    """Predictors of a marker, at least: its nearest markers are added to siblings and parent."""

    max_neighbours: CountOrNone = 30
    """Neighbours of a marker in the mesh, at most."""

    min_distance_frames: CountOrNone = 20
    """Frames of a recording on which both markers of a pair must be seen for its usual distance."""

    static_weight: NotNegative = 1.5
    """Weight of a static recording in usual distances; that of any other is at most 1."""

    min_spread_mm: PositiveMillimetres = 2
    """Recordings in which a distance varies more than in most weigh less in its usual value, but for variation below this."""

    min_excitation_s: Seconds = 10
    """Duration of motion that is wanted."""

    min_excitation_mm: Millimetres = 30
    """Median deviation of the distances between markers that is wanted."""

    max_markers_per_segment: NotNegative = 6
    """Markers per segment, at most, that are wanted."""

    min_excitation_share: Share = 0.5
    """The report advises a range-of-motion trial for subjects of whose wanted motion there is less than this share (0 to 1)."""

    min_marker_overlap: NotNegative = 0.8
    """Recordings that share at least this part of their markers are pooled (0 to 1)."""
