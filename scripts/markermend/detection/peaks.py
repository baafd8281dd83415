"""Isolated peaks: a marker is elsewhere for a few samples and back again (skurowski2022 3.4.2), as its neighbours show."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.detection import inputs
from markermend.detection.neighbour import attribution, pulse_filters, pulses, residual_windows
from markermend.detection.neighbour.common_motion import without_common_motion
from markermend.detection.neighbour.level_evidence import LevelEvidence
from markermend.detection.neighbour.residual_windows import ResidualStatistics, WindowFilters
from markermend.detection.neighbour.window_detector import WindowDetector
from markermend.numerics import intervals
from markermend.numerics.window_covariance import WindowCovariance
from markermend.options.detection.peaks import PeaksOptions
from markermend.prediction.interface import ResidualSource
from markermend.prediction.scene import Scene


def detect_peaks(
    scene: Scene, *, markers: Sequence[str], earlier: np.ndarray, options: PeaksOptions, predictor: ResidualSource
) -> list[Event]:
    """Find the isolated peaks of a recording.

    Parameters
    ----------
    scene : Scene
        What is observed; nothing is found where it is missing.
    markers : Sequence[str]
        Names of the markers.
    earlier : np.ndarray
        What earlier detectors claimed, bool, like the positions.
    options : PeaksOptions
        Longest pulse, threshold, context, and attribution.
    predictor : ResidualSource
        Predicts each marker from its neighbours.

    Returns
    -------
    list[Event]
        Disjoint events, sorted.
    """
    unclaimed = inputs.without_claimed(scene, earlier)
    found, _ = attribution.attribute(
        PeakDetector(unclaimed, markers, options),
        predictor=predictor,
        rounds=options.attribution_rounds,
        neighbours=options.attribution_neighbours,
    )
    found = inputs.of_steady_markers(found, scene, markers, options.shape)
    return events.disjoint(without_common_motion(found, unclaimed, markers, predictor, options.common_motion))


class PeakDetector(WindowDetector):
    """Finds pulses of up to a few samples in the residuals.

    Parameters
    ----------
    scene : Scene
        What is observed, without what earlier detectors claimed.
    markers : Sequence[str]
        Names of the markers.
    options : PeaksOptions
        Longest pulse, threshold, context, and attribution.
    """

    def __init__(self, scene: Scene, markers: Sequence[str], options: PeaksOptions) -> None:
        super().__init__(scene, markers, options)
        self.options = options
        self._longest = intervals.samples(options.max_duration_s, scene.rate)
        self._context = residual_windows.context_samples(scene.rate, options, min_samples=pulses.MIN_CONTEXT)
        self._dip_covariance: WindowCovariance | None = None

    @property
    def window(self) -> int:
        """Samples in the window of the longest peak."""
        return self._longest + 2 * self._context

    def central_filter(self, covariance: WindowCovariance) -> WindowFilters:
        """Make the filter of the longest pulse; see `WindowDetector.central_filter`."""
        return pulse_filters.pulse_filters(covariance, self._longest, self.window, (self._context,))

    def measure(self, residual: np.ndarray) -> ResidualStatistics:
        """Estimate the covariances of windows of peaks, and of those of dips; see `Detector.measure`."""
        longest = max(self._longest, intervals.samples(self.options.max_dip_duration_s, self.scene.rate))
        self._dip_covariance = self.covariance(residual, longest + 2 * self._context)
        return super().measure(residual)

    def find_events(self, statistics: ResidualStatistics, marker: int) -> list[Event]:
        """Find the pulses of one marker; see `Detector.find_events`."""
        return self._pulses(statistics, marker, self.options)

    def find_candidates(self, statistics: ResidualStatistics, marker: int) -> list[Event]:
        """Find the pulses of one marker, also where its velocity changes, as it does amid motion; see `Detector.find_candidates`.

        A trajectory is no residual that could speak for a dip.
        """
        return self._pulses(
            statistics,
            marker,
            replace(self.options, max_kink_ratio=0.0, likely_dip_threshold_factor=self.options.dip_threshold_factor),
        )

    def _pulses(self, statistics: ResidualStatistics, marker: int, options: PeaksOptions) -> list[Event]:
        """The pulses of one marker as events."""
        covariance = statistics.covariance if self._dip_covariance is None else self._dip_covariance
        evidence = LevelEvidence(self.scene, marker, statistics.residual[:, marker], options.level, options.shape)
        found = pulses.find_pulses(statistics, marker, covariance, evidence, options=options)
        name = self.markers[marker]
        return [Event(name, one.start, one.stop, one.score, events.main_axes(one.deviation)) for one in found]
