"""Steps: a marker jumps elsewhere, stays, and jumps back (skurowski2022 3.4.4), as its neighbours show."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cached_property, partial

import numpy as np

from markermend.core import events
from markermend.core.events import Event, OpenStep
from markermend.detection import inputs
from markermend.detection.neighbour import attribution, common_motion, edges, level_shifts, residual_windows
from markermend.detection.neighbour.edges import Edge
from markermend.detection.neighbour.lasting.shifts import LastingFinder, not_explained
from markermend.detection.neighbour.level_evidence import LevelEvidence
from markermend.detection.neighbour.level_shifts import DisplacedStretch
from markermend.detection.neighbour.residual_windows import ResidualStatistics, WindowFilters
from markermend.detection.neighbour.window_detector import WindowDetector
from markermend.numerics.window_covariance import WindowCovariance
from markermend.options.detection.steps import StepsOptions
from markermend.prediction.interface import ResidualSource
from markermend.prediction.scene import Scene


def detect_steps(
    scene: Scene, *, markers: Sequence[str], earlier: np.ndarray, options: StepsOptions, predictor: ResidualSource
) -> tuple[list[Event], list[OpenStep]]:
    """Find the steps of a recording, and the jumps without a counterpart.

    Parameters
    ----------
    scene : Scene
        What is observed; nothing is found where it is missing.
    markers : Sequence[str]
        Names of the markers.
    earlier : np.ndarray
        What earlier detectors claimed, bool, like the positions.
    options : StepsOptions
        Lengths and thresholds of a step and its two jumps, context, and attribution.
    predictor : ResidualSource
        Predicts each marker from its neighbours.

    Returns
    -------
    found : list[Event]
        Events, sorted; those of one kind are disjoint, and a step may lie within a lasting displacement.
    open_steps : list[OpenStep]
        Jumps with which no event begins or ends, by marker and frame.
    """
    detector = StepDetector(inputs.without_claimed(scene, earlier), markers, options, missing=~scene.present)
    found, statistics = attribution.attribute(
        detector, predictor=predictor, rounds=options.attribution_rounds, neighbours=options.attribution_neighbours
    )
    found = events.disjoint(found)
    # A gap may hide a jump, and so may what was claimed earlier: noise on a step often reaches to its end.
    unseen = ~scene.present | earlier.any(axis=2)
    truncated = list(_truncated(detector, statistics, found, unseen))
    finder = LastingFinder(options.predictors.local_ridge, options.displacement, options.shape)
    explained = partial(not_explained, frames=len(unseen), options=options.displacement)
    lasting = explained(finder.find(detector.scene, markers), found, moments=False)
    truncated = explained(truncated, lasting, moments=True)
    displaced = [event for event in lasting if event.kind == "displaced"]
    found = sorted([*events.disjoint([*found, *truncated]), *displaced], key=lambda event: event.order)
    return found, _open_steps([detector.edges(statistics, m) for m in range(len(markers))], found, markers)


def _truncated(
    detector: StepDetector, statistics: ResidualStatistics, found: Sequence[Event], unseen: np.ndarray
) -> Iterator[Event]:
    """The level shifts with an unseen frame (frames, markers) or an end of the recording in place of one edge.

    None touches what was found of its marker, nor is any at an edge where something begins or ends that was found of
    another one, of which it may be the reflection.
    """
    for m, name in enumerate(detector.markers):
        reflected = {frame for other in found if other.marker != name for frame in (other.start, other.stop)}
        own = [edge for edge in detector.edges(statistics, m) if edge.frame not in reflected]
        taken = [other for other in found if other.marker == name]
        for stretch in detector.displaced(statistics, m, own, unseen[:, m]):
            free = all(stretch.stop < other.start or other.stop < stretch.start for other in taken)
            if len(stretch.edges) == 1 and free:
                yield stretch.event(name, detector.options.joint_jump_fraction)


def _open_steps(jumps: Sequence[Sequence[Edge]], found: Sequence[Event], markers: Sequence[str]) -> list[OpenStep]:
    """The jumps of each marker with which no event begins or ends, nor which lie in one."""
    used = {(event.marker, frame) for event in found for frame in range(event.start, event.stop + 1)}
    return [
        OpenStep(name, edge.frame, float(np.linalg.norm(edge.jump)))
        for name, own in zip(markers, jumps, strict=True)
        for edge in own
        if (name, edge.frame) not in used
    ]


class StepDetector(WindowDetector):
    """Finds level shifts between two edges in the residuals.

    Parameters
    ----------
    scene : Scene
        What is observed, without what earlier detectors claimed.
    markers : Sequence[str]
        Names of the markers.
    options : StepsOptions
        Lengths and thresholds of a step and its two jumps, context, and attribution.
    missing : np.ndarray
        Where markers were not observed, bool (frames, markers); what earlier detectors claimed was.
    """

    def __init__(self, scene: Scene, markers: Sequence[str], options: StepsOptions, *, missing: np.ndarray) -> None:
        super().__init__(scene, markers, options)
        self.options, self.missing = options, missing
        self._measured: ResidualStatistics | None = None
        self._found: dict[int, list[Edge]] = {}
        self._context = residual_windows.context_samples(scene.rate, options, min_samples=edges.MIN_CONTEXT)

    @property
    def window(self) -> int:
        """Samples in a window."""
        return 2 * self._context + self.options.max_ramp_frames

    @cached_property
    def _bends(self) -> tuple[np.ndarray, np.ndarray]:
        """How much the trajectories of the markers bend (frames, markers), mm, and those of the neighbours of each."""
        own = common_motion.bend(self.scene.positions)
        return own, common_motion.neighbour_bend(
            own,
            self.scene.neighbours,
            count=self.options.scale_neighbours,
            quantile=self.options.neighbour_acceleration_quantile,
        )

    def _amid_motion(self, edge: Edge, marker: int) -> Edge:
        """An edge whose threshold rises where its neighbours are accelerated nearly as much at that moment."""
        own, common = (
            float(bends[max(0, edge.frame - 1) : edge.frame + edge.ramp + 1, marker].max()) for bends in self._bends
        )
        enough = self.options.clear_acceleration_ratio * common
        return replace(edge, score=edge.score * own / enough) if own < enough else edge

    def central_filter(self, covariance: WindowCovariance) -> WindowFilters:
        """Make the filter of a step; see `WindowDetector.central_filter`."""
        return edges.step_filters(covariance, self.window, (self._context,))

    def edges(self, statistics: ResidualStatistics, marker: int, *, fraction: float = 1.0) -> list[Edge]:
        """Find the edges of one marker.

        Parameters
        ----------
        statistics : ResidualStatistics
            Statistics of the residuals.
        marker : int
            Index of the marker.
        fraction : float, optional
            Part of the threshold that is enough.

        Returns
        -------
        list[Edge]
            The edges, by frame.
        """
        if statistics is not self._measured:
            self._measured, self._found = statistics, {}
        if marker not in self._found:
            fewest = self.options.single_jump_fraction
            found = edges.find_edges(statistics, marker, rate=self.scene.rate, options=self.options, fraction=fewest)
            self._found[marker] = [self._amid_motion(edge, marker) for edge in found]
        return [edge for edge in self._found[marker] if edge.score > fraction]

    def find_events(self, statistics: ResidualStatistics, marker: int) -> list[Event]:
        """Find the level shifts of one marker, also between edges below the threshold; see `Detector.find_events`."""
        return self._between_edges(statistics, marker, self.options.single_jump_fraction)

    def find_candidates(self, statistics: ResidualStatistics, marker: int) -> list[Event]:
        """Find the level shifts between edges above the threshold: smaller ones are often motion.

        See `Detector.find_candidates`.
        """
        return self._between_edges(statistics, marker, 1.0)

    def unexplained(self, statistics: ResidualStatistics, marker: int) -> Sequence[int]:
        """Find the frames of the edges of one marker; see `Detector.unexplained`."""
        return [edge.frame for edge in self.edges(statistics, marker)]

    def displaced(
        self, statistics: ResidualStatistics, marker: int, found: Sequence[Edge], missing: np.ndarray
    ) -> list[DisplacedStretch]:
        """Find the stretches in which one marker is displaced.

        Parameters
        ----------
        statistics : ResidualStatistics
            Statistics of the residuals.
        marker : int
            Index of the marker.
        found : Sequence[Edge]
            Its edges.
        missing : np.ndarray
            Where it is not observed, bool (frames,).

        Returns
        -------
        list[DisplacedStretch]
            The stretches, by frame.
        """
        evidence = LevelEvidence(
            self.scene, marker, statistics.residual[:, marker], self.options.level, self.options.shape
        )
        runs = level_shifts.explanations(found, evidence, missing=missing, rate=self.scene.rate, options=self.options)
        return [stretch for run in runs for stretch in run.displaced()]

    def _between_edges(self, statistics: ResidualStatistics, marker: int, fraction: float) -> list[Event]:
        """The level shifts of one marker between edges that exceed a part of the threshold."""
        found = self.edges(statistics, marker, fraction=fraction)
        displaced = self.displaced(statistics, marker, found, self.missing[:, marker])
        name, sufficient = self.markers[marker], self.options.joint_jump_fraction
        return [stretch.event(name, sufficient) for stretch in displaced if len(stretch.edges) == 2]
