"""Novelty: how far inputs lie from those that a regression was trained on, and how its error grows with that."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

GROWTHS = np.concatenate([[0.0], np.geomspace(0.01, 100, 25)])
"""By how much an error's variance may grow with the novelty; tried one by one."""


@dataclass(frozen=True, eq=False)
class Novelty:
    """Novelty of inputs (n, columns): their leverage in the regression, in units of its mean over the training.

    inverse: (1 + columns, 1 + columns), of the mean product of the training inputs, penalised. most: novelty approaches
    this where poses are altogether new: errors are bounded, as motion is. growth: the variance of an error is
    proportional to 1 + growth * novelty.
    """

    inverse: np.ndarray
    most: float
    growth: float

    def factor(self, inputs: np.ndarray) -> np.ndarray:
        """Standard deviation (n,) of the errors to expect at inputs (n, columns), in the unit of `learn_novelty`."""
        return np.sqrt(1 + self.growth * _novelty(_with_constant(inputs), self.inverse, self.most))


def learn_novelty(
    inputs: np.ndarray, weights: np.ndarray, residual: np.ndarray, block: np.ndarray, *, ridge: float, most: float
) -> tuple[Novelty, np.ndarray]:
    """Learn from residuals that were left out of the training; also returns their factors (n,).

    inputs: (n, columns), mm. weights: (n,). residual: (n, axes), mm, NaN = does not count, each under the model without
    its block. block: (n,), ascending. ridge: penalty as in the regression, mm^2. most: see Novelty. Each novelty is
    that under the other blocks; the growth is the likeliest for normal errors.
    """
    full = _with_constant(inputs)
    weighted = full * weights[:, None]
    gram, total = weighted.T @ full, weights.sum()
    inverse = _inverse(gram, total, ridge)
    mean = float((gram * inverse).sum() / total)
    novelty = np.full(len(full), np.nan)
    for number in np.unique(block):
        own = block == number
        rest = total - weights[own].sum()
        if rest > 0:
            inverse_of_rest = _inverse(gram - weighted[own].T @ full[own], rest, ridge)
            novelty[own] = _novelty(full[own], inverse_of_rest / mean, most)
    known = np.isfinite(novelty) & ~np.isnan(residual).any(axis=1)
    growth = likeliest_growth(novelty[known], (residual[known] ** 2).mean(axis=1))
    return Novelty(inverse / mean, most, growth), np.sqrt(1 + growth * novelty)


def likeliest_growth(novelty: np.ndarray, square: np.ndarray) -> float:
    """The one of GROWTHS under which normal errors of these squares (n,) are likeliest; 0 where nothing is known."""
    if len(novelty) == 0 or not square.any():
        return 0.0
    variance = 1 + GROWTHS[:, None] * novelty
    deviance = np.log((square / variance).mean(axis=1)) + np.log(variance).mean(axis=1)
    return float(GROWTHS[np.argmin(deviance)])


def _with_constant(inputs: np.ndarray) -> np.ndarray:
    return np.concatenate([np.ones((len(inputs), 1)), inputs], axis=1)


def _inverse(gram: np.ndarray, total: float, ridge: float) -> np.ndarray:
    penalty = np.full(len(gram), float(ridge))
    penalty[0] = 0.0  # the intercept
    return np.linalg.inv(gram / total + np.diag(penalty))


def _novelty(full: np.ndarray, inverse: np.ndarray, most: float) -> np.ndarray:
    leverage = ((full @ inverse) * full).sum(axis=1)
    return leverage / (1 + leverage / most)
