"""Leverage: how far inputs lie from those that a regression was trained on, and how its errors grow with that.

The leverage of a row of inputs is ``h = x' inv(X' W X / w + penalty) x``, here in units of its mean over the training.
The variance of an error is modelled as proportional to ``1 + growth * h / (1 + h / max_leverage)``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.prediction.local_ridge.ridge import with_intercept

GROWTHS = np.concatenate([[0.0], np.geomspace(0.01, 100, 25)])
"""Growths of the error's variance with the leverage that are tried."""


@dataclass(frozen=True, eq=False)
class LeverageScale:
    """The standard deviation of an error relative to that of a typical pose, as a function of the leverage.

    Attributes
    ----------
    inverse : np.ndarray
        Matrix (1 + columns, 1 + columns) of the quadratic form that is the relative leverage.
    max_leverage : float
        Limit that the bounded leverage approaches: errors are bounded, as motion is.
    growth : float
        Growth of the variance of an error with the bounded leverage.
    """

    inverse: np.ndarray
    max_leverage: float
    growth: float

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
        leverage = _bounded_leverage(with_intercept(inputs), self.inverse, self.max_leverage)
        factor: np.ndarray = np.sqrt(1 + self.growth * leverage)
        return factor


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
    weighted = full * weights[:, None]
    gram, total = weighted.T @ full, weights.sum()
    inverse = _inverse(gram, total, ridge)
    mean = float((gram * inverse).sum() / total)
    leverage = np.full(len(full), np.nan)
    for number in np.unique(block):
        own = block == number
        rest = total - weights[own].sum()
        if rest > 0:
            inverse_of_rest = _inverse(gram - weighted[own].T @ full[own], rest, ridge)
            leverage[own] = _bounded_leverage(full[own], inverse_of_rest / mean, max_leverage)
    known = np.isfinite(leverage) & ~np.isnan(residual).any(axis=1)
    growth = likeliest_growth(leverage[known], (residual[known] ** 2).mean(axis=1))
    return LeverageScale(inverse / mean, max_leverage, growth), np.sqrt(1 + growth * leverage)


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


def _inverse(gram: np.ndarray, total: float, ridge: float) -> np.ndarray:
    """Inverse of the mean product of inputs, penalised but for the intercept."""
    penalty = np.full(len(gram), float(ridge))
    penalty[0] = 0.0  # the intercept
    return np.linalg.inv(gram / total + np.diag(penalty))


def _bounded_leverage(full: np.ndarray, inverse: np.ndarray, limit: float) -> np.ndarray:
    """Leverages (n,) of rows with intercept (n, 1 + columns), which approach the limit."""
    leverage = ((full @ inverse) * full).sum(axis=1)
    bounded: np.ndarray = leverage / (1 + leverage / limit)
    return bounded
