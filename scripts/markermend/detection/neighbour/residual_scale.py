"""The local scale of residuals: heteroscedastic, it rises with what the body does.

Soft tissue and joints leave larger residuals when the body moves fast, or when everything about a marker fits badly.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.numerics import moving, ranks
from markermend.numerics.non_negative import non_negative_least_squares
from markermend.numerics.robust import moving_median_across_gaps


def local_scale(
    size: np.ndarray, neighbours: Sequence[np.ndarray], *, window: int, count: int, max_ratio: float
) -> np.ndarray:
    """Estimate the usual size about each frame: the moving median, from the marker's median upwards.

    Parameters
    ----------
    size : np.ndarray
        Sizes (frames, markers), mm, NaN = missing.
    neighbours : Sequence[np.ndarray]
        For each marker its neighbours, the nearest first.
    window : int
        Window of the moving median, samples.
    count : int
        Number of nearest neighbours with which a marker is compared.
    max_ratio : float
        The rise of a marker counts up to this multiple of the median rise of these.

    Returns
    -------
    np.ndarray
        Local scale (frames, markers), mm, NaN where the size is.
    """
    overall = np.array([np.median(own[~np.isnan(own)]) if (~np.isnan(own)).any() else 1.0 for own in size.T])
    overall = np.maximum(overall, 1e-3)
    local = np.stack([moving_median_across_gaps(own, window) for own in size.T], axis=1) / overall
    rise = np.maximum(local, 1.0)
    # Of the neighbours the median counts: a few that are broken must not excuse a marker.
    filled = np.asfortranarray(np.nan_to_num(rise, nan=1.0))
    for m, around in enumerate(neighbours):
        if len(around):
            others = ranks.median([filled[:, other] for other in around[:count]])
            rise[:, m] = np.minimum(rise[:, m], max_ratio * others)
    scale: np.ndarray = rise * overall
    return scale


def low_levels(size: np.ndarray, quantile: float, *, min_level: float) -> np.ndarray:
    """Estimate the usual size of each marker from a low quantile: in a short recording an artifact may last half of the time.

    Parameters
    ----------
    size : np.ndarray
        Sizes (frames, markers), NaN = missing.
    quantile : float
        The quantile (0 to 1).
    min_level : float
        Smallest level, in the unit of the sizes.

    Returns
    -------
    np.ndarray
        Levels (markers,): the quantile, times what the median usually is in units of it.
    """
    low, median = np.full((2, size.shape[1]), min_level)
    seen = ~np.isnan(size).all(axis=0)
    for m in np.flatnonzero(seen).tolist():
        own = size[~np.isnan(size[:, m]), m]
        low[m], median[m] = np.maximum(np.quantile(own, (quantile, 0.5)), min_level)
    # Of a marker that is never seen no median is known.
    levels: np.ndarray = low * (np.median(median[seen] / low[seen]) if seen.any() else 1.0)
    return levels


def fitted_scale(
    size: np.ndarray,
    neighbours: Sequence[np.ndarray],
    motion: np.ndarray,
    *,
    count: int,
    window: int,
    min_scale: float,
) -> np.ndarray:
    """Fit the local scale to the motion of the neighbours and to their own sizes.

    The logarithm of the local root mean square is fitted by a level of each marker and, shared by all, one non-negative
    exponent of each kind of motion and of the median size of the nearest neighbours in units of their own levels.

    Parameters
    ----------
    size : np.ndarray
        Sizes (frames, markers), NaN = missing.
    neighbours : Sequence[np.ndarray]
        For each marker its neighbours, the nearest first.
    motion : np.ndarray
        Kinds of motion (kinds, frames, markers), see `nearest_neighbours.motion`.
    count : int
        Number of nearest neighbours.
    window : int
        Window of the local mean, samples.
    min_scale : float
        Smallest scale, in the unit of the sizes.

    Returns
    -------
    np.ndarray
        Scale (frames, markers), in the unit of the sizes.
    """
    if not size.size:
        return np.full(size.shape, min_scale)
    # One marker after the other, and in place: the scale of a long recording is fitted once for each length of drifts.
    local, level = np.empty(size.shape, order="F"), np.ones(size.shape[1])
    for m, own in enumerate(size.T):
        local[:, m] = np.sqrt(np.maximum(moving_mean(own**2, window), 1e-6))
        known = local[~np.isnan(local[:, m]), m]
        level[m] = np.median(known) if len(known) else 1.0
    local /= level
    scale = fitted_rise(local, neighbours, motion, count=count, window=window)
    scale *= level
    np.maximum(scale, min_scale, out=scale)
    return scale


def fitted_rise(
    relative: np.ndarray, neighbours: Sequence[np.ndarray], motion: np.ndarray, *, count: int, window: int = 1
) -> np.ndarray:
    """Fit how sizes rise above the level of each marker with the motion of the neighbours and with their own rise.

    Parameters
    ----------
    relative : np.ndarray
        Sizes in units of the level of each marker (frames, markers), NaN = missing.
    neighbours : Sequence[np.ndarray]
        For each marker its neighbours, the nearest first.
    motion : np.ndarray
        Kinds of motion (kinds, frames, markers), see `nearest_neighbours.motion`.
    count : int
        Number of nearest neighbours.
    window : int
        Window of the moving mean of the motion, samples; the fit uses two frames of each.

    Returns
    -------
    np.ndarray
        Expected size in units of the level (frames, markers).
    """

    def rise_of(m: int) -> np.ndarray:
        rise: np.ndarray = np.nan_to_num(relative[:, m], nan=1.0)
        return rise

    def regressors(m: int) -> np.ndarray:
        around = neighbours[m][:count]
        common = ranks.median([rise_of(other) for other in around]) if len(around) else np.ones(len(relative))
        logarithms = np.log([common, *(moving_mean(kind[:, m], window) + 1.0 for kind in motion)])
        centred: np.ndarray = (logarithms - np.median(logarithms, axis=1, keepdims=True)).T
        return centred

    some = slice(None, None, max(1, window // 2))
    seen = ~np.isnan(relative[some])
    if not seen.any():
        return np.ones(relative.shape)
    # One marker after the other, and once more: the regressors of all would take several times the memory of the sizes.
    markers = range(relative.shape[1])
    design = np.concatenate([regressors(m)[some][seen[:, m]] for m in markers])
    target = np.concatenate([np.log(relative[some, m][seen[:, m]]) for m in markers])
    exponents = non_negative_least_squares(design, target)
    rise = np.empty(relative.shape)
    for m in markers:
        rise[:, m] = np.exp(regressors(m) @ exponents)
    return rise


def moving_mean(values: np.ndarray, window: int) -> np.ndarray:
    """Take the moving mean of what is known.

    Parameters
    ----------
    values : np.ndarray
        Values (frames, ...), NaN = missing.
    window : int
        Window, samples.

    Returns
    -------
    np.ndarray
        Means (frames, ...); NaN where no value of the window is known.
    """
    known = ~np.isnan(values)
    total = moving.mean(np.where(known, values, 0.0), window)
    share = moving.mean(known.astype(float), window)
    return np.where(share > 0.5 / window, total / np.maximum(share, 0.5 / window), np.nan)
