"""Excess variance: for a while a marker shakes more than it usually does in a band of frequencies.

Jitter changes from frame to frame, wobble is an oscillation of several Hz. Both are too small for any single change to be
conspicuous, so the root mean square over a window is judged: by how much it exceeds what is usual of this marker while its
neighbours move and fit as they do now, and by how much it exceeds the motion of the neighbours in the same band: at an impact
these are shaken as well. How much of either is usual is estimated from the recording, as a quantile over all markers; the
threshold rises with the number of windows in the recording, as the largest of many does (Coles 2001, section 3.1). Only what
is in the trajectory as recorded counts: the artifact of a neighbour is in the residual alone.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from markermend.detection.neighbour import nearest_neighbours, residual_scale
from markermend.detection.neighbour.residual_scale import moving_mean
from markermend.numerics import filters, moving
from markermend.numerics.intervals import runs, samples
from markermend.options.detection.noise import ExcessVarianceOptions, JitterOptions, WobbleOptions
from markermend.prediction.scene import Scene

MIN_WINDOW = 9
"""Samples in a window, at least: the variance of fewer is too uncertain."""

MIN_SIZE = 1e-3
"""Smallest usual size, mm: markers computed from a model fit exactly."""

MEDIAN_SQUARE = 0.454936423119572
"""Median of the squares of a normal variable of variance 1."""


@dataclass(frozen=True)
class Shaking:
    """A stretch in which a marker shakes.

    Attributes
    ----------
    start, stop : int
        The stretch, [start, stop).
    score : float
        Size in units of the threshold, sustained over the shortest duration, without what single changes contribute.
    axes : np.ndarray
        Root mean square along each axis (3,), mm.
    """

    start: int
    stop: int
    score: float
    axes: np.ndarray


class BandDetector:
    """Finds excess variance in one band of frequencies.

    Parameters
    ----------
    scene : Scene
        What is observed.
    band : callable
        Filters a signal (frames,).
    options : ExcessVarianceOptions
        Window, duration and threshold.
    """

    def __init__(self, scene: Scene, band: Callable[[np.ndarray], np.ndarray], options: ExcessVarianceOptions) -> None:
        self._scene, self._band, self._options = scene, band, options
        self._window = max(samples(options.window_s, scene.rate, odd=True), MIN_WINDOW)
        own = (self._filtered(trajectory) for trajectory in np.moveaxis(scene.positions, 1, 0))
        motion = np.sqrt(np.stack([self._mean_product(each, each) for each in own], axis=1))
        self._motion = nearest_neighbours.maximum(motion, scene.neighbours, options.motion_neighbours)

    def find(self, residual: np.ndarray) -> list[list[Shaking]]:
        """Find the stretches in which markers shake.

        Parameters
        ----------
        residual : np.ndarray
            Residuals (frames, markers, 3), mm, NaN = missing.

        Returns
        -------
        list[list[Shaking]]
            The stretches of each marker, in order.
        """
        power, common = np.empty((2, *residual.shape[:2]))
        # One marker after the other: all filtered trajectories of a long recording take as much memory as the recording.
        for m in range(residual.shape[1]):
            shaking, recorded = self._filtered(residual[:, m]), self._filtered(self._scene.positions[:, m])
            power[:, m], common[:, m] = (self._mean_product(shaking, other) for other in (shaking, recorded))
            power[np.isnan(shaking[:, 0]), m] = np.nan
        size = np.minimum(common, power) / np.maximum(np.sqrt(power), MIN_SIZE)
        score = self._score(np.sqrt(power), size)
        return [self._stretches(size[:, m], score[:, m], residual[:, m]) for m in range(score.shape[1])]

    def _filtered(self, trajectory: np.ndarray) -> np.ndarray:
        """Filter a trajectory (frames, 3)."""
        return np.stack([self._band(axis) for axis in trajectory.T], axis=1)

    def _mean_product(self, one: np.ndarray, other: np.ndarray) -> np.ndarray:
        """Moving mean (frames,) of the inner products of two trajectories (frames, 3), at least 0."""
        product: np.ndarray = np.maximum(moving_mean((one * other).sum(axis=1), self._window), 0)
        return product

    def _score(self, residual_size: np.ndarray, size: np.ndarray) -> np.ndarray:
        """Size of shaking (frames, markers) in units of its threshold, 0 where there is none."""
        options, scene = self._options, self._scene
        # In the residuals of neighbours the artifact of the marker itself must not count as their own.
        level = residual_scale.low_levels(residual_size, options.level_quantile, min_level=MIN_SIZE)
        rise = residual_scale.fitted_rise(
            np.maximum(size, level) / level, scene.neighbours, self._motion[None], count=options.scale_neighbours
        )
        usual = level * rise
        known = ~np.isnan(size)
        relative = np.full(size.shape, np.inf)
        for reference in (usual, np.maximum(self._motion, usual)):
            often = float(np.quantile((size / reference)[known], options.tail_quantile)) if known.any() else 1.0
            relative = np.minimum(relative, size / reference / max(often, 1e-9))
        windows = max(1.0, known.sum() / samples(options.min_duration_s, scene.rate))
        score = np.minimum(
            size / np.maximum(options.floor_mm, options.min_motion_ratio * self._motion),
            relative / (options.threshold_factor * windows**options.tail_index),
        )
        seen = nearest_neighbours.seen_share(scene.present, scene.neighbours, options.scale_neighbours)
        score[seen < options.min_seen_share] = 0
        found: np.ndarray = np.nan_to_num(score)
        return found

    def _stretches(self, size: np.ndarray, score: np.ndarray, residual: np.ndarray) -> list[Shaking]:
        """The stretches of one marker whose score stays above 1 for long enough, whatever single samples contribute."""
        found, length = [], samples(self._options.min_duration_s, self._scene.rate)
        long = [(start, stop) for start, stop in runs(score > 1) if stop - start >= length]
        shaking = self._filtered(residual) if long else residual
        for start, stop in long:
            around = slice(max(0, start - self._window), stop + self._window)
            enough = np.sqrt(self._options.border_power_fraction) * np.median(size[start:stop])
            inside = around.start + np.flatnonzero(np.linalg.norm(shaking[around], axis=1) > enough)
            even = evenness(residual[start:stop])
            lasting = moving.minimum(score[start:stop], length).max() * even
            rms = np.sqrt(np.mean(shaking[start:stop] ** 2, axis=0))
            if lasting > 1 and even >= self._options.min_evenness:
                found.append(Shaking(int(inside[0]), int(inside[-1]) + 1, float(lasting), rms))
        return found


def evenness(residual: np.ndarray) -> float:
    """Compare the median with the mean square of the changes from frame to frame.

    A marker that shakes does so all along. Where a jump or a pulse is in the window, however large, a few changes make up
    the mean square, and the median is what it would be without them.

    Parameters
    ----------
    residual : np.ndarray
        Residuals (frames, 3), mm.

    Returns
    -------
    float
        Root mean square as estimated from the median, in units of that from the mean: 1 for normal noise along one axis, and
        at most 1.
    """
    squares = (np.diff(residual, axis=0) ** 2).sum(axis=1)
    squares = squares[~np.isnan(squares)]
    if not squares.any():
        return 1.0
    return float(min(1.0, np.sqrt(np.median(squares) / MEDIAN_SQUARE / np.mean(squares))))


def jitter_detector(scene: Scene, options: JitterOptions) -> BandDetector:
    """Make the detector of jitter from frame to frame.

    Parameters
    ----------
    scene : Scene
        What is observed.
    options : JitterOptions
        Window, duration and threshold.

    Returns
    -------
    BandDetector
        The detector.
    """
    return BandDetector(scene, filters.second_difference, options)


def wobble_detector(scene: Scene, options: WobbleOptions) -> BandDetector | None:
    """Make the detector of wobble.

    Parameters
    ----------
    scene : Scene
        What is observed.
    options : WobbleOptions
        Window, duration and threshold; the band.

    Returns
    -------
    BandDetector or None
        The detector; None where the band is not below half of the sampling rate.
    """
    if options.band_hz[1] >= scene.rate / 2:
        return None
    half_length = samples(options.filter_s / 2, scene.rate)
    band = partial(filters.band_pass, band_hz=options.band_hz, rate=scene.rate, half_length=half_length)
    return BandDetector(scene, band, options)
