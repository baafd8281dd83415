"""Drifts by generalised least squares: the height of a drift is estimated together with the regression on the neighbours.

A regression that is fitted to a recording of seconds follows half of a drift of seconds, so that little of it remains in the
residual. Such drifts need no high sampling rate: everything is done on means over bins of a tenth of a second or so.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from markermend.core.cache import Cache
from markermend.detection.neighbour import residual_scale
from markermend.detection.neighbour.drifts.model import DriftModel, PartOfModel
from markermend.numerics import intervals, matched_filter
from markermend.numerics.kriging import Covariance
from markermend.numerics.matched_filter import raised_cosine
from markermend.numerics.pulse_regression import PulseRegression
from markermend.options.detection.estimated_drifts import EstimatedDriftOptions
from markermend.prediction.interface import LocalRegression
from markermend.prediction.scene import Scene

KEPT_REGRESSIONS = 64
"""Regressions that stay in memory: those of all markers where the recording is one part; more, and a long recording would need gigabytes."""

MIN_SCALE_MM = 0.02
"""Smallest local scale of the residual, mm: positions are stored no more precisely."""


@dataclass(frozen=True, eq=False)
class BinnedRegression:
    """A regression of a marker in means over bins.

    Attributes
    ----------
    marker : int
        Index of the marker.
    bins : np.ndarray
        The bins (k,) in which it is known, ascending.
    target, inputs, residual : np.ndarray
        Means (k, ...) in these of what `LocalRegression` has at its frames.
    """

    marker: int
    bins: np.ndarray
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
        size = np.sqrt(bin_means(np.einsum("nma,nma->nm", residual, residual), self.step))
        return residual_scale.fitted_scale(
            size,
            scene.neighbours,
            np.stack([bin_means(kind, self.step) for kind in motion]),
            count=self.options.scale_neighbours,
            window=self.bins(self.options.scale_window_s),
            min_scale=MIN_SCALE_MM,
        )

    def binned(self, regressions: Iterable[LocalRegression], frames: int) -> Iterator[BinnedRegression]:
        """Take means of regressions over bins, where they are known for long enough to show a drift.

        Parameters
        ----------
        regressions : Iterable[LocalRegression]
            Regressions of markers on their neighbours.
        frames : int
            Length of the recording.

        Yields
        ------
        BinnedRegression
            The means of one of them.
        """
        for own in regressions:
            target, inputs, residual = (
                bin_means(on_all_frames(values, own.frames, frames), self.step)
                for values in (own.target, own.inputs, own.residual)
            )
            known = np.flatnonzero(~np.isnan(residual).any(axis=1))
            if len(known) >= 2 * self.bins(min(self.options.durations_s)):
                yield BinnedRegression(own.marker, known, target[known], inputs[known], residual[known])

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
        kept, parts = Cache(KEPT_REGRESSIONS), list[list[PartOfModel]]([] for _ in range(scale.shape[1]))
        for own in regressions:
            parts[own.marker].extend(self._parts(own, scale[:, own.marker]))
        return [DriftModel(own, len(scale), kept) for own in parts]

    def _parts(self, own: BinnedRegression, scale: np.ndarray) -> Iterator[PartOfModel]:
        """Regressions over parts of a recording that overlap by the longest drift and its flanks."""
        options = self.options
        covariance = matched_filter.clipped_covariance(
            on_all_frames(own.residual, own.bins, len(scale)) / scale[:, None],
            sigmas=options.outlier_sigmas,
            rate=self.rate / self.step,
            scales_s=np.array(options.correlation_times_s),
            max_lag_s=options.max_lag_s,
        )
        size, overlap = self.bins(options.max_part_s), 2 * self.bins(max(options.durations_s))
        first, stop = int(own.bins[0]), int(own.bins[-1]) + 1
        while True:
            part = slice(first, min(first + max(size, 2 * overlap), stop))
            rows = slice(*np.searchsorted(own.bins, (part.start, part.stop)).tolist())
            if rows.start < rows.stop:
                yield PartOfModel(first, partial(self._fit, own, rows, part, scale[part], covariance))
            if part.stop == stop:
                return
            first = part.stop - overlap

    def _fit(
        self, own: BinnedRegression, rows: slice, part: slice, scale: np.ndarray, covariance: Covariance
    ) -> PulseRegression:
        """The regression over the bins of a part, in which the rows of a binned one are known."""
        target, inputs = (
            on_all_frames(values[rows], own.bins[rows] - part.start, part.stop - part.start)
            for values in (own.target, own.inputs)
        )
        return PulseRegression.fit(
            target,
            inputs,
            scale=scale,
            covariance=covariance,
            step_s=self.step / self.rate,
            coefficient_std=self.options.coefficient_std,
        )


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
