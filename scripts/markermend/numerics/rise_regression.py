"""Changes of level in a signal that regressors explain: rises of all lengths and places, with or without a return.

Steps, ramps and their differences are sums of steps, so that what generalised least squares needs for all of them follows from
cumulative sums of one precision matrix.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.numerics.pulse_regression import PulseRegression, PulseResponses


@dataclass(frozen=True, eq=False)
class RiseRegression:
    """Cumulative sums of a weighed signal.

    Attributes
    ----------
    steps : np.ndarray
        Information (n + 1, n + 1) that two steps share, each from a sample to the end.
    ramps : np.ndarray
        Their sums (n + 2, n + 1) over the first of the two, from the first sample to one before.
    blocks : np.ndarray
        The sums (n + 2, n + 2) of these over the second.
    weighted : np.ndarray
        Sums (n + 1, axes) of the weighed signal over steps.
    weighted_ramps : np.ndarray
        Their sums (n + 2, axes).
    """

    steps: np.ndarray
    ramps: np.ndarray
    blocks: np.ndarray
    weighted: np.ndarray
    weighted_ramps: np.ndarray

    @classmethod
    def of(cls, signal: PulseRegression) -> RiseRegression:
        """Sum up a weighed signal.

        Parameters
        ----------
        signal : PulseRegression
            The signal.

        Returns
        -------
        RiseRegression
            The sums.
        """
        steps = _from_end(_from_end(signal.precision).T).T
        weighted = _from_end(signal.weighted)
        ramps = _up_to(steps)
        return cls(steps, ramps, _up_to(ramps.T).T, weighted, _up_to(weighted))

    def rises(self, length: int, starts: np.ndarray, stops: np.ndarray) -> PulseResponses:
        """Estimate changes that rise evenly to a level and return from it at once.

        Parameters
        ----------
        length : int
            Samples of the rise: 1 / length at its first, 1 at its last; 1 for a step.
        starts : np.ndarray
            First samples of the rises (i,), at most n - length.
        stops : np.ndarray
            Samples (j,) from which on the change is 0 again; n for one that lasts to the end.

        Returns
        -------
        PulseResponses
            For all pairs: heights (i, j, axes) and deviations (i, j), without meaning where a change returns before it has risen.
        """
        both = self.blocks[starts + length, starts + length] - 2 * self.blocks[starts, starts + length]
        rising = (both + self.blocks[starts, starts]) / length**2
        shared = (self.ramps[starts + length] - self.ramps[starts])[:, stops] / length
        information = rising[:, None] - 2 * shared + self.steps[stops, stops]
        some = information > 0
        inverse = np.where(some, 1 / np.where(some, information, 1.0), np.inf)
        sums = (self.weighted_ramps[starts + length] - self.weighted_ramps[starts]) / length
        height = (sums[:, None] - self.weighted[stops]) * np.where(some, inverse, 0.0)[..., None]
        return PulseResponses(height, np.sqrt(inverse))


def _from_end(values: np.ndarray) -> np.ndarray:
    """Sums (n + 1, ...) of values (n, ...) from each to the end; the last is 0."""
    return np.concatenate([np.cumsum(values[::-1], axis=0)[::-1], np.zeros((1, *values.shape[1:]))])


def _up_to(values: np.ndarray) -> np.ndarray:
    """Sums (n + 1, ...) of the values (n, ...) before each; the first is 0."""
    return np.concatenate([np.zeros((1, *values.shape[1:])), np.cumsum(values, axis=0)])
