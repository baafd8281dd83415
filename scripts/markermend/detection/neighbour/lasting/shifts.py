"""Markers that were knocked, or crept, to another place on their segment, for good or until a later moment.

Nothing need change from one frame to the next, and the moment may lie in a gap. A displacement is one marker's own: where
the same course explains the motion of a neighbour as well, the subject has changed its pose, in soft tissue or in a joint
that no marker shows.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from markermend.core import events
from markermend.core.events import Event
from markermend.detection.neighbour.lasting.attribution import LastingAttribution
from markermend.detection.neighbour.lasting.level import displaced_parts, locate
from markermend.options.detection.displacement import DisplacementOptions
from markermend.options.prediction.local_ridge import LocalRidgeOptions
from markermend.options.shape import ShapeOptions
from markermend.prediction.lasting_displacement.course import Course
from markermend.prediction.lasting_displacement.displacement import Displacement
from markermend.prediction.scene import Scene
from markermend.prediction.shape_evidence import ShapeEvidence


def not_explained(
    found: Sequence[Event],
    explained_by: Sequence[Event],
    *,
    frames: int,
    moments: bool,
    options: DisplacementOptions,
) -> list[Event]:
    """Leave out what other findings of the same markers explain.

    Parameters
    ----------
    found : Sequence[Event]
        Findings.
    explained_by : Sequence[Event]
        Findings that explain those which overlap with one of them by `same_share` of the longer of the two, or more.
    frames : int
        Frames of the recording.
    moments : bool
        Whether those are left out, too, in which or beside which one of the others begins or ends.
    options : DisplacementOptions
        Which findings are the same, and how near a moment is.

    Returns
    -------
    list[Event]
        The rest of `found`.
    """

    def explains(other: Event, event: Event) -> bool:
        overlap = min(other.stop, event.stop) - max(other.start, event.start)
        longer = max(other.stop - other.start, event.stop - event.start)
        ends = [frame for frame in (other.start, other.stop) if 0 < frame < frames]
        near = options.moment_frames
        spanned = any(event.start - near <= frame <= event.stop + near for frame in ends)
        return overlap >= options.same_share * longer or (moments and spanned)

    return [
        event
        for event in found
        if not any(other.marker == event.marker and explains(other, event) for other in explained_by)
    ]


@dataclass(frozen=True)
class LastingFinder:
    """Finds the lasting displacements of a recording.

    Attributes
    ----------
    local_ridge : LocalRidgeOptions
        Options of the regression on the pose.
    options : DisplacementOptions
        Courses, thresholds and attribution.
    shape : ShapeOptions
        How the usual distances are looked at, which decide which of two places is the usual one.
    """

    local_ridge: LocalRidgeOptions
    options: DisplacementOptions
    shape: ShapeOptions

    def find(self, scene: Scene, markers: Sequence[str], creeps: Mapping[int, Course] | None = None) -> list[Event]:
        """Find lasting displacements.

        Parameters
        ----------
        scene : Scene
            What is observed, without what earlier detectors claimed.
        markers : Sequence[str]
            Names of the markers.
        creeps : Mapping[int, Course], optional
            Creeps that stand out by their standard deviations, by the index of the marker: they need explain less.

        Returns
        -------
        list[Event]
            Events of the parts in which a marker is displaced, of kind `displaced` or `creep`.
        """
        attribution = LastingAttribution(scene, self.local_ridge, self.options, creeps or {})
        return [
            event
            for marker, displacement in attribution.displacements()
            if displacement.amount_mm <= self.options.ceiling_mm
            for event in self._events(
                scene, markers[marker], marker, displacement, attribution.wanted_share(marker, displacement)
            )
        ]

    def _events(self, scene: Scene, name: str, marker: int, displacement: Displacement, wanted: float) -> list[Event]:
        """The events of one displacement: where the marker is at the place that does not count as right.

        wanted: share of the variance that it must explain.
        """
        evidence = None if scene.shape is None else ShapeEvidence(scene.positions, scene.shape, self.shape)
        span = locate(scene, marker, displacement, self.options)
        reference, parts = displaced_parts(scene, marker, displacement, span, evidence, self.options)
        whole = Event(
            name,
            *span,
            max(1.0, displacement.evidence * (1 - wanted) / wanted),
            events.main_axes(displacement.vector[None]),
            kind="creep" if displacement.course.rise_s > 0 else "displaced",
            amount_mm=round(displacement.amount_mm, 2),
            reference=reference,
        )
        return [replace(whole, start=start, stop=stop) for start, stop in parts]
