"""Leverage: how far inputs lie from those that a regression was trained on, and how its errors grow with that.

The leverage of a row of inputs is ``h = x' inv(X' W X / w + penalty) x``, here in units of its mean over the training.
The variance of an error is modelled as proportional to ``1 + growth * h / (1 + h / max_leverage)``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from markermend.prediction.local_ridge.products import starts_of
from markermend.prediction.local_ridge.ridge import penalties, with_intercept

GROWTHS = np.concatenate([[0.0], np.geomspace(0.01, 100, 25)])
"""Growths of the error's variance with the leverage that are tried."""


@dataclass(frozen=True, eq=False)
class LeverageScale:
    """The standard deviation of an error relative to that of a typical pose, as a function of the leverage.

    Attributes
    ----------
    gram : np.ndarray
        Weighted sum of products of the inputs with intercept (1 + columns, 1 + columns).
    total : float
        Sum of the weights.
    ridge : float
        Penalty of the regression, mm^2.
    mean : float
        Mean leverage of the training frames.
    max_leverage : float
        Limit that the bounded leverage approaches: errors are bounded, as motion is.
    growth : float
        Growth of the variance of an error with the bounded leverage.
    """

    gram: np.ndarray
    total: float
    ridge: float
    mean: float
    max_leverage: float
    growth: float = 0.0

    def factor(self, inputs: np.ndarray) -> np.ndarray:
        """Compute the relative standard deviation of errors.

        Parameters
        ----------
        inputs : np.ndarray
            Inputs (n, columns), mm.

        Returns
        -------
        np.ndarray
            Factors (n,), at least 1.
        """
        factor: np.ndarray = np.sqrt(1 + self.growth * self.leverage(with_intercept(inputs)))
        return factor

    def without(self, full: np.ndarray, weights: np.ndarray) -> LeverageScale:
        """Take a part of the training frames away.

        Parameters
        ----------
        full : np.ndarray
            Inputs with intercept (h, 1 + columns), mm, of these frames.
        weights : np.ndarray
            Their weights (h,).

        Returns
        -------
        LeverageScale
            The scale for a regression on the others.
        """
        gram = self.gram - (full * weights[:, None]).T @ full
        return replace(self, gram=gram, total=float(self.total - weights.sum()))

    def leverage(self, full: np.ndarray) -> np.ndarray:
        """Compute the bounded leverage.

        Parameters
        ----------
        full : np.ndarray
            Inputs with intercept (n, 1 + columns), mm.

        Returns
        -------
        np.ndarray
            Leverages (n,) in units of the mean, which approach the limit.
        """
        leverage = np.einsum("nc,nc->n", full @ self._inverse, full) / self.mean
        bounded: np.ndarray = leverage / (1 + leverage / self.max_leverage)
        return bounded

    def mean_leverage(self) -> float:
        """Compute the mean leverage of the training frames.

        Returns
        -------
        float
            The mean, not bounded, per unit of weight.
        """
        return float((self.gram * self._inverse).sum() / self.total)

    @cached_property
    def _inverse(self) -> np.ndarray:
        """Inverse of the mean product of inputs, penalised but for the intercept."""
        return np.linalg.inv(self.gram / self.total + np.diag(penalties(len(self.gram) - 1, self.ridge)))


def fit_leverage_scale(
    inputs: np.ndarray,
    weights: np.ndarray,
    residual: np.ndarray,
    block: np.ndarray,
    *,
    ridge: float,
    max_leverage: float,
) -> tuple[LeverageScale, np.ndarray]:
    """Estimate how errors grow with leverage, from residuals that were left out of the training by blocks.

    Parameters
    ----------
    inputs : np.ndarray
        Inputs (n, columns), mm.
    weights : np.ndarray
        Weights of the training frames (n,).
    residual : np.ndarray
        Residuals (n, axes), mm, each under the regression without its block; NaN does not count.
    block : np.ndarray
        Block of each training frame (n,), ascending numbers.
    ridge : float
        Penalty of the regression, mm^2.
    max_leverage : float
        Limit of the bounded leverage.

    Returns
    -------
    scale : LeverageScale
        The most likely scale for normal errors.
    factors : np.ndarray
        Factors (n,) of the residuals, from their leverages in the regressions without their blocks; NaN where nothing
        is left to train on.
    """
    full = with_intercept(inputs)
    scale = LeverageScale((full * weights[:, None]).T @ full, float(weights.sum()), ridge, 1.0, max_leverage)
    scale = replace(scale, mean=scale.mean_leverage())
    leverage = np.full(len(full), np.nan)
    for start, stop in pairwise([*starts_of(block).tolist(), len(block)]):
        own = slice(start, stop)
        rest = scale.without(full[own], weights[own])
        if rest.total > 0:
            leverage[own] = rest.leverage(full[own])
    known = np.isfinite(leverage) & ~np.isnan(residual).any(axis=1)
    growth = likeliest_growth(
        leverage[known], np.einsum("na,na->n", residual[known], residual[known]) / residual.shape[1]
    )
    return replace(scale, growth=growth), np.sqrt(1 + growth * leverage)


def likeliest_growth(leverage: np.ndarray, square: np.ndarray) -> float:
    """Choose the growth under which normal errors are likeliest, whatever their scale.

    Parameters
    ----------
    leverage : np.ndarray
        Bounded leverages (n,).
    square : np.ndarray
        Mean squares of the errors (n,).

    Returns
    -------
    float
        One of GROWTHS; 0 where nothing is known.
    """
    if len(leverage) == 0 or not square.any():
        return 0.0
    variance = 1 + GROWTHS[:, None] * leverage
    deviance = np.log((square / variance).mean(axis=1)) + np.log(variance).mean(axis=1)
    return float(GROWTHS[np.argmin(deviance)])
