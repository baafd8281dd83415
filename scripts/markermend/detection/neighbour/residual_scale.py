"""How large should a finding be expected to be, going by what the body is doing?

Soft tissue and joints leave more of a marker unexplained when the body moves fast, or when everything about the marker
fits badly: then the level that counts as usual rises with it.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy import ndimage

from markermend.numerics.robust import moving_median_across_gaps


def usual_size(
    size: np.ndarray, neighbours: Sequence[np.ndarray], *, window: int, near: int, ratio: float
) -> np.ndarray:
    """The usual size of something about each frame, (frames, markers): never below the marker's median.

    It follows what the body is doing: where the moving median of the marker's sizes grows, so does it, but no more than
    `ratio` times as much as the median of its `near` nearest neighbours' does. size: NaN = missing, and so is the
    result.
    """
    overall = np.array([np.median(own[~np.isnan(own)]) if (~np.isnan(own)).any() else 1.0 for own in size.T])
    overall = np.maximum(overall, 1e-3)
    local = np.stack([moving_median_across_gaps(own, window) for own in size.T], axis=1) / overall
    livelier = np.maximum(local, 1.0)
    filled = np.nan_to_num(livelier, nan=1.0)
    for m, around in enumerate(neighbours):
        if len(around):
            others = np.median(filled[:, np.asarray(around, int)[:near]], axis=1)
            livelier[:, m] = np.minimum(livelier[:, m], ratio * others)
    return livelier * overall


COMPANY = 0.5
"""The quantile of the neighbours that tells how badly they fit: one that is broken, or a few, must not excuse a marker."""


def motion(
    positions: np.ndarray, neighbours: Sequence[np.ndarray], *, rate: float, near: int, smooth: int
) -> np.ndarray:
    """How a marker's `near` nearest neighbours move: (2, frames, markers), speed about their mean, mm/s, and acceleration, mm/s^2.

    The marker's own course does not count. positions: NaN = missing; neighbours that are missing do not count, and 0
    where none is seen. smooth: over so many samples.
    """
    if len(positions) < 2:
        return np.zeros((2, *positions.shape[:2]))
    smoothed = mean_over(positions, smooth)
    velocity = np.gradient(smoothed, axis=0) * rate
    acceleration = np.gradient(velocity, axis=0) * rate
    out = np.zeros((2, *positions.shape[:2]))
    for m, around in enumerate(neighbours):
        some = np.asarray(around, int)[:near]
        if len(some):
            about_mean = velocity[:, some] - _mean(velocity[:, some])[:, None]
            out[0, :, m] = np.sqrt(_mean((about_mean**2).sum(axis=2)))
            out[1, :, m] = np.sqrt(_mean((acceleration[:, some] ** 2).sum(axis=2)))
    return out


def expected(
    size: np.ndarray, neighbours: Sequence[np.ndarray], moving: np.ndarray, *, near: int, window: int, least: float
) -> np.ndarray:
    """The size to expect (frames, markers) of what is measured of each marker.

    size: (frames, markers), NaN = missing. moving: (kinds, frames, markers), from `motion`. Fitted is the logarithm of
    the local root mean square over `window` samples: a level for each marker, and shared by all of them one exponent,
    not negative, for each kind of motion and for the median of the `near` nearest neighbours, each in units of its own
    level. least: below this nothing is expected to be.
    """
    from scipy.optimize import nnls  # slow to import

    local = np.sqrt(np.maximum(mean_over(size**2, window), 1e-6))
    level = np.array([np.median(known) if len(known) else 1.0 for known in (own[~np.isnan(own)] for own in local.T)])
    relative = np.nan_to_num(local / level, nan=1.0)
    kinds = [np.ones(size.shape), *(mean_over(kind, window) + 1.0 for kind in moving)]
    for m, around in enumerate(neighbours):
        if len(around):
            kinds[0][:, m] = np.quantile(relative[:, np.asarray(around, int)[:near]], COMPANY, axis=1)
    explaining = np.stack([np.log(kind) - np.median(np.log(kind), axis=0) for kind in kinds], axis=2)
    some = slice(None, None, max(1, window // 2))
    seen = ~np.isnan(local[some])
    exponents, _ = nnls(explaining[some][seen], np.log(relative[some][seen])) if seen.any() else (np.zeros(3), 0)
    return np.maximum(level * np.exp(explaining @ exponents), least)


def mean_over(values: np.ndarray, window: int) -> np.ndarray:
    """Moving mean along the first axis over what is not NaN; NaN where nothing is."""
    known = ~np.isnan(values)
    total = ndimage.uniform_filter1d(np.where(known, values, 0.0), window, axis=0)
    share = ndimage.uniform_filter1d(known.astype(float), window, axis=0)
    return np.where(share > 0.5 / window, total / np.maximum(share, 0.5 / window), np.nan)


def _mean(values: np.ndarray) -> np.ndarray:
    """Mean along the second axis over what is not NaN; 0 where nothing is."""
    known = ~np.isnan(values)
    return np.where(known, values, 0.0).sum(axis=1) / np.maximum(known.sum(axis=1), 1)
