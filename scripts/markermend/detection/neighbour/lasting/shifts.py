"""Markers that were knocked, or crept, to another place on their segment, for good or until a later moment.

Nothing need change from one frame to the next, and the moment may lie in a gap. A displacement is one marker's own: where
the same course explains the motion of a neighbour as well, the subject has changed its pose, in soft tissue or in a joint
that no marker shows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.detection.neighbour.lasting.level import displaced_parts, locate
from markermend.detection.neighbour.lasting.search import DisplacementSearch
from markermend.options.detection.displacement import DisplacementOptions
from markermend.options.prediction import LocalRidgeOptions
from markermend.options.shape import ShapeOptions
from markermend.prediction.lasting_displacement.displacement import Displacement, estimate
from markermend.prediction.lasting_displacement.pose_regression import training_data
from markermend.prediction.local_ridge.model import TrainingSet
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

    def find(self, scene: Scene, markers: Sequence[str]) -> list[Event]:
        """Find lasting displacements.

        Parameters
        ----------
        scene : Scene
            What is observed, without what earlier detectors claimed.
        markers : Sequence[str]
            Names of the markers.

        Returns
        -------
        list[Event]
            Events of the parts in which a marker is displaced, of kind `displaced` or `creep`.
        """
        return [
            event
            for marker, displacement in _Attribution(scene, self.local_ridge, self.options).displacements()
            if displacement.amount_mm <= self.options.ceiling_mm
            for event in self._events(scene, markers[marker], marker, displacement)
        ]

    def _events(self, scene: Scene, name: str, marker: int, displacement: Displacement) -> list[Event]:
        """The events of one displacement: where the marker is at the place that does not count as right."""
        evidence = None if scene.shape is None else ShapeEvidence(scene.positions, scene.shape, self.shape)
        span = locate(scene, marker, displacement, self.options)
        reference, parts = displaced_parts(scene, marker, displacement, span, evidence, self.options)
        wanted = _wanted_share(displacement, self.options)
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


def _wanted_share(displacement: Displacement, options: DisplacementOptions) -> float:
    """The share of the variance that a displacement must explain."""
    return options.min_creep_explained_share if displacement.course.rise_s > 0 else options.min_explained_share


@dataclass
class _Attribution:
    """The state of the attribution: which markers are displaced, so that they are no longer neighbours of others."""

    scene: Scene
    local_ridge: LocalRidgeOptions
    options: DisplacementOptions
    displaced: frozenset[int] = frozenset()
    rejected: set[int] = field(default_factory=set)

    def __post_init__(self) -> None:
        ridge = replace(self.local_ridge, **self.options.local_ridge_changes).ridge_mm2
        self.search = DisplacementSearch(self.scene.rate, ridge, self.options)

    def displacements(self) -> list[tuple[int, Displacement]]:
        """Accept the displacement that explains most, and search the others again without its marker, until none is left."""
        found: list[tuple[int, Displacement]] = []
        best = {m: self._best(m, []) for m in range(self.scene.positions.shape[1])}
        while True:
            clear = {
                m: own for m, own in best.items() if own is not None and self._is_clear(own) and m not in self.rejected
            }
            if not clear:
                return found
            marker = max(clear, key=lambda m: (clear[m].explained, -m))
            if not self._is_own(marker, clear[marker]):
                self.rejected.add(marker)
                continue
            found.append((marker, clear[marker]))
            self.displaced |= {marker}
            own = [displacement for m, displacement in found if m == marker]
            best[marker] = self._best(marker, own) if len(own) < self.options.max_findings else None
            self.rejected.clear()
            best |= {m: self._best(m, []) for m in clear if m != marker and m not in self.displaced}

    def _best(self, marker: int, known: Sequence[Displacement]) -> Displacement | None:
        """The displacement of a marker that explains most, besides known ones."""
        data = known[0].data if known else self._data(marker, frozenset())
        if data is None:
            return None
        time_s = data.training / self.scene.rate
        courses = [own.course.at(time_s) for own in known]
        return self.search.best(data, np.stack(courses, axis=1) if courses else np.zeros((len(time_s), 0)))

    def _data(self, marker: int, excluded: frozenset[int]) -> TrainingSet | None:
        """The training data of a marker."""
        return training_data(
            self.scene, marker, self.local_ridge, self.options, excluded=(self.displaced | excluded) - {marker}
        )

    def _is_clear(self, displacement: Displacement) -> bool:
        """Whether a displacement is large, explains enough, and has like poses on both sides."""
        return (
            displacement.explained >= _wanted_share(displacement, self.options)
            and displacement.amount_mm >= self.options.floor_mm
            and displacement.independent >= self.options.min_independent_variance
        )

    def _is_own(self, marker: int, displacement: Displacement) -> bool:
        """Whether none of the neighbours, the marker excluded, is displaced by the same course."""
        options = self.options
        least_mm = options.shared_size_fraction * displacement.amount_mm
        least_evidence = options.shared_evidence_fraction * displacement.evidence
        for neighbour in displacement.data.inputs.tolist():
            data = self._data(neighbour, frozenset([marker]))
            if data is None:
                continue
            shared = estimate(data, displacement.course, rate=self.scene.rate, ridge=self.search.ridge, options=options)
            if shared.amount_mm >= least_mm and shared.evidence >= least_evidence:
                return False
        return True
