"""What the nearest neighbours of each marker do, whatever its own trajectory is: how they move, and whether they are seen."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.detection.neighbour.residual_scale import moving_mean

BLOCK_FRAMES = 10_000
"""Frames of which means are taken at once: more only take more memory."""


def motion(
    positions: np.ndarray, neighbours: Sequence[np.ndarray], *, rate: float, count: int, smoothing: int
) -> np.ndarray:
    """Measure how the nearest neighbours of each marker move; its own trajectory does not count.

    Parameters
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing: such neighbours do not count.
    neighbours : Sequence[np.ndarray]
        For each marker its neighbours, the nearest first.
    rate : float
        Sampling rate, Hz.
    count : int
        Number of nearest neighbours.
    smoothing : int
        Window of the moving mean of the positions, samples.

    Returns
    -------
    np.ndarray
        Root mean square speed about their mean velocity, mm/s, and acceleration, mm/s^2, (2, frames, markers); 0 where no
        neighbour is observed.
    """
    if len(positions) < 2:
        return np.zeros((2, *positions.shape[:2]))
    # Column m selects the neighbours of marker m: all means are products of matrices.
    nearest = np.zeros((len(neighbours), len(neighbours)))
    for m, around in enumerate(neighbours):
        nearest[np.asarray(around, int)[:count], m] = 1.0
    # One axis after the other, and one marker: of all at once each array would be as large as the recording.
    velocity = np.empty(positions.shape[:2])
    square, of_mean, changing = np.zeros((3, *positions.shape[:2]))
    for axis in range(positions.shape[2]):
        for m in range(positions.shape[1]):
            own = np.gradient(moving_mean(positions[:, m, axis], smoothing)) * rate
            velocity[:, m] = own
            square[:, m] += own**2
            changing[:, m] += (np.gradient(own) * rate) ** 2
        of_mean += _mean(velocity, nearest) ** 2
    found = np.empty((2, *positions.shape[:2]))
    found[0] = np.maximum(_mean(square, nearest) - of_mean, 0.0)
    found[1] = _mean(changing, nearest)
    return np.sqrt(found, out=found)


def maximum(size: np.ndarray, neighbours: Sequence[np.ndarray], count: int) -> np.ndarray:
    """Take the maximum over the nearest neighbours that are seen: with one that moves alike a marker does not shake alone.

    Parameters
    ----------
    size : np.ndarray
        Sizes (frames, markers), NaN = missing.
    neighbours : Sequence[np.ndarray]
        For each marker its neighbours, the nearest first.
    count : int
        Number of nearest neighbours among those that are seen in a frame.

    Returns
    -------
    np.ndarray
        The maximum (frames, markers), 0 where no neighbour is seen.
    """
    largest, seen = np.zeros_like(size), ~np.isnan(size)
    for m, around in enumerate(neighbours):
        if len(around):
            ranked = np.asarray(around, int)
            nearest = seen[:, ranked] & (np.cumsum(seen[:, ranked], axis=1) <= count)
            largest[:, m] = np.where(nearest, size[:, ranked], 0.0).max(axis=1)
    return largest


def seen_share(present: np.ndarray, neighbours: Sequence[np.ndarray], count: int) -> np.ndarray:
    """Compute which share of the nearest neighbours of each marker is seen: without them its residual is larger than usual.

    Parameters
    ----------
    present : np.ndarray
        Which markers are seen, bool (frames, markers).
    neighbours : Sequence[np.ndarray]
        For each marker its neighbours, the nearest first.
    count : int
        Number of nearest neighbours.

    Returns
    -------
    np.ndarray
        Shares (frames, markers), 0 to 1; 0 for a marker without neighbours.
    """
    share = np.zeros(present.shape)
    for m, around in enumerate(neighbours):
        if len(around):
            share[:, m] = present[:, np.asarray(around, int)[:count]].mean(axis=1)
    return share


def _mean(values: np.ndarray, nearest: np.ndarray) -> np.ndarray:
    """Mean (frames, markers) of what is not NaN of values (frames, markers) over the markers that each column selects; 0 where nothing is."""
    means = np.empty(values.shape)
    for block in np.array_split(np.arange(len(values)), max(1, len(values) // BLOCK_FRAMES)):
        known = ~np.isnan(values[block])
        total = np.where(known, values[block], 0.0) @ nearest
        means[block] = total / np.maximum(known.astype(float) @ nearest, 1)
    return means
