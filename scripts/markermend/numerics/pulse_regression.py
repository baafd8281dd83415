"""Pulses in a signal that regressors explain up to coloured noise: generalised least squares for pulse and regression together.

Residuals of a regression understate a pulse, since the regression follows it as far as its regressors can. Here the
coefficients are unknown along with the height of the pulse: what the regressors could explain does not count as evidence.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.numerics.kriging import Covariance
from markermend.numerics.matched_filter import raised_cosine

RELATIVE_PRECISION = 1e-15
"""Part of its trace by which a covariance is larger on its diagonal: as much as numbers in double precision can tell."""

INTERCEPT_STD = 100.0
"""Standard deviation of the constant, in the unit of the signal: it is as good as unknown."""

JITTER = 1e-4
"""White noise in parts of the variance: the finest detail of a shape must not decide where the process is very smooth."""


@dataclass(frozen=True, eq=False)
class PulseResponses:
    """Estimates of pulses of one length at all places.

    Attributes
    ----------
    height : np.ndarray
        Estimated heights (places, axes), in the unit of the signal; a pulse begins at sample 0, 1, ....
    deviation : np.ndarray
        Standard deviations (places,) of each axis of the heights; infinite where too few samples are known.
    """

    height: np.ndarray
    deviation: np.ndarray

    @property
    def statistic(self) -> np.ndarray:
        """Lengths of the heights in standard deviations, like these."""
        statistic: np.ndarray = np.sqrt(np.einsum("...a,...a->...", self.height, self.height)) / self.deviation
        return statistic


@dataclass(frozen=True, eq=False)
class PulseRegression:
    """A signal weighed by the inverse of its covariance, in which pulses are estimated.

    Attributes
    ----------
    precision : np.ndarray
        Inverse covariance (n, n) of the signal without a pulse; 0 at missing samples.
    weighted : np.ndarray
        Its product with the signal (n, axes).
    """

    precision: np.ndarray
    weighted: np.ndarray

    @classmethod
    def fit(
        cls,
        signal: np.ndarray,
        regressors: np.ndarray,
        *,
        scale: np.ndarray,
        covariance: Covariance,
        step_s: float,
        coefficient_std: float,
    ) -> PulseRegression:
        """Weigh a signal.

        Parameters
        ----------
        signal : np.ndarray
            Signal (n, axes), NaN = missing.
        regressors : np.ndarray
            Regressors (n, columns), NaN = missing.
        scale : np.ndarray
            Factors (n,) by which the noise is larger than its covariance function says.
        covariance : Covariance
            Covariance function of the noise; its white noise is that of one sample.
        step_s : float
            Time between the samples, s.
        coefficient_std : float
            Standard deviation of the coefficients, about 0.

        Returns
        -------
        PulseRegression
            The weighed signal.
        """
        known = np.flatnonzero(~(np.isnan(signal).any(axis=1) | np.isnan(regressors).any(axis=1)))
        precision, weighted = np.zeros((len(signal), len(signal))), np.zeros(signal.shape)
        if len(known) == 0:
            return cls(precision, weighted)
        design = regressors[known] - regressors[known].mean(axis=0)
        by_lag = covariance(np.arange(len(signal)) * step_s)
        noise = by_lag[np.abs(known[:, None] - known)]
        noise[np.diag_indices(len(known))] += covariance.noise + JITTER * by_lag[0] + 1e-9
        total = noise * scale[known, None] * scale[known] + coefficient_std**2 * design @ design.T + INTERCEPT_STD**2
        # Of trajectories without any noise, as of markers at rest, the matrix would be singular in floating point.
        total[np.diag_indices(len(known))] += RELATIVE_PRECISION * np.trace(total)
        inverse = np.linalg.inv(total)
        precision[np.ix_(known, known)] = inverse
        weighted[known] = inverse @ (signal[known] - np.median(signal[known], axis=0))
        return cls(precision, weighted)

    def estimate(self, shapes: np.ndarray) -> PulseResponses:
        """Estimate the heights of given shapes.

        Parameters
        ----------
        shapes : np.ndarray
            Shapes (k, n) of height 1.

        Returns
        -------
        PulseResponses
            One for each.
        """
        return self._responses(shapes @ self.weighted, np.einsum("kn,kn->k", shapes @ self.precision, shapes))

    def responses(self, length: int, *, min_known_share: float) -> PulseResponses:
        """Estimate raised-cosine pulses of a length at all places.

        Parameters
        ----------
        length : int
            Length of the pulse, samples.
        min_known_share : float
            Share of the pulse, by its square, that must be known.

        Returns
        -------
        PulseResponses
            For the max(0, n - length + 1) places.
        """
        places = max(0, len(self.weighted) - length + 1)
        if places == 0:
            return PulseResponses(np.zeros((0, self.weighted.shape[1])), np.zeros(0))
        pulse = raised_cosine((np.arange(length) + 0.5) / length)
        windows = np.lib.stride_tricks.sliding_window_view(self.weighted, length, axis=0)
        rows, columns = self.precision.strides
        blocks = np.lib.stride_tricks.as_strided(
            self.precision, (places, length, length), (rows + columns, rows, columns), writeable=False
        )
        information = (blocks @ pulse) @ pulse
        known = np.lib.stride_tricks.sliding_window_view(np.diagonal(self.precision) > 0, length) @ pulse**2
        information[known < min_known_share * (pulse @ pulse)] = 0.0
        return self._responses(windows @ pulse, information)

    def masking(self, length: int, places: np.ndarray, *, scale: np.ndarray) -> np.ndarray:
        """Estimate how much pulses mask themselves: they add to the noise by which they are judged.

        A pulse in the signal raises the covariance that is estimated from it by the pulse's own autocovariance.

        Parameters
        ----------
        length : int
            Length of the pulse, samples.
        places : np.ndarray
            Samples (k,) at which it begins; it must be known there.
        scale : np.ndarray
            Factors (n,) by which the noise is larger than its covariance function says.

        Returns
        -------
        np.ndarray
            Variance (k,) of the height that a pulse of height 1 adds.
        """
        pulse, n = raised_cosine((np.arange(length) + 0.5) / length), len(self.precision)
        shapes = np.zeros((len(places), n))
        shapes[np.arange(len(places))[:, None], places[:, None] + np.arange(length)] = pulse
        weights = shapes @ self.precision
        weights /= np.einsum("kn,kn->k", weights, shapes)[:, None]
        autocovariance = np.zeros(n)
        autocovariance[:length] = np.correlate(pulse, pulse, "full")[length - 1 :]
        known = np.count_nonzero(np.diagonal(self.precision) > 0)
        between = autocovariance[np.abs(np.arange(n)[:, None] - np.arange(n))] * scale[:, None] * scale
        own = scale[places + length // 2]
        added: np.ndarray = np.einsum("kn,kn->k", weights @ between, weights) / (
            own**2 * self.weighted.shape[1] * known
        )
        return added

    @staticmethod
    def _responses(weighted: np.ndarray, information: np.ndarray) -> PulseResponses:
        """Heights from weighted sums (k, axes) and the information (k,) on them."""
        some = information > 0
        inverse = np.where(some, 1 / np.where(some, information, 1.0), np.inf)
        height = weighted * np.where(some, inverse, 0.0)[:, None]
        return PulseResponses(height, np.sqrt(inverse))
