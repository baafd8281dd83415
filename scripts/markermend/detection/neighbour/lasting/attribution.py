"""Whose displacement it is: one marker's own, or a change of pose that its neighbours show as well."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from markermend.detection.neighbour.lasting.search import DisplacementSearch
from markermend.options.detection.displacement import DisplacementOptions
from markermend.options.prediction.local_ridge import LocalRidgeOptions
from markermend.prediction.lasting_displacement.course import Course
from markermend.prediction.lasting_displacement.displacement import Displacement, estimate
from markermend.prediction.lasting_displacement.pose_regression import training_data
from markermend.prediction.local_ridge.model import TrainingSet
from markermend.prediction.scene import Scene


@dataclass
class LastingAttribution:
    """Attributes displacements to markers, the clearest first; displaced markers are no longer neighbours of others.

    Attributes
    ----------
    scene : Scene
        What is observed, without what earlier detectors claimed.
    local_ridge : LocalRidgeOptions
        Options of the regression on the pose.
    options : DisplacementOptions
        Courses, thresholds and attribution.
    creeps : Mapping[int, Course]
        Creeps that stand out by their standard deviations, by the index of the marker: they need explain less.
    displaced : frozenset of int
        Markers that are displaced.
    rejected : set of int
        Markers whose displacement a neighbour shares.
    """

    scene: Scene
    local_ridge: LocalRidgeOptions
    options: DisplacementOptions
    creeps: Mapping[int, Course]
    displaced: frozenset[int] = frozenset()
    rejected: set[int] = field(default_factory=set)

    def __post_init__(self) -> None:
        """Make the search."""
        ridge = replace(self.local_ridge, **self.options.local_ridge_changes).ridge_mm2
        self.search = DisplacementSearch(self.scene.rate, ridge, self.options)

    def displacements(self) -> list[tuple[int, Displacement]]:
        """Accept the displacement that explains most, and search the others again without its marker, until none is left.

        Returns
        -------
        list[tuple[int, Displacement]]
            Index of the marker, and displacement.
        """
        found: list[tuple[int, Displacement]] = []
        best = {m: self._best(m, []) for m in range(self.scene.positions.shape[1])}
        while True:
            clear = {
                m: own
                for m, own in best.items()
                if own is not None and self._is_clear(m, own) and m not in self.rejected
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
        searched = self.search.best(data, np.stack(courses, axis=1) if courses else np.zeros((len(time_s), 0)))
        if known or marker not in self.creeps or (searched is not None and self._is_clear(marker, searched)):
            return searched
        return self._estimate(data, self.creeps[marker])

    def _estimate(self, data: TrainingSet, course: Course) -> Displacement:
        """The displacement of a course."""
        return estimate(data, course, rate=self.scene.rate, ridge=self.search.ridge, options=self.options)

    def _data(self, marker: int, excluded: frozenset[int]) -> TrainingSet | None:
        """The training data of a marker."""
        return training_data(
            self.scene, marker, self.local_ridge, self.options, excluded=(self.displaced | excluded) - {marker}
        )

    def wanted_share(self, marker: int, displacement: Displacement) -> float:
        """Give the share of the variance that a displacement must explain.

        Parameters
        ----------
        marker : int
            Index of the marker.
        displacement : Displacement
            The displacement.

        Returns
        -------
        float
            The share, 0 to 1.
        """
        if displacement.course == self.creeps.get(marker):
            return self.options.min_estimated_explained_share
        return (
            self.options.min_creep_explained_share if displacement.course.rise_s else self.options.min_explained_share
        )

    def _is_clear(self, marker: int, displacement: Displacement) -> bool:
        """Whether a displacement is large, explains enough, and has like poses on both sides."""
        return (
            displacement.explained >= self.wanted_share(marker, displacement)
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
            shared = self._estimate(data, displacement.course)
            if shared.amount_mm >= least_mm and shared.evidence >= least_evidence:
                return False
        return True
