"""Heavy noise: a marker jumps from sample to sample (skurowski2022 3.4.3), or shakes, for a while, as its neighbours show."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.detection import inputs
from markermend.detection.neighbour import attribution, excess_variance, flicker
from markermend.detection.neighbour.excess_variance import BandDetector, Shaking
from markermend.detection.neighbour.increments import IncrementDetector, IncrementStatistics, clusters
from markermend.detection.neighbour.neighbourhood import overlap
from markermend.numerics import intervals
from markermend.numerics.intervals import runs
from markermend.options.detection.noise import NoiseOptions
from markermend.prediction.interface import ResidualSource
from markermend.prediction.scene import Scene

JITTER_REACH = 1
"""Samples by which a second difference sees beyond the jitter."""


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
    found, statistics = attribution.attribute(
        NoiseDetector(inputs.without_claimed(scene, earlier), markers, options),
        predictor=predictor,
        rounds=options.attribution_rounds,
        neighbours=options.attribution_neighbours,
    )
    found += flicker.find_flicker(
        scene, statistics, markers=markers, earlier=earlier, options=options, predictor=predictor
    )
    return events.disjoint(inputs.of_steady_markers(found, scene, markers, options.shape))


class NoiseDetector(IncrementDetector):
    """Finds stretches of many sudden increments in the residuals, and of excess variance in a band of frequencies.

    Parameters
    ----------
    scene : Scene
        What is observed, without what earlier detectors claimed.
    markers : Sequence[str]
        Names of the markers.
    options : NoiseOptions
        Threshold of an increment; length and density of a stretch; excess variance; attribution.
    """

    def __init__(self, scene: Scene, markers: Sequence[str], options: NoiseOptions) -> None:
        super().__init__(scene, markers, options)
        self.options = options
        self._shaken: tuple[IncrementStatistics, list[list[Shaking]], list[list[Shaking]]] | None = None

    def find_events(self, statistics: IncrementStatistics, marker: int) -> list[Event]:
        """Find the stretches of heavy noise, jitter and wobble of one marker; see `Detector.find_events`."""
        jitter, wobble = ([self._event(one, marker) for one in own[marker]] for own in self._shaking(statistics))
        sudden = self.find_candidates(statistics, marker)
        noise = events.disjoint(sudden + [_within_reach(own, sudden) for own in jitter])
        # White noise has a part in every band.
        return events.disjoint(noise + [own for own in wobble if not any(overlap(own, other) for other in noise)])

    def find_candidates(self, statistics: IncrementStatistics, marker: int) -> list[Event]:
        """Find the stretches of heavy noise of one marker; see `Detector.find_candidates`."""
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

    def _shaking(self, statistics: IncrementStatistics) -> tuple[list[list[Shaking]], list[list[Shaking]]]:
        """The stretches of jitter, and those of wobble, of each marker."""
        if self._shaken is None or self._shaken[0] is not statistics:
            jitter = self._jitter.find(statistics.residual)
            wobble = self._wobble.find(statistics.residual) if self._wobble else [[] for _ in jitter]
            self._shaken = statistics, jitter, wobble
        return self._shaken[1:]

    def _event(self, shaking: Shaking, marker: int) -> Event:
        """A stretch of excess variance as an event."""
        axes = events.main_axes(shaking.axes[None])
        return Event(self.markers[marker], shaking.start, shaking.stop, shaking.score, axes)

    @cached_property
    def _jitter(self) -> BandDetector:
        """The detector of jitter."""
        return excess_variance.jitter_detector(self.scene, self.options.jitter)

    @cached_property
    def _wobble(self) -> BandDetector | None:
        """The detector of wobble, unless the sampling rate is too low for it."""
        return excess_variance.wobble_detector(self.scene, self.options.wobble)

    def _stretches(self, sudden: np.ndarray) -> Iterator[np.ndarray]:
        """The clusters of frames with sudden increments that are long and dense enough."""
        shortest = intervals.samples(self.options.min_duration_s, self.scene.rate)
        for group in clusters(sudden, intervals.samples(self.options.link_s, self.scene.rate)):
            length = int(group[-1] - group[0])
            enough = max(self.options.min_sudden_changes, self.options.min_sudden_share * length)
            if length >= shortest and len(group) >= enough:
                yield group


def _within_reach(jitter: Event, sudden: Sequence[Event]) -> Event:
    """Jitter that ends with the sudden changes if these end as near as the filter of jitter reaches."""
    start, stop = jitter.start, jitter.stop
    for noise in sudden:
        start = noise.start if 0 < noise.start - jitter.start <= JITTER_REACH else start
        stop = noise.stop if 0 < jitter.stop - noise.stop <= JITTER_REACH else stop
    return replace(jitter, start=start, stop=stop)
