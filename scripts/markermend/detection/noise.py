"""Heavy noise: a marker jumps from sample to sample for a while (skurowski2022 3.4.3), as its neighbours show."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.detection import inputs
from markermend.detection.neighbour import attribution
from markermend.detection.neighbour.increments import IncrementDetector, IncrementStatistics, clusters
from markermend.numerics import intervals
from markermend.numerics.intervals import runs
from markermend.options.detection import NoiseOptions
from markermend.prediction.interface import ResidualSource
from markermend.prediction.scene import Scene


def detect_noise(
    scene: Scene, *, markers: Sequence[str], earlier: np.ndarray, options: NoiseOptions, predictor: ResidualSource
) -> list[Event]:
    """Find the stretches of heavy noise of a recording.

    Parameters
    ----------
    scene : Scene
        What is observed; nothing is found where it is missing.
    markers : Sequence[str]
        Names of the markers.
    earlier : np.ndarray
        What earlier detectors claimed, bool, like the positions.
    options : NoiseOptions
        Threshold of an increment; length and density of a stretch; attribution.
    predictor : ResidualSource
        Predicts each marker from its neighbours.

    Returns
    -------
    list[Event]
        Disjoint events, sorted.
    """
    found, _ = attribution.attribute(
        NoiseDetector(inputs.without_claimed(scene, earlier), markers, options),
        predictor=predictor,
        rounds=options.attribution_rounds,
        neighbours=options.attribution_neighbours,
    )
    return events.disjoint(found)


class NoiseDetector(IncrementDetector):
    """Finds stretches of many sudden increments in the residuals.

    Parameters
    ----------
    scene : Scene
        What is observed, without what earlier detectors claimed.
    markers : Sequence[str]
        Names of the markers.
    options : NoiseOptions
        Threshold of an increment; length and density of a stretch; attribution.
    """

    def __init__(self, scene: Scene, markers: Sequence[str], options: NoiseOptions) -> None:
        super().__init__(scene, markers, options)
        self.options = options

    def find_events(self, statistics: IncrementStatistics, marker: int) -> list[Event]:
        """Find the stretches of heavy noise of one marker; see `Detector.find_events`."""
        score, vector, name = statistics.score[:, marker], statistics.vector[:, marker], self.markers[marker]
        found = []
        for start, stop in runs(~np.isnan(statistics.residual[:, marker, 0])):
            for group in self._stretches(start + np.flatnonzero(score[start:stop] > 1)):
                # Beside a gap noise has no last change: a remainder as quiet as it is amid the noise belongs to it.
                quiet = int(np.diff(group).max())
                first = start if group[0] - start <= quiet else int(group[0])
                last = stop if stop - group[-1] <= quiet else int(group[-1])
                found.append(Event(name, first, last, float(score[group].max()), events.main_axes(vector[group])))
        return found

    def _stretches(self, sudden: np.ndarray) -> Iterator[np.ndarray]:
        """The clusters of frames with sudden increments that are long and dense enough."""
        shortest = intervals.samples(self.options.min_duration_s, self.scene.rate)
        for group in clusters(sudden, intervals.samples(self.options.link_s, self.scene.rate)):
            length = int(group[-1] - group[0])
            enough = max(self.options.min_sudden_changes, self.options.min_sudden_share * length)
            if length >= shortest and len(group) >= enough:
                yield group
