"""Steps: a marker jumps elsewhere, stays, and jumps back (skurowski2022 3.4.4), as its neighbours show."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.core import events
from markermend.core.events import Event, OpenStep
from markermend.detection import inputs
from markermend.detection.neighbour import attribution, edges, residual_windows
from markermend.detection.neighbour.edges import Edge
from markermend.detection.neighbour.level_shifts import LevelShiftFinder
from markermend.detection.neighbour.residual_windows import ResidualStatistics, WindowFilters
from markermend.detection.neighbour.window_detector import WindowDetector
from markermend.numerics.window_covariance import WindowCovariance
from markermend.options.detection import StepsOptions
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
        Disjoint events, sorted.
    open_steps : list[OpenStep]
        Jumps with which no event begins or ends, by marker and frame.
    """
    detector = StepDetector(inputs.without_claimed(scene, earlier), markers, options, missing=~scene.present)
    found, statistics = attribution.attribute(
        detector, predictor=predictor, rounds=options.attribution_rounds, neighbours=options.attribution_neighbours
    )
    # A gap may hide a jump, and so may what was claimed earlier: noise on a step often reaches to its end.
    unseen = ~scene.present | earlier.any(axis=2)
    jumps = [detector.edges(statistics, m) for m in range(len(markers))]
    found = events.disjoint(found)
    for m, name in enumerate(markers):
        residual = statistics.residual[:, m]
        truncated = detector.shifts.truncated(residual, jumps[m], found, missing=unseen[:, m], name=name)
        found = events.disjoint([*found, *truncated])
    return found, _open_steps(jumps, found, markers)


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
        self.shifts = LevelShiftFinder(scene.rate, options)
        self._context = residual_windows.context_samples(scene.rate, options, min_samples=edges.MIN_CONTEXT)

    @property
    def window(self) -> int:
        """Samples in a window."""
        return 2 * self._context

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
        return edges.find_edges(statistics, marker, rate=self.scene.rate, options=self.options, fraction=fraction)

    def find_events(self, statistics: ResidualStatistics, marker: int) -> list[Event]:
        """Find the level shifts of one marker, also between edges below the threshold; see `Detector.find_events`."""
        return self._paired(statistics, marker, self.options.single_jump_fraction)

    def find_candidates(self, statistics: ResidualStatistics, marker: int) -> list[Event]:
        """Find the level shifts between edges above the threshold: smaller ones are often motion.

        See `Detector.find_candidates`.
        """
        return self._paired(statistics, marker, 1.0)

    def unexplained(self, statistics: ResidualStatistics, marker: int) -> Sequence[int]:
        """Find the frames of the edges of one marker; see `Detector.unexplained`."""
        return [edge.frame for edge in self.edges(statistics, marker)]

    def _paired(self, statistics: ResidualStatistics, marker: int, fraction: float) -> list[Event]:
        """The level shifts of one marker between edges that exceed a part of the threshold."""
        found = self.edges(statistics, marker, fraction=fraction)
        return self.shifts.between_edges(
            statistics.residual[:, marker], found, missing=self.missing[:, marker], name=self.markers[marker]
        )
