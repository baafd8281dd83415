"""Matched filters on short windows of residuals: the adaptive normalised matched filter.

The covariance of residual windows is estimated from each recording. What remains of a window after the pattern is
fitted is the noise scale, so that the threshold rises with the local residual scale, amid fast motion or heavy noise, and false
alarms do not depend on it (Conte, Lops, Ricci 1995). A pattern must be in the trajectory as recorded too: the artifact of
a neighbour is in the residual alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np

from markermend.numerics import intervals
from markermend.numerics.intervals import runs
from markermend.numerics.window_covariance import WindowCovariance, sliding_windows
from markermend.options.detection.residual_windows import ResidualWindowOptions


@dataclass(frozen=True, eq=False)
class WindowFilters:
    """Matched filters of one pattern at c offsets in windows of n samples.

    Attributes
    ----------
    offsets : np.ndarray
        First sample of the pattern in the window (c,).
    weights : np.ndarray
        Generalised least-squares weights (c, n) that estimate the amplitude of the pattern.
    deviation : np.ndarray
        Standard deviation of the amplitude (c,) where the residual mean square is 1.
    precision : np.ndarray
        Precision of the windows (n, n).
    degrees_of_freedom : int
        Those of one axis of a window after the fit.
    """

    offsets: np.ndarray
    weights: np.ndarray
    deviation: np.ndarray
    precision: np.ndarray
    degrees_of_freedom: int

    @property
    def length(self) -> int:
        """Samples in a window."""
        return int(self.weights.shape[1])

    @property
    def explained(self) -> np.ndarray:
        """Quadratic forms (c, n, n) of what the fits of the pattern explain of a window, in units of the residual mean square."""
        scaled = self.weights / self.deviation[:, None]
        forms: np.ndarray = scaled[:, :, None] * scaled[:, None]
        return forms

    @cached_property
    def _unexplained(self) -> np.ndarray:
        """Quadratic forms (c, n, n) of what remains of a window after the fit."""
        forms: np.ndarray = self.precision - self.explained
        return forms

    @cached_property
    def _band(self) -> np.ndarray:
        """The weights of the only filter at each of as many places as it has samples, in a window of twice that: a banded matrix."""
        length = self.length
        band = np.zeros((2 * length - 1, length))
        for place in range(length):
            band[place : place + length, place] = self.weights[0]
        return band

    def amplitudes(self, signal: np.ndarray) -> np.ndarray:
        """Estimate the amplitude of the pattern in each window of a signal.

        Parameters
        ----------
        signal : np.ndarray
            Signal (frames, axes), mm, of n frames at least.

        Returns
        -------
        np.ndarray
            Amplitudes (axes, frames - n + 1, c), mm.
        """
        length, count = self.length, len(signal) - self.length + 1
        if len(self.weights) > 1:
            each: np.ndarray = sliding_windows(signal, length).swapaxes(0, 1) @ self.weights.T
            return each
        # Overlapping blocks of the signal times a banded matrix: the product is fast, and hardly anything is copied.
        blocks = -(-count // length)
        padded = np.zeros((signal.shape[1], (blocks + 1) * length - 1))
        padded[:, : len(signal)] = signal.T
        step = padded.strides[1]
        shape, strides = (len(padded), blocks, 2 * length - 1), (padded.strides[0], length * step, step)
        cut = np.lib.stride_tricks.as_strided(padded, shape, strides, writeable=False)
        product: np.ndarray = cut.reshape(-1, 2 * length - 1) @ self._band
        return product.reshape(len(padded), -1, 1)[:, :count]

    def misfit(self, windows: np.ndarray, filters: np.ndarray) -> np.ndarray:
        """Compute what remains of windows after the fit of the pattern.

        Parameters
        ----------
        windows : np.ndarray
            Windows (i, axes, n), mm.
        filters : np.ndarray
            Index of the filter (i,) of each.

        Returns
        -------
        np.ndarray
            Root mean square (i,), mm.
        """
        flat = np.ascontiguousarray(windows)
        if len(self.weights) == 1:
            mapped = (flat.reshape(-1, self.length) @ self._unexplained[0]).reshape(windows.shape)
        else:
            mapped = flat @ self._unexplained[filters]
        rest = np.einsum("ian,ian->i", mapped, flat)
        misfit: np.ndarray = np.sqrt(np.maximum(rest, 0) / (windows.shape[1] * self.degrees_of_freedom))
        return misfit


@dataclass(frozen=True)
class ResidualStatistics:
    """Statistics of the residuals.

    Attributes
    ----------
    residual : np.ndarray
        Residuals (frames, markers, 3), mm, NaN = missing.
    positions : np.ndarray
        Positions as recorded (frames, markers, 3), mm, NaN = missing.
    misfit : np.ndarray
        Root mean square (frames, markers), mm, that remains of the window about a frame after the fit of the pattern;
        NaN in runs shorter than a window.
    local_scale : np.ndarray
        The usual misfit about a frame (frames, markers), mm, NaN likewise.
    covariance : WindowCovariance
        Covariance of the residual windows of the recording.
    """

    residual: np.ndarray
    positions: np.ndarray
    misfit: np.ndarray
    local_scale: np.ndarray
    covariance: WindowCovariance


@dataclass(frozen=True)
class Exceedances:
    """Windows whose pattern exceeds the threshold.

    Attributes
    ----------
    residual, positions : np.ndarray
        The windows (i, 3, n), mm.
    filter : np.ndarray
        Index of the filter (i,).
    frame : np.ndarray
        First frame of the pattern (i,).
    amplitude : np.ndarray
        Amplitude of the pattern (i, 3), mm.
    score : np.ndarray
        Amplitude in units of the threshold (i,).
    misfit : np.ndarray
        Root mean square (i,), mm, that remains after the fit of the pattern.
    """

    residual: np.ndarray
    positions: np.ndarray
    filter: np.ndarray
    frame: np.ndarray
    amplitude: np.ndarray
    score: np.ndarray
    misfit: np.ndarray


def window_misfit(residual: np.ndarray, filters: WindowFilters) -> np.ndarray:
    """Compute the misfit of the window about each frame of one marker.

    Parameters
    ----------
    residual : np.ndarray
        Residual (frames, 3), mm, NaN = missing.
    filters : WindowFilters
        One filter, of the pattern in the middle of the window.

    Returns
    -------
    np.ndarray
        Root mean square (frames,), mm: near a gap that of the nearest whole window, NaN in runs shorter than a window.
    """
    window = filters.length
    misfit = np.full(len(residual), np.nan)
    for start, stop in runs(~np.isnan(residual[:, 0])):
        if stop - start >= window:
            windows = sliding_windows(residual[start:stop], window)
            own = filters.misfit(windows, np.zeros(len(windows), int))
            misfit[start:stop] = own[np.clip(np.arange(stop - start) - window // 2, 0, len(own) - 1)]
    return misfit


def context_samples(rate: float, options: ResidualWindowOptions, *, min_samples: int) -> int:
    """Count the samples on either side of a pattern.

    Parameters
    ----------
    rate : float
        Sampling rate, Hz.
    options : ResidualWindowOptions
        Threshold, context, and how the covariance of windows is estimated.
    min_samples : int
        Smallest number, so that the noise scale can be estimated.

    Returns
    -------
    int
        Samples on one side.
    """
    return max(intervals.samples(options.context_s, rate), min_samples)


def window_spans(start: int, stop: int, length: int, context: int) -> list[tuple[slice, tuple[int, ...]]]:
    """Choose windows in which a pattern is looked for at each frame of a run once.

    Parameters
    ----------
    start, stop : int
        The run.
    length : int
        Samples in a window.
    context : int
        Samples before the pattern, as far as the run allows.

    Returns
    -------
    list[tuple[slice, tuple[int, ...]]]
        Spans of frames, with the offsets of the pattern in the windows of each: in its middle all windows have the pattern
        behind its context; at the ends the window stays and the pattern moves.
    """
    early, late = tuple(range(context)), tuple(range(context + 1, length))
    return [
        (slice(start, stop), (context,)),
        (slice(start, start + length), early),
        (slice(stop - length, stop), late),
    ]


def recorded_part(recorded: np.ndarray, residual: np.ndarray) -> np.ndarray:
    """Compute how much of changes of the residual the marker itself makes.

    Parameters
    ----------
    recorded, residual : np.ndarray
        Changes (..., 3) of the trajectory and of the residual, mm.

    Returns
    -------
    np.ndarray
        Component (...) of the first along the second, mm, from 0 to the length of the second.
    """
    length = np.linalg.norm(residual, axis=-1)
    part: np.ndarray = np.clip(np.einsum("...a,...a->...", recorded, residual) / np.maximum(length, 1e-9), 0, length)
    return part


def exceedances(
    statistics: ResidualStatistics,
    marker: int,
    span: slice,
    filters: WindowFilters,
    options: ResidualWindowOptions,
    *,
    fraction: float = 1.0,
) -> Exceedances:
    """Find the windows of a span of one marker whose pattern exceeds the threshold.

    Parameters
    ----------
    statistics : ResidualStatistics
        Statistics of the residuals.
    marker : int
        Index of the marker.
    span : slice
        Frames without a gap.
    filters : WindowFilters
        The filters.
    options : ResidualWindowOptions
        Threshold, context, and how the covariance of windows is estimated.
    fraction : float, optional
        Part of the threshold that is enough.

    Returns
    -------
    Exceedances
        The windows, by frame.

    References
    ----------
    Conte, Lops, Ricci (1995), "Asymptotically optimum radar detection in compound-Gaussian clutter".
    """
    amplitude = filters.amplitudes(statistics.residual[span, marker])
    # The noise is at least the local scale: most windows are below the threshold whatever their misfit.
    deviation = options.threshold_sigmas * filters.deviation
    frames = np.arange(span.start, span.start + amplitude.shape[1])[:, None] + filters.offsets
    least = fraction * np.maximum(deviation * statistics.local_scale[frames, marker], options.floor_mm)
    at, which = np.nonzero(np.einsum("aic,aic->ic", amplitude, amplitude) > least**2)
    if not len(at):
        return _nothing(filters.length)
    amplitude, frame = amplitude[:, at, which].T, frames[at, which]
    residual, positions = (
        sliding_windows(values[span, marker], filters.length)[at]
        for values in (statistics.residual, statistics.positions)
    )
    own = recorded_part(np.einsum("ian,in->ia", positions, filters.weights[which]), amplitude)
    misfit = filters.misfit(residual, which)
    noise = np.hypot(misfit, statistics.local_scale[frame, marker])
    score = own / np.maximum(deviation[which] * noise, options.floor_mm)
    k = score > fraction
    return Exceedances(residual[k], positions[k], which[k], frame[k], amplitude[k], score[k], misfit[k])


@cache
def _nothing(length: int) -> Exceedances:
    """No windows, of a length: what most spans have."""
    windows, none = np.zeros((0, 3, length)), np.zeros(0)
    return Exceedances(windows, windows, none.astype(int), none.astype(int), np.zeros((0, 3)), none, none)
