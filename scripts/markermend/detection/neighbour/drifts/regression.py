"""Drifts by generalised least squares: the height of a drift is estimated together with the regression on the neighbours.

A regression that is fitted to a recording of seconds follows half of a drift of seconds, so that little of it remains in the
residual. Such drifts need no high sampling rate: everything is done on means over bins of a tenth of a second or so.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.core.cache import CachesResults
from markermend.detection.neighbour import residual_scale
from markermend.numerics import intervals, matched_filter
from markermend.numerics.matched_filter import raised_cosine
from markermend.numerics.pulse_regression import PulseRegression, PulseResponses
from markermend.options.detection.estimated_drifts import EstimatedDriftOptions
from markermend.prediction.interface import LocalRegression
from markermend.prediction.scene import Scene

MIN_SCALE_MM = 0.02
"""Smallest local scale of the residual, mm: positions are stored no more precisely."""


@dataclass(frozen=True, eq=False)
class DriftModel(CachesResults):
    """The regressions of one marker in which drifts are estimated.

    Attributes
    ----------
    parts : Sequence[tuple[int, PulseRegression]]
        First bin, and regression over the bins from there on, for each part of the recording and set of neighbours.
    bins : int
        Number of bins of the recording.
    """

    parts: Sequence[tuple[int, PulseRegression]]
    bins: int

    def responses(self, length: int, *, min_known_share: float) -> PulseResponses:
        """Estimate drifts of a length at all places.

        Parameters
        ----------
        length : int
            Length, bins.
        min_known_share : float
            Share of the drift that must be known.

        Returns
        -------
        PulseResponses
            For the max(0, bins - length + 1) places, each from the part that estimates it best.
        """
        places = max(0, self.bins - length + 1)
        height, deviation = np.zeros((places, 3)), np.full(places, np.inf)
        for first, part in self.parts:
            own = part.responses(length, min_known_share=min_known_share)
            there = slice(first, first + len(own.deviation))
            better = own.deviation < deviation[there]
            height[there][better], deviation[there][better] = own.height[better], own.deviation[better]
        return PulseResponses(height, deviation)

    def estimate(self, shapes: np.ndarray) -> PulseResponses:
        """Estimate changes of given shapes.

        Parameters
        ----------
        shapes : np.ndarray
            Shapes (k, bins) of height 1.

        Returns
        -------
        PulseResponses
            One for each, from the part that estimates the first of them best.
        """
        each = [
            part.estimate(shapes[:, first : first + len(part.weighted)] - shapes[:, [first]])
            for first, part in self.parts
        ]
        nothing = PulseResponses(np.zeros((len(shapes), 3)), np.full(len(shapes), np.inf))
        return min(each, key=lambda own: float(own.deviation[0]), default=nothing)


@dataclass(frozen=True, eq=False)
class BinnedRegression:
    """A regression of a marker in means over bins.

    Attributes
    ----------
    marker : int
        Index of the marker.
    target, inputs, residual : np.ndarray
        Means (bins, ...) of what `LocalRegression` has at its frames; NaN where unknown.
    """

    marker: int
    target: np.ndarray
    inputs: np.ndarray
    residual: np.ndarray


@dataclass(frozen=True)
class DriftRegression:
    """Fits the models in which drifts are estimated.

    Attributes
    ----------
    rate : float
        Sampling rate, Hz.
    options : EstimatedDriftOptions
        Bins, covariance and local scale.
    """

    rate: float
    options: EstimatedDriftOptions

    @property
    def step(self) -> int:
        """Frames of a bin."""
        return intervals.samples(1 / self.options.bin_rate_hz, self.rate)

    def bins(self, seconds: float) -> int:
        """Convert a duration to bins.

        Parameters
        ----------
        seconds : float
            Duration, s.

        Returns
        -------
        int
            Number of bins, at least 1.
        """
        return intervals.samples(seconds, self.rate / self.step)

    def shape(self, start: int, stop: int, bins: int) -> np.ndarray:
        """Evaluate a drift at the middles of bins.

        Parameters
        ----------
        start, stop : int
            The drift, frames [start, stop).
        bins : int
            Number of bins.

        Returns
        -------
        np.ndarray
            Heights (bins,) of a drift of height 1.
        """
        middle = (np.arange(bins) + 0.5) * self.step
        return raised_cosine((middle - start) / (stop - start))

    def scale(self, scene: Scene, residual: np.ndarray, motion: np.ndarray) -> np.ndarray:
        """Fit the local scale of residuals to the motion of the neighbours and to their residuals.

        Parameters
        ----------
        scene : Scene
            What is observed.
        residual : np.ndarray
            Residuals (frames, markers, 3), mm, NaN = missing.
        motion : np.ndarray
            Motion of the neighbours (kinds, frames, markers), see nearest_neighbours.motion.

        Returns
        -------
        np.ndarray
            Scale (bins, markers), mm.
        """
        size = np.sqrt(bin_means((residual**2).sum(axis=2), self.step))
        return residual_scale.fitted_scale(
            size,
            scene.neighbours,
            np.stack([bin_means(kind, self.step) for kind in motion]),
            count=self.options.scale_neighbours,
            window=self.bins(self.options.scale_window_s),
            min_scale=MIN_SCALE_MM,
        )

    def binned(self, regression: LocalRegression, frames: int) -> BinnedRegression:
        """Take means of a regression over bins.

        Parameters
        ----------
        regression : LocalRegression
            The regression of a marker on its neighbours.
        frames : int
            Length of the recording.

        Returns
        -------
        BinnedRegression
            Its means.
        """
        target, inputs, residual = (
            bin_means(on_all_frames(values, regression.frames, frames), self.step)
            for values in (regression.target, regression.inputs, regression.residual)
        )
        return BinnedRegression(regression.marker, target, inputs, residual)

    def models(self, regressions: Iterable[BinnedRegression], scale: np.ndarray) -> list[DriftModel]:
        """Fit the models of all markers.

        Parameters
        ----------
        regressions : Iterable[BinnedRegression]
            Regressions of markers on their neighbours.
        scale : np.ndarray
            Local scale (bins, markers), mm.

        Returns
        -------
        list[DriftModel]
            One for each marker; without parts where none can be fitted.
        """
        parts = list[list[tuple[int, PulseRegression]]]([] for _ in range(scale.shape[1]))
        for own in regressions:
            parts[own.marker].extend(self._parts(own, scale[:, own.marker]))
        return [DriftModel(own, len(scale)) for own in parts]

    def _parts(self, own: BinnedRegression, scale: np.ndarray) -> Iterator[tuple[int, PulseRegression]]:
        """Regressions over parts of a recording that overlap by the longest drift and its flanks."""
        options, step = self.options, self.step
        known = np.flatnonzero(~np.isnan(own.residual).any(axis=1))
        if len(known) < 2 * self.bins(min(options.durations_s)):
            return
        covariance = matched_filter.clipped_covariance(
            own.residual / scale[:, None],
            sigmas=options.outlier_sigmas,
            rate=self.rate / step,
            scales_s=np.array(options.correlation_times_s),
            max_lag_s=options.max_lag_s,
        )
        size, overlap = self.bins(options.max_part_s), 2 * self.bins(max(options.durations_s))
        first, stop = int(known[0]), int(known[-1]) + 1
        while True:
            part = slice(first, min(first + max(size, 2 * overlap), stop))
            yield (
                first,
                PulseRegression.fit(
                    own.target[part],
                    own.inputs[part],
                    scale=scale[part],
                    covariance=covariance,
                    step_s=step / self.rate,
                    coefficient_std=options.coefficient_std,
                ),
            )
            if part.stop == stop:
                return
            first = part.stop - overlap


def on_all_frames(values: np.ndarray, rows: np.ndarray, frames: int) -> np.ndarray:
    """Put values at their frames.

    Parameters
    ----------
    values : np.ndarray
        Values (n, columns).
    rows : np.ndarray
        Their frames (n,).
    frames : int
        Number of all frames.

    Returns
    -------
    np.ndarray
        Values (frames, columns); NaN at other frames.
    """
    if len(rows) == frames:
        return values
    out = np.full((frames, values.shape[1]), np.nan)
    out[rows] = values
    return out


def bin_means(values: np.ndarray, step: int) -> np.ndarray:
    """Take means over bins of frames.

    Parameters
    ----------
    values : np.ndarray
        Values (frames, ...), NaN = missing.
    step : int
        Frames of a bin; those of an incomplete last bin are left out.

    Returns
    -------
    np.ndarray
        Means (bins, ...) of the known values; NaN where fewer than half of a bin are known.
    """
    bins = len(values) // step
    each = values[: bins * step].reshape(bins, step, *values.shape[1:])
    mean: np.ndarray = np.einsum("bs...->b...", each) / step
    if np.isnan(mean).any():
        count = np.count_nonzero(~np.isnan(each), axis=1)
        total = np.nansum(each, axis=1)
        mean = np.where(2 * count >= step, total / np.maximum(count, 1), np.nan)
    return mean
