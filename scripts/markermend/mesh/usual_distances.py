"""The usual distances of a subject's markers, over all of its recordings, so that faults of a recording do not decide."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.core.recording import Recording
from markermend.mesh.pair_statistics import distance_statistics, percentiles, recording_name, thin

DECIMALS = 2
"""Distances are rounded to 0.01 mm."""

MAD_SIGMA = 1.4826022185056018
"""Standard deviation of a normal distribution, in median absolute deviations."""


def usual_distances(
    recordings: Sequence[Recording],
    *,
    markers: Sequence[str],
    frames: int,
    min_frames: int,
    static_weight: float,
    min_spread_mm: float,
) -> dict[str, dict[str, tuple[float, float, float]]]:
    """Estimate the usual distance of each pair of markers, its robust deviation and its spread.

    Each is a weighted median over the recordings. A recording whose distance varies more than in most weighs less, in
    proportion: labels may be exchanged in a part of it. Static recordings weigh more and have no part in how much a
    distance varies, unless there are no others; how much the recordings differ has.

    Parameters
    ----------
    recordings : sequence of Recording
        All recordings of the subject; their order does not matter.
    markers : sequence of str
        Names of all markers, sorted.
    frames : int
        Each recording is thinned to this number of frames.
    min_frames : int
        Smallest number of joint frames from which a pair is known in a recording.
    static_weight : float
        Weight of a static recording.
    min_spread_mm : float
        A spread below this is as good as this, mm.

    Returns
    -------
    dict
        For each marker, by the name of each later one with which it was seen: usual distance, deviation, spread, mm.
    """
    ordered = sorted(recordings, key=recording_name)
    static = np.array([recording.facts.get("kind") == "static" for recording in ordered])
    pooled = np.full((3, len(ordered), len(markers), len(markers)), np.nan)
    for r, recording in enumerate(ordered):
        place = np.array([markers.index(marker) for marker in recording.markers], int)
        own = recording_distances(thin(recording, frames=frames).positions, min_frames=min_frames)
        pooled[:, r, place[:, None], place] = own
    first, second = np.triu_indices(len(markers), 1)
    usual = pool_distances(
        pooled[..., first, second], static=static, static_weight=static_weight, min_spread_mm=min_spread_mm
    )
    named: dict[str, dict[str, tuple[float, float, float]]] = {}
    rounded = np.round(usual, DECIMALS).T.tolist()
    for a, b, (median, deviation, spread) in zip(first.tolist(), second.tolist(), rounded, strict=True):
        if not np.isnan(median):
            named.setdefault(markers[a], {})[markers[b]] = (median, deviation, spread)
    return named


def recording_distances(positions: np.ndarray, *, min_frames: int) -> np.ndarray:
    """Compute the distance of each pair of markers in one recording, its robust deviation and its spread.

    Parameters
    ----------
    positions : ndarray, shape (frames, markers, 3)
        Positions, mm; NaN = missing.
    min_frames : int
        Smallest number of frames in which both markers must be seen.

    Returns
    -------
    ndarray, shape (3, markers, markers)
        Median, standard deviation by the median absolute deviation, and by the 5th and the 95th percentile, mm; NaN where a
        pair was seen together in too few frames.
    """
    median, spread = distance_statistics(positions, valid_frames=min_frames)
    deviation = np.full_like(median, np.nan)
    tracks = np.ascontiguousarray(positions.transpose(2, 1, 0))
    for m in range(len(median) - 1):  # one marker at a time bounds the memory
        distance = np.sqrt(np.square(tracks[:, m + 1 :] - tracks[:, m, None]).sum(axis=0))
        absolute = np.abs(distance - median[m, m + 1 :, None])
        joint = np.count_nonzero(~np.isnan(absolute), axis=1)
        known = joint > 0
        others = m + 1 + np.flatnonzero(known)
        (middle,) = percentiles(absolute[known], joint[known], (0.5,))
        deviation[m, others] = deviation[others, m] = MAD_SIGMA * middle
    return np.stack([median, deviation, spread])


def pool_distances(pooled: np.ndarray, *, static: np.ndarray, static_weight: float, min_spread_mm: float) -> np.ndarray:
    """Pool the distances of pairs over recordings.

    Parameters
    ----------
    pooled : ndarray, shape (3, recordings, pairs)
        Distance, deviation and spread of each pair in each recording, mm; NaN where unknown.
    static : ndarray of bool, shape (recordings,)
        Which recordings are static.
    static_weight : float
        Weight of a static recording.
    min_spread_mm : float
        A spread below this is as good as this, mm.

    Returns
    -------
    ndarray, shape (3, pairs)
        Pooled distance, deviation and spread, mm; NaN where no recording knows the pair.
    """
    distance, deviation, spread = pooled
    spread_or_least = np.maximum(spread, min_spread_mm)
    typical = weighted_median(spread_or_least, np.where(np.isnan(spread), 0.0, 1.0))
    with np.errstate(invalid="ignore"):
        weight = (
            np.nan_to_num(np.minimum(1.0, typical / spread_or_least)) * np.where(static, static_weight, 1.0)[:, None]
        )
    usual = weighted_median(distance, weight)
    varying = np.where(static[:, None] & ~np.isnan(distance[~static]).all(axis=0), 0.0, weight)
    between = MAD_SIGMA * weighted_median(np.abs(distance - usual), varying)
    return np.stack([usual, *(np.hypot(weighted_median(own, varying), between) for own in (deviation, spread))])


def weighted_median(values: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Compute the lower weighted median of each column.

    Parameters
    ----------
    values : ndarray, shape (n, columns)
        Values; NaN where weights are 0.
    weights : ndarray, shape (n, columns)
        Weights, not negative.

    Returns
    -------
    ndarray, shape (columns,)
        In each column the least value up to which the weights make half of the total; NaN where all weights are 0.
    """
    order = np.argsort(np.where(weights > 0, values, np.inf), axis=0, kind="stable")
    cumulative = np.cumsum(np.take_along_axis(weights, order, axis=0), axis=0)
    row = np.argmax(cumulative >= cumulative[-1:] / 2, axis=0)
    chosen = np.take_along_axis(order, row[None], axis=0)
    median: np.ndarray = np.take_along_axis(values, chosen, axis=0)[0]
    return np.where(cumulative[-1] > 0, median, np.nan)
