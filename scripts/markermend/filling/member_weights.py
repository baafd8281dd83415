"""How far to trust each of several predictors, and the error that they state, after trying them on hidden stretches."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Trust:
    """What pseudo-gaps tell about the members.

    typical: (members,), mm, root mean square distance to the truth, NaN where unknown. shares: (members,), weights that
    follow from it. scale: factor on the stated standard deviation. missed: for each pseudo-gap, by how many standard
    deviations each sample was missed, had only the other pseudo-gaps been known.
    """

    typical: np.ndarray
    shares: np.ndarray
    scale: float
    missed: tuple[np.ndarray, ...]


def squared_errors(truths: Sequence[np.ndarray], guesses: Sequence[np.ndarray], members: int) -> np.ndarray:
    """Sum of squared distances to the truth, mm^2, and samples that a member told: (pseudo-gaps, 2, members).

    truths: for each pseudo-gap (n, 3), mm. guesses: for each (members, n, 3), NaN where a member tells nothing.
    """
    errors = np.zeros((len(truths), 2, members))
    for k, (truth, guess) in enumerate(zip(truths, guesses, strict=True)):
        square = ((guess - truth) ** 2).sum(axis=2)
        errors[k] = np.nansum(square, axis=1), np.count_nonzero(~np.isnan(square), axis=1)
    return errors


def typical_errors(errors: np.ndarray) -> np.ndarray:
    """Root mean square distance to the truth (members,), mm, over the pseudo-gaps of squared_errors; NaN = unknown."""
    square, count = errors.sum(axis=0)
    return np.where(count > 0, np.sqrt(square / np.maximum(count, 1)), np.nan)


def shares(typical: np.ndarray, *, power: float, worst: float, least: float) -> np.ndarray:
    """Weights (members,), the largest 1, that fall with a power of the typical errors (members,), mm.

    Members worse than the best by the factor `worst`, or never tried, get none; where none was tried all are alike.
    least: errors below it, mm, count as this.
    """
    known = np.isfinite(typical)
    if not known.any():
        return np.ones(len(typical))
    floored = np.maximum(np.where(known, typical, np.inf), least)
    weights = (floored.min() / floored) ** power
    return np.where(floored <= worst * floored.min(), weights, 0)


def stated_scale(ratios: np.ndarray, prior: float) -> float:
    """Factor on stated deviations: by how much pseudo-gaps were missed, mean squares (n,); prior: weight of no change."""
    known = ratios[~np.isnan(ratios)]
    whole = prior + len(known)
    return math.sqrt((prior + known.sum()) / whole) if whole else 1.0


def expected_errors(stated: np.ndarray, typical: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Standard deviation per axis (members, n), mm, of members some of which do not state it (NaN).

    These are taken to err as much as on pseudo-gaps, typical (members,), and when those that state something do. A
    member that was never tried either is taken to be as good as the worst of the others; NaN where nothing is known.
    """
    usual = (typical / np.sqrt(3))[:, None]
    told = np.where(np.isnan(stated) | np.isnan(usual), 0.0, weights)
    known = told.sum(axis=0) > 0
    share = told / np.where(known, told.sum(axis=0), 1.0)
    course = np.where(known, (share * np.nan_to_num(stated)).sum(axis=0), 1.0)
    level = np.where(known, (share * np.nan_to_num(usual)).sum(axis=0), 1.0)
    errors = np.where(np.isnan(stated), usual * course / np.maximum(level, 1e-9), stated)
    worst = np.nan_to_num(errors).max(axis=0)
    return np.where(np.isnan(errors), np.where(worst > 0, worst, np.nan), errors)
