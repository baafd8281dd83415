"""Weighted ridge regression with an unpenalised intercept: coefficients, and weights that keep artifacts out."""

from __future__ import annotations

import numpy as np

from markermend.numerics.robust import MAD_TO_STD

REWEIGHTINGS = 2
"""Rounds of the robust weights."""


def ridge_coefficients(columns: np.ndarray, target: np.ndarray, weights: np.ndarray, ridge: float) -> np.ndarray:
    """Solve a weighted ridge regression with an unpenalised intercept.

    Parameters
    ----------
    columns : np.ndarray
        Intercept and inputs (n, 1 + inputs), see `with_intercept`.
    target : np.ndarray
        Targets (n, targets).
    weights : np.ndarray
        Weights of the rows (n,).
    ridge : float
        Penalty per unit of weight, squared unit of the inputs.

    Returns
    -------
    np.ndarray
        Intercept and coefficients (1 + inputs, targets).

    References
    ----------
    Hoerl & Kennard (1970), Technometrics 12(1).
    """
    weighted = columns * weights[:, None]
    penalty = penalties(columns.shape[1] - 1, ridge)
    return solve(weighted.T @ columns, weighted.T @ target, weights.sum(), penalty)


def with_intercept(inputs: np.ndarray) -> np.ndarray:
    """Put a column of ones before inputs.

    Parameters
    ----------
    inputs : np.ndarray
        Inputs (n, columns).

    Returns
    -------
    np.ndarray
        Design (n, 1 + columns).
    """
    return np.concatenate([np.ones((len(inputs), 1)), inputs], axis=1)


def penalties(columns: int, ridge: float) -> np.ndarray:
    """Give the penalties of the coefficients of inputs; that of the intercept is 0.

    Parameters
    ----------
    columns : int
        Number of inputs.
    ridge : float
        Penalty of each per unit of weight.

    Returns
    -------
    np.ndarray
        Penalties (1 + columns,).
    """
    penalty = np.full(1 + columns, float(ridge))
    penalty[0] = 0.0
    return penalty


def solve(gram: np.ndarray, cross: np.ndarray, total: np.ndarray, penalty: np.ndarray) -> np.ndarray:
    """Solve for the coefficients of a ridge regression.

    Parameters
    ----------
    gram, cross : np.ndarray
        Weighted sums of products of the columns (..., c, c), and of these with the targets (..., c, targets).
    total : np.ndarray
        Sums of the weights (...).
    penalty : np.ndarray
        Penalties (c,) per unit of weight.

    Returns
    -------
    np.ndarray
        Coefficients (..., c, targets).
    """
    return np.linalg.solve(gram + np.diag(penalty) * np.asarray(total)[..., None, None], cross)


def robust_weights(local: np.ndarray, *, ridge: float, sigmas: float) -> np.ndarray:
    """Compute weights that keep artifacts out of the training, by iteratively reweighted least squares.

    Parameters
    ----------
    local : np.ndarray
        Local coordinates (n, 3 k + 3), mm: of the inputs and, last, of the marker itself.
    ridge : float
        Penalty of the regression, mm^2.
    sigmas : float
        Residuals beyond this many robust standard deviations lose weight.

    Returns
    -------
    np.ndarray
        Weights (n,): 1 within the limit, beyond it the squared ratio of limit and residual.
    """
    weights = np.ones(len(local))
    full = with_intercept(local)
    columns, target = full[:, :-3], full[:, -3:]
    for _ in range(REWEIGHTINGS):
        rest = target - columns @ ridge_coefficients(columns, target, weights, ridge)
        residual = np.sqrt(np.einsum("ij,ij->i", rest, rest))
        sigma = MAD_TO_STD * np.median(residual) + 1e-9
        weights = np.minimum(1.0, (sigmas * sigma / np.maximum(residual, 1e-9)) ** 2)
    return weights
