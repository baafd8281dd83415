"""How constant, near and coherent each pair of markers is: the numbers that a mesh is inferred from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend.core.recording import Recording

NORMAL_RANGE = 2 * 1.6448536269514722
"""Distance between the 5th and the 95th percentile of a normal distribution, in standard deviations."""

DECIMALS = 6
"""Statistics are rounded to nm, so that the order of summation decides no tie."""


@dataclass(frozen=True)
class PairStatistics:
    """Statistics of each pair of markers over all recordings of a subject.

    markers: sorted names. valid: int (markers,), sampled frames on which each was seen. distance, deviation: float64
    (markers, markers), mm, median and robust standard deviation of the distance. coherence: correlation of the
    displacements, -1 to 1. NaN where a pair is unknown; the diagonal is 0, 0 and 1. seconds: total duration.
    """

    markers: tuple[str, ...]
    valid: np.ndarray
    distance: np.ndarray
    deviation: np.ndarray
    coherence: np.ndarray
    seconds: float

    def dissimilarity(self, scale_mm: float) -> np.ndarray:
        """Give A = deviation * distance / scale_mm, mm (markers, markers): small where near and constant."""
        return np.round(self.deviation * self.distance / scale_mm, DECIMALS)

    def hanging(self, dissimilarity: np.ndarray) -> np.ndarray:
        """Give the cost A * (2 - coherence) of hanging each marker (row) on each other (column), mm; NaN = unknown."""
        return dissimilarity * (2.0 - np.nan_to_num(self.coherence))


def thin(recording: Recording, *, frames: int) -> Recording:
    """Keep at most `frames` evenly spaced frames; the rate falls accordingly, so that the duration stays."""
    if recording.frames <= frames:
        return recording
    rows = (np.arange(frames) * recording.frames) // frames
    return replace(recording, positions=recording.positions[rows], rate=recording.rate * frames / recording.frames)


def distance_statistics(positions: np.ndarray, *, valid_frames: int) -> tuple[np.ndarray, np.ndarray]:
    """Median and robust standard deviation (P95 - P5) / 3.29 of the distance of each pair of markers.

    positions: (frames, markers, 3), mm, NaN = missing. Returns two arrays (markers, markers), mm, NaN where a pair was
    jointly seen on fewer than valid_frames frames. Percentiles interpolate linearly.
    """
    frames, markers, _ = positions.shape
    median, deviation = np.full((2, markers, markers), np.nan)
    tracks = np.ascontiguousarray(positions.transpose(2, 1, 0))
    for m in range(markers - 1):  # one marker at a time bounds the memory
        squares = np.square(tracks[:, m + 1 :] - tracks[:, m, None])
        distances = np.sort(np.sqrt(squares[0] + squares[1] + squares[2]), axis=1)
        joint = frames - np.isnan(distances).sum(axis=1)
        known = joint >= max(valid_frames, 1)
        low, middle, high = (percentile(distances[known], joint[known], share) for share in (0.05, 0.5, 0.95))
        others = m + 1 + np.flatnonzero(known)
        median[m, others] = median[others, m] = middle
        deviation[m, others] = deviation[others, m] = (high - low) / NORMAL_RANGE
    return median, deviation


def percentile(ordered: np.ndarray, count: np.ndarray, share: float) -> np.ndarray:
    """Percentile of the first `count` values of each row of `ordered` (ascending), interpolated linearly."""
    position = share * (count - 1)
    lower = np.floor(position).astype(int)
    upper = np.minimum(lower + 1, count - 1)
    row = np.arange(len(ordered))
    below = ordered[row, lower]
    return below + (position - lower) * (ordered[row, upper] - below)


def displacement_moments(positions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Joint covariance sums of the frame-to-frame displacements of each pair of markers, all axes together.

    positions: (frames, markers, 3), mm, NaN = missing. Returns two arrays (markers, markers), mm^2: sums of products
    about the joint mean displacement, and sums of squares of the row's marker over the frames seen jointly with the
    column's. Means are taken per axis, which makes the sums independent of the laboratory axes.
    """
    steps = np.diff(positions, axis=0)
    seen = (~np.isnan(steps).any(axis=2)).astype(float)
    steps = np.where(seen[:, :, None] > 0, steps, 0.0).transpose(2, 1, 0)
    joint = np.maximum(seen.T @ seen, 1.0)
    sums = steps @ seen
    products = ((steps @ steps.transpose(0, 2, 1)) - sums * sums.transpose(0, 2, 1) / joint).sum(axis=0)
    squares = ((np.square(steps) @ seen) - np.square(sums) / joint).sum(axis=0)
    return products, squares


def pair_statistics(
    recordings: Sequence[Recording], *, frames: int, valid_frames: int, markers: Sequence[str]
) -> PairStatistics:
    """Pool the statistics of all pairs of `markers` over recordings, each of which holds some of them.

    Each recording is thinned to `frames`; a pair is known in it from valid_frames joint frames on. Deviations are
    pooled as root mean square, distances as mean over the recordings that know the pair, displacements as one sample.
    """
    place = {marker: m for m, marker in enumerate(markers)}
    shape = (len(markers), len(markers))
    known, distance, variance, products, squares = np.zeros((5, *shape))
    valid = np.zeros(len(markers), int)
    for recording in sorted(recordings, key=name):
        sample = thin(recording, frames=frames)
        rows = np.array([place[marker] for marker in sample.markers], int)
        block = np.ix_(rows, rows)
        valid[rows] += (~sample.missing).sum(axis=0)
        median, deviation = distance_statistics(sample.positions, valid_frames=valid_frames)
        known[block] += ~np.isnan(median)
        distance[block] += np.nan_to_num(median)
        variance[block] += np.nan_to_num(np.square(deviation))
        moments = displacement_moments(sample.positions)
        products[block] += moments[0]
        squares[block] += moments[1]
    with np.errstate(invalid="ignore", divide="ignore"):
        distance, deviation = distance / known, np.sqrt(variance / known)
        scale = np.sqrt(squares * squares.T)
        coherence = np.where(scale > 0, np.clip(products / scale, -1.0, 1.0), np.nan)
    for matrix, value in ((distance, 0.0), (deviation, 0.0), (coherence, 1.0)):
        np.fill_diagonal(matrix, value)
    coherence[np.isnan(distance)] = np.nan
    seconds = sum(recording.frames / recording.rate for recording in recordings)
    return PairStatistics(tuple(markers), valid, distance, deviation, np.round(coherence, DECIMALS), seconds)


def name(recording: Recording) -> str:
    """The recording's name, empty if it has none."""
    return recording.facts.get("recording", "")
