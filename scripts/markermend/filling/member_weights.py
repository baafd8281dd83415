"""Weights of the members of an ensemble, and the errors that they state, from their errors on pseudo-gaps."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class MemberWeights:
    """The weights of the members of an ensemble.

    Attributes
    ----------
    typical_errors : ndarray, shape (members,)
        Root mean square distance to the truth, mm; NaN where unknown.
    weights : ndarray, shape (members,)
        Weights that follow from these errors, the largest 1.
    """

    typical_errors: np.ndarray
    weights: np.ndarray


@dataclass(frozen=True)
class Evaluation:
    """What pseudo-gaps say about the members of an ensemble.

    Attributes
    ----------
    errors : ndarray, shape (pseudo-gaps, 2, members)
        Result of `squared_errors`.
    motions : ndarray, shape (pseudo-gaps,)
        How much neighbours move during each pseudo-gap, mm; NaN where unknown.
    deviation_scale : float
        Factor on the standard deviation that the ensemble states.
    standardized_errors : tuple of ndarray
        For each pseudo-gap, distances (n,) to the truth in stated standard deviations, where weights and factor were
        estimated from the other pseudo-gaps alone; NaN where nothing was predicted.
    """

    errors: np.ndarray
    motions: np.ndarray
    deviation_scale: float = 1.0
    standardized_errors: tuple[np.ndarray, ...] = ()


def squared_errors(truths: Sequence[np.ndarray], predictions: Sequence[np.ndarray], members: int) -> np.ndarray:
    """Sum the squared errors of every member on every pseudo-gap.

    Parameters
    ----------
    truths : sequence of ndarray, shape (n, 3)
        True positions during each pseudo-gap, mm.
    predictions : sequence of ndarray, shape (members, n, 3)
        Predictions of each pseudo-gap, mm; NaN where a member has none.
    members : int
        Number of members.

    Returns
    -------
    ndarray, shape (pseudo-gaps, 2, members)
        Sum of squared distances to the truth, mm^2, and number of samples that the member predicted.
    """
    errors = np.zeros((len(truths), 2, members))
    for k, (truth, predicted) in enumerate(zip(truths, predictions, strict=True)):
        square = ((predicted - truth) ** 2).sum(axis=2)
        errors[k] = np.nansum(square, axis=1), np.count_nonzero(~np.isnan(square), axis=1)
    return errors


def typical_errors(errors: np.ndarray) -> np.ndarray:
    """Compute the root mean square distance to the truth of every member.

    Parameters
    ----------
    errors : ndarray, shape (pseudo-gaps, 2, members)
        Result of `squared_errors`.

    Returns
    -------
    ndarray, shape (members,)
        Root mean square distance, mm; NaN for a member that predicted no sample.
    """
    square, count = errors.sum(axis=0)
    typical: np.ndarray = np.where(count > 0, np.sqrt(square / np.maximum(count, 1)), np.nan)
    return typical


def inverse_power_weights(typical: np.ndarray, *, power: float, max_ratio: float, min_error_mm: float) -> np.ndarray:
    """Weigh members by an inverse power of their typical errors.

    Parameters
    ----------
    typical : ndarray, shape (members,)
        Typical errors, mm; NaN where unknown.
    power : float
        Weights fall with this power of the error.
    max_ratio : float
        Members whose error exceeds the smallest by more than this factor get no weight.
    min_error_mm : float
        Smaller errors count as this, mm.

    Returns
    -------
    ndarray, shape (members,)
        Weights, the largest 1; 0 for members with unknown error, and 1 for all where every error is unknown.
    """
    known = np.isfinite(typical)
    if not known.any():
        return np.ones(len(typical))
    floored = np.maximum(np.where(known, typical, np.inf), min_error_mm)
    weights = (floored.min() / floored) ** power
    return np.where(floored <= max_ratio * floored.min(), weights, 0)


def deviation_scale(ratios: np.ndarray, prior: float) -> float:
    """Estimate the factor by which stated standard deviations are too small.

    Parameters
    ----------
    ratios : ndarray, shape (pseudo-gaps,)
        Mean square of the standardized error per axis on each pseudo-gap; NaN where unknown.
    prior : float
        Weight of the prior factor 1, in pseudo-gaps.

    Returns
    -------
    float
        The factor.
    """
    known = ratios[~np.isnan(ratios)]
    total = prior + len(known)
    return math.sqrt((prior + known.sum()) / total) if total else 1.0


def expected_errors(stated: np.ndarray, typical: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Complete the errors that members state.

    A member that states no error is expected to err as much as on pseudo-gaps, with the relative variation over the
    frames that the other members state. A member without pseudo-gaps is expected to err as much as the worst other.

    Parameters
    ----------
    stated : ndarray, shape (members, n)
        Stated standard deviations per axis, mm; NaN where a member states none.
    typical : ndarray, shape (members,)
        Typical errors on pseudo-gaps, mm; NaN where unknown.
    weights : ndarray, shape (members, n)
        Weights of the members.

    Returns
    -------
    ndarray, shape (members, n)
        Standard deviations per axis, mm; NaN where nothing is known of any member.
    """
    usual = (typical / np.sqrt(3))[:, None]
    counted = np.where(np.isnan(stated) | np.isnan(usual), 0.0, weights)
    known = counted.sum(axis=0) > 0
    share = counted / np.where(known, counted.sum(axis=0), 1.0)
    now = np.where(known, (share * np.nan_to_num(stated)).sum(axis=0), 1.0)
    on_average = np.where(known, (share * np.nan_to_num(usual)).sum(axis=0), 1.0)
    errors = np.where(np.isnan(stated), usual * now / np.maximum(on_average, 1e-9), stated)
    worst = np.nan_to_num(errors).max(axis=0)
    return np.where(np.isnan(errors), np.where(worst > 0, worst, np.nan), errors)
