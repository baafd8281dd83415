"""How constant, near and coherent each pair of markers is: the statistics from which a mesh is inferred."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend.core.recording import Recording

NORMAL_RANGE = 2 * 1.6448536269514722
"""Distance between the 5th and the 95th percentile of a normal distribution, in standard deviations."""

MOST_RANKS = 12
"""Ranks for which rows are partitioned; for more they are sorted."""

DECIMALS = 6
"""Statistics are rounded to nm, so that the order of summation decides no tie."""


@dataclass(frozen=True)
class PairStatistics:
    """Statistics of each pair of markers over all recordings of a subject.

    Attributes
    ----------
    markers : tuple of str
        Names, sorted.
    valid : ndarray of int, shape (markers,)
        Number of sampled frames in which each marker was seen.
    distance, deviation : ndarray, shape (markers, markers)
        Median and robust standard deviation of the distance, mm; NaN where a pair is unknown, 0 on the diagonal.
    coherence : ndarray, shape (markers, markers)
        Correlation of the displacements, -1 to 1; NaN where a pair is unknown, 1 on the diagonal.
    seconds : float
        Duration of all recordings, s.
    """

    markers: tuple[str, ...]
    valid: np.ndarray
    distance: np.ndarray
    deviation: np.ndarray
    coherence: np.ndarray
    seconds: float

    def dissimilarity(self, scale_mm: float) -> np.ndarray:
        """Compute the dissimilarity A = deviation * distance / scale_mm of each pair.

        Parameters
        ----------
        scale_mm : float
            Distance at which the dissimilarity equals the deviation, mm.

        Returns
        -------
        ndarray, shape (markers, markers)
            Dissimilarity, mm: small for markers at a short and constant distance; NaN where a pair is unknown.
        """
        dissimilarity: np.ndarray = np.round(self.deviation * self.distance / scale_mm, DECIMALS)
        return dissimilarity

    def attachment_costs(self, dissimilarity: np.ndarray) -> np.ndarray:
        """Compute the cost A * (2 - coherence) of attaching each marker to each other.

        Parameters
        ----------
        dissimilarity : ndarray, shape (markers, markers)
            Result of `dissimilarity`, mm.

        Returns
        -------
        ndarray, shape (markers, markers)
            Cost of attaching the marker of the row to that of the column, mm; NaN where a pair is unknown.
        """
        costs: np.ndarray = dissimilarity * (2.0 - np.nan_to_num(self.coherence))
        return costs


def thin(recording: Recording, *, frames: int) -> Recording:
    """Keep evenly spaced frames of a recording.

    Parameters
    ----------
    recording : Recording
        The recording; it is not modified.
    frames : int
        Largest number of frames to keep.

    Returns
    -------
    Recording
        At most `frames` frames of the markers at a rate that falls accordingly, so that the duration stays.
    """
    if recording.frames <= frames:
        return replace(recording, unlabelled={})
    rows = (np.arange(frames) * recording.frames) // frames
    rate = recording.rate * frames / recording.frames
    return replace(recording, positions=recording.positions[rows], rate=rate, unlabelled={})


def distance_statistics(positions: np.ndarray, *, valid_frames: int) -> tuple[np.ndarray, np.ndarray]:
    """Compute the median and the robust standard deviation (P95 - P5) / 3.29 of the distance of each pair of markers.

    Parameters
    ----------
    positions : ndarray, shape (frames, markers, 3)
        Positions, mm; NaN = missing.
    valid_frames : int
        Smallest number of frames in which both markers must be seen.

    Returns
    -------
    median, deviation : ndarray, shape (markers, markers)
        Both in mm, NaN where a pair was seen together in too few frames. Percentiles are interpolated linearly.
    """
    frames, markers, _ = positions.shape
    median, deviation = np.full((2, markers, markers), np.nan)
    tracks = np.ascontiguousarray(positions.transpose(2, 1, 0))
    for m in range(markers - 1):  # one marker at a time bounds the memory
        squares = np.square(tracks[:, m + 1 :] - tracks[:, m, None])
        distances = np.sqrt(squares[0] + squares[1] + squares[2])
        joint = frames - np.isnan(distances).sum(axis=1)
        known = joint >= max(valid_frames, 1)
        low, middle, high = percentiles(distances[known], joint[known], (0.05, 0.5, 0.95))
        others = m + 1 + np.flatnonzero(known)
        median[m, others] = median[others, m] = middle
        deviation[m, others] = deviation[others, m] = (high - low) / NORMAL_RANGE
    return median, deviation


def percentiles(values: np.ndarray, count: np.ndarray, shares: Sequence[float]) -> np.ndarray:
    """Compute percentiles of each row, interpolated linearly.

    Parameters
    ----------
    values : ndarray, shape (rows, n)
        Values; NaN = unknown.
    count : ndarray of int, shape (rows,)
        Number of known values in each row, 1 at least.
    shares : sequence of float
        The percentiles, 0 to 1.

    Returns
    -------
    ndarray, shape (shares, rows)
        The percentiles of each row.
    """
    position = np.array(shares)[:, None] * (count - 1)
    lower = np.floor(position).astype(int)
    upper = np.minimum(lower + 1, count - 1)
    # NaN come last. Where all rows have as many values, few ranks have to be in their places.
    ranks = np.unique([lower, upper])
    few = 0 < len(ranks) <= MOST_RANKS
    ordered = np.partition(values, ranks, axis=1) if few else np.sort(values, axis=1)
    row = np.arange(len(values))
    below = ordered[row, lower]
    interpolated: np.ndarray = below + (position - lower) * (ordered[row, upper] - below)
    return interpolated


def displacement_moments(positions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Sum the products of the frame-to-frame displacements of each pair of markers, over all axes.

    Means are taken per axis, which makes the sums independent of the laboratory axes.

    Parameters
    ----------
    positions : ndarray, shape (frames, markers, 3)
        Positions, mm; NaN = missing.

    Returns
    -------
    products : ndarray, shape (markers, markers)
        Sums of products about the joint mean displacement, mm^2.
    squares : ndarray, shape (markers, markers)
        Sums of squares of the row's marker over the frames in which the column's is seen, too, mm^2.
    """
    steps = np.diff(positions, axis=0)
    seen = (~np.isnan(steps).any(axis=2)).astype(float)
    steps = np.where(seen[:, :, None] > 0, steps, 0.0).transpose(2, 1, 0)
    joint = np.maximum(seen.T @ seen, 1.0)
    sums = steps @ seen
    products = ((steps @ steps.transpose(0, 2, 1)) - sums * sums.transpose(0, 2, 1) / joint).sum(axis=0)
    squares = ((np.square(steps) @ seen) - np.square(sums) / joint).sum(axis=0)
    return products, squares


