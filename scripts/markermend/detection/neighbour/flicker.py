"""Flicker: a marker jumps to and fro between its place and another one at a constant distance.

Each jump undoes the one before. Motion does not do that several times in a row, nor does noise, so that jumps which are
further apart than those of noise belong to one stretch.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.detection import inputs
from markermend.detection.neighbour.hidden_samples import event_mask, residuals_without
from markermend.detection.neighbour.increments import (
    IncrementDetector,
    IncrementStatistics,
    detrended_increments,
)
from markermend.numerics import intervals
from markermend.numerics.intervals import runs
from markermend.options.detection.noise import FlickerOptions, NoiseOptions
from markermend.prediction.interface import ResidualSource
from markermend.prediction.scene import Scene

SIZE_RATIO = np.sqrt(2)
"""Factor between the sizes from which changes are tried as jumps: those of a flicker are much larger than those within levels."""


def alternating_jumps(
    vector: np.ndarray, score: np.ndarray, *, max_dwell: int, options: FlickerOptions
) -> list[np.ndarray]:
    """Find runs of jumps of which each undoes the one before.

    Parameters
    ----------
    vector : np.ndarray
        Changes of a marker from frame to frame (frames, 3), mm.
    score : np.ndarray
        Their size in units of the threshold (frames,).
    max_dwell : int
        Frames between two successive jumps, at most.
    options : FlickerOptions
        Number of jumps, and how alike they are.

    Returns
    -------
    list[np.ndarray]
        The frames of the jumps of each run, in order: of runs that overlap, the one of most jumps.
    """
    found: list[np.ndarray] = []
    threshold, largest = 1.0, float(score.max(initial=0.0))
    while threshold < largest:
        frames = np.flatnonzero(score > threshold)
        jump, size = vector[frames], np.linalg.norm(vector[frames], axis=1)
        undone = np.linalg.norm(jump[1:] + jump[:-1], axis=1) <= options.max_mismatch * np.maximum(size[1:], size[:-1])
        chains = [frames[start : stop + 1] for start, stop in runs(undone & (np.diff(frames) <= max_dwell))]
        found += [own for own in chains if len(own) >= options.min_jumps]
        threshold *= SIZE_RATIO
    kept: list[np.ndarray] = []
    for own in sorted(found, key=len, reverse=True):
        if all(own[-1] < other[0] or other[-1] < own[0] for other in kept):
            kept.append(own)
    return sorted(kept, key=lambda own: int(own[0]))


def paired_extent(
    jumps: np.ndarray, vector: np.ndarray, residual: np.ndarray, *, max_dwell: int, options: FlickerOptions
) -> tuple[int, int]:
    """Find the stretch from where a marker first leaves its place to where it comes back for the last time.

    An odd number of jumps lacks one: the change next to them that undoes the outer one sufficiently, else the nearer end of what
    is seen. Where there is neither, one is too many, and the marker is at its place on the side of the smaller residual.

    Parameters
    ----------
    jumps : np.ndarray
        Frames of the jumps (n,).
    vector : np.ndarray
        Changes of the residual from frame to frame (frames, 3), mm.
    residual : np.ndarray
        The residual (frames, 3), mm, NaN = missing.
    max_dwell : int
        Frames between two successive jumps, at most.
    options : FlickerOptions
        How well a change undoes a jump.

    Returns
    -------
    tuple[int, int]
        The stretch, [start, stop).
    """
    first, last = int(jumps[0]), int(jumps[-1])
    if len(jumps) % 2 == 0:
        return first, last
    absent = np.flatnonzero(np.isnan(residual).any(axis=1))
    begin = int(absent[absent < first].max(initial=-1)) + 1
    end = int(absent[absent > last].min(initial=len(residual)))
    near = np.arange(max(begin, first - max_dwell), min(end, last + max_dwell + 1))
    undone = -(vector[near] @ vector[first]) / (vector[first] @ vector[first])
    undone[(first <= near) & (near <= last)] = 0
    if undone.max() >= options.min_undone_share:
        lacking = int(near[np.argmax(undone)])
        return min(first, lacking), max(last, lacking)
    if min(first - begin, end - last) <= max_dwell:
        return (begin, last) if first - begin < end - last else (first, end)
    before, after = (np.linalg.norm(residual[own].mean(axis=0)) for own in (near[near < first], near[near >= last]))
    return (first, int(jumps[-2])) if before <= after else (int(jumps[1]), last)


class FlickerDetector(IncrementDetector):
    """Finds flicker in sudden increments.

    Parameters
    ----------
    scene : Scene
        What is observed, without what earlier detectors claimed for longer than a marker stays at a level.
    markers : Sequence[str]
        Names of the markers.
    options : NoiseOptions
        Threshold of an increment, and what makes flicker.
    """

    def __init__(self, scene: Scene, markers: Sequence[str], options: NoiseOptions) -> None:
        super().__init__(scene, markers, options)
        self.options = options.flicker
        self._max_dwell = intervals.samples(options.flicker.max_dwell_s, scene.rate)

    def find_events(self, statistics: IncrementStatistics, marker: int) -> list[Event]:
        """Find the flicker of one marker; see `Detector.find_events`."""
        vector, score = statistics.vector[:, marker], statistics.score[:, marker]
        return [
            Event(
                self.markers[marker],
                *paired_extent(
                    jumps,
                    vector,
                    statistics.residual[:, marker],
                    max_dwell=self._max_dwell,
                    options=self.options,
                ),
                float(np.median(score[jumps])),
                events.main_axes(vector[jumps]),
            )
            for jumps in alternating_jumps(vector, score, max_dwell=self._max_dwell, options=self.options)
        ]

    def candidates(self) -> list[Event]:
        """Find where the trajectories themselves may flicker.

        Returns
        -------
        list[Event]
            The events: a residual is wanted of these markers only.
        """
        floor, found = self.increment_options.floor_mm, []
        for m, name in enumerate(self.markers):
            vector = detrended_increments(self.scene.positions[:, m], self.border)
            size = np.linalg.norm(vector, axis=1) / max(floor, 1e-9)
            for jumps in alternating_jumps(vector, size, max_dwell=self._max_dwell, options=self.options):
                found.append(Event(name, int(jumps[0]), int(jumps[-1]), 1.0))
        return found


def find_flicker(
    scene: Scene,
    statistics: IncrementStatistics,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    options: NoiseOptions,
    predictor: ResidualSource,
) -> list[Event]:
    """Find the flicker of all markers, also through the peaks that were found of it.

    Parameters
    ----------
    scene : Scene
        What is observed.
    statistics : IncrementStatistics
        Those of the recording without what earlier detectors claimed.
    markers : Sequence[str]
        Names of the markers.
    earlier : np.ndarray
        What earlier detectors claimed, bool, like the positions.
    options : NoiseOptions
        Threshold of an increment, and what makes flicker.
    predictor : ResidualSource
        Predicts each marker from its neighbours.

    Returns
    -------
    list[Event]
        Disjoint events, sorted; they reach to the ends of what was claimed of them.
    """
    claimed = np.asarray(earlier.any(axis=2))
    longest = intervals.samples(options.flicker.max_dwell_s, scene.rate)
    long_claims = np.stack([_longer_runs(own, longest) for own in claimed.T], axis=1)
    detector = FlickerDetector(inputs.without_claimed(scene, long_claims[..., None]), markers, options)
    candidates = detector.candidates()
    concerned = sorted({markers.index(one.marker) for one in candidates})
    if not concerned:
        return []
    hidden = claimed | event_mask(candidates, len(claimed), markers, border=detector.border)
    residual = statistics.residual.copy()
    residual[:, concerned] = residuals_without(predictor, detector.scene, hidden, concerned)
    statistics = detector.update(statistics, residual, concerned)
    found = [event for m in concerned for event in detector.find_events(statistics, m)]
    return events.disjoint(_with_claims(event, claimed[:, markers.index(event.marker)]) for event in found)


def _longer_runs(mask: np.ndarray, longest: int) -> np.ndarray:
    """The samples (frames,) of a mask that lie in runs of more than some samples."""
    long = np.zeros_like(mask)
    for start, stop in runs(mask):
        long[start:stop] = stop - start > longest
    return long


def _with_claims(event: Event, claimed: np.ndarray) -> Event:
    """An event with all of the claims (frames,) that overlap it: a peak in flicker is part of it."""
    own = [run for run in runs(claimed) if run[0] < event.stop and event.start < run[1]]
    start, stop = min([event.start, *(run[0] for run in own)]), max([event.stop, *(run[1] for run in own)])
    return replace(event, start=start, stop=stop)
