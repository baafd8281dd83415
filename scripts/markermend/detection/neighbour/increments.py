"""Sudden increments of markers against their neighbours: what heavy noise is made of.

A sudden increment is one that the neighbours cannot explain (it is in the residual) and that the marker itself makes (it is
in the trajectory as recorded, in the same direction). The artifact of a neighbour is in the residual alone, natural motion
in the trajectory alone.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.core.events import Event
from markermend.detection.neighbour import residual_scale
from markermend.numerics import intervals, moving
from markermend.numerics.intervals import runs
from markermend.options.detection.noise import IncrementOptions
from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class IncrementStatistics:
    """Increments of all markers, and how clearly each is sudden.

    Attributes
    ----------
    residual : np.ndarray
        Residuals (frames, markers, 3), mm, NaN = missing.
    vector : np.ndarray
        Detrended increments of the residual (frames, markers, 3), mm; 0 where there is none.
    size : np.ndarray
        How much of them the marker itself makes (frames, markers), mm.
    score : np.ndarray
        The size in units of the threshold (frames, markers).
    tail : float
        A large size in this recording, mm.
    """

    residual: np.ndarray
    vector: np.ndarray
    size: np.ndarray
    score: np.ndarray
    tail: float


def detrended_increments(values: np.ndarray, window: int) -> np.ndarray:
    """Subtract the moving median from the increments of a trajectory, over each run without a gap.

    Parameters
    ----------
    values : np.ndarray
        Trajectory (frames, 3), mm, NaN = missing.
    window : int
        Window of the median, samples.

    Returns
    -------
    np.ndarray
        Increments from the frame before (frames, 3), mm; 0 at the first frame of a run and in gaps.
    """
    increments = np.zeros_like(values)
    for start, stop in runs(~np.isnan(values).any(axis=1)):
        if stop - start > 1:
            change = np.diff(values[start:stop], axis=0)
            increments[start + 1 : stop] = change - moving.median(change, window)
    return increments


class IncrementDetector(ABC):
    """What the detectors of sudden increments share: a Detector for the attribution, which lacks only `find_events`.

    Parameters
    ----------
    scene : Scene
        What is observed, without what earlier detectors claimed.
    markers : Sequence[str]
        Names of the markers.
    options : IncrementOptions
        Window of the moving median, threshold, and window of the local scale.
    """

    def __init__(self, scene: Scene, markers: Sequence[str], options: IncrementOptions) -> None:
        self.scene, self.markers, self.increment_options = scene, markers, options

    @abstractmethod
    def find_events(self, statistics: IncrementStatistics, marker: int) -> list[Event]:
        """Find the events of one marker; see `Detector.find_events`."""

    def find_candidates(self, statistics: IncrementStatistics, marker: int) -> list[Event]:
        """Find where the trajectory of one marker itself has an event; see `Detector.find_candidates`."""
        return self.find_events(statistics, marker)

    def unexplained(self, statistics: IncrementStatistics, marker: int) -> Sequence[int]:
        """Give no frames: increments leave nothing unexplained; see `Detector.unexplained`."""
        return ()

    @property
    def border(self) -> int:
        """Samples in the window of the moving median: with fewer than three there is no trend."""
        return max(3, intervals.samples(self.increment_options.median_window_s, self.scene.rate, odd=True))

    def measure(self, residual: np.ndarray) -> IncrementStatistics:
        """Measure the sudden increments of all markers; see `Detector.measure`."""
        vector, size = np.zeros(residual.shape), np.zeros(residual.shape[:2])
        self._measure(residual, range(residual.shape[1]), vector, size)
        seen = ~np.isnan(residual).any(axis=2)
        tail = float(np.quantile(size[seen], self.increment_options.tail_quantile)) if seen.any() else 0.0
        return self._statistics(residual, vector, size, tail)

    def update(
        self, statistics: IncrementStatistics, residual: np.ndarray, markers: Sequence[int]
    ) -> IncrementStatistics:
        """Measure the sudden increments of some markers; see `Detector.update`."""
        vector, size = statistics.vector.copy(), statistics.size.copy()
        self._measure(residual, markers, vector, size)
        return self._statistics(residual, vector, size, statistics.tail)

    def _measure(self, residual: np.ndarray, markers: Sequence[int], vector: np.ndarray, size: np.ndarray) -> None:
        """Write the increments of some markers into arrays of all."""
        for m in markers:
            vector[:, m] = detrended_increments(residual[:, m], self.border)
            length = np.linalg.norm(vector[:, m], axis=1)
            recorded = detrended_increments(self.scene.positions[:, m], self.border)
            along = np.einsum("na,na->n", recorded, vector[:, m])
            size[:, m] = np.clip(along / np.maximum(length, 1e-9), 0, length)

    def _statistics(
        self, residual: np.ndarray, vector: np.ndarray, size: np.ndarray, tail: float
    ) -> IncrementStatistics:
        """Statistics of increments, whose threshold rises with the local scale."""
        options = self.increment_options
        seen = ~np.isnan(residual).any(axis=2)
        usual = residual_scale.local_scale(
            np.where(seen, np.linalg.norm(vector, axis=2), np.nan),
            self.scene.neighbours,
            window=intervals.samples(options.scale_window_s, self.scene.rate, odd=True),
            count=options.scale_neighbours,
            max_ratio=options.max_scale_ratio,
        )
        level = np.maximum(options.threshold_sigmas * usual, max(options.floor_mm, options.tail_factor * tail))
        return IncrementStatistics(residual, vector, size, np.nan_to_num(size / level), tail)


def clusters(frames: np.ndarray, link: int) -> list[np.ndarray]:
    """Split sorted frames wherever two are further apart than a distance.

    Parameters
    ----------
    frames : np.ndarray
        Sorted frames (n,).
    link : int
        The distance.

    Returns
    -------
    list[np.ndarray]
        The clusters, in order.
    """
    return np.split(frames, np.flatnonzero(np.diff(frames) > link) + 1) if len(frames) else []