class _Pool:
    """Sums over recordings, matrices (markers, markers) each, from which the statistics of pairs follow."""

    def __init__(self, markers: Sequence[str]) -> None:
        self.markers = tuple(markers)
        self.valid = np.zeros(len(markers), int)
        self.known, self.distance, self.variance, self.products, self.squares = np.zeros((5, *[len(markers)] * 2))
        self._place = {marker: m for m, marker in enumerate(markers)}

    def add(self, sample: Recording, valid_frames: int) -> None:
        """Add a recording, each of whose pairs counts from valid_frames joint frames on."""
        rows = np.array([self._place[marker] for marker in sample.markers], int)
        block = np.ix_(rows, rows)
        self.valid[rows] += (~sample.missing).sum(axis=0)
        median, deviation = distance_statistics(sample.positions, valid_frames=valid_frames)
        self.known[block] += ~np.isnan(median)
        self.distance[block] += np.nan_to_num(median)
        self.variance[block] += np.nan_to_num(np.square(deviation))
        products, squares = displacement_moments(sample.positions)
        self.products[block] += products
        self.squares[block] += squares

    def statistics(self, seconds: float) -> PairStatistics:
        """Means over the recordings in which a pair is known."""
        with np.errstate(invalid="ignore", divide="ignore"):
            distance, deviation = self.distance / self.known, np.sqrt(self.variance / self.known)
            scale = np.sqrt(self.squares * self.squares.T)
            coherence = np.where(scale > 0, np.clip(self.products / scale, -1.0, 1.0), np.nan)
        for matrix, value in ((distance, 0.0), (deviation, 0.0), (coherence, 1.0)):
            np.fill_diagonal(matrix, value)
        coherence[np.isnan(distance)] = np.nan
        return PairStatistics(self.markers, self.valid, distance, deviation, np.round(coherence, DECIMALS), seconds)


def pair_statistics(
    recordings: Sequence[Recording], *, frames: int, valid_frames: int, markers: Sequence[str]
) -> PairStatistics:
    """Pool the statistics of all pairs of markers over recordings.

    Deviations are pooled as root mean square, distances as mean over the recordings in which the pair is known, displacements
    as one sample. The order of the recordings does not matter.

    Parameters
    ----------
    recordings : sequence of Recording
        Recordings, each of which holds some of the markers.
    frames : int
        Each recording is thinned to this number of frames.
    valid_frames : int
        Smallest number of joint frames from which a pair is known in a recording.
    markers : sequence of str
        Names of all markers, sorted.

    Returns
    -------
    PairStatistics
        The statistics; NaN where no recording holds enough joint frames of a pair.
    """
    pool = _Pool(markers)
    for recording in sorted(recordings, key=recording_name):
        pool.add(thin(recording, frames=frames), valid_frames)
    return pool.statistics(sum(recording.frames / recording.rate for recording in recordings))


def recording_name(recording: Recording) -> str:
    """Name a recording.

    Parameters
    ----------
    recording : Recording
        The recording.

    Returns
    -------
    str
        Its name, empty if it has none.
    """
    return str(recording.facts.get("recording", ""))
