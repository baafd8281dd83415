"""Distances of markers to others about them, and their usual values: they decide which of two labellings is right."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.prediction.scene import Scene


def markers_around(scene: Scene, markers: Sequence[int], count: int) -> np.ndarray:
    """List the nearest neighbours of some markers.

    Parameters
    ----------
    scene : Scene
        What is observed.
    markers : Sequence[int]
        Indices of the markers.
    count : int
        Number of neighbours of each.

    Returns
    -------
    np.ndarray
        Indices of the neighbours, each once, without the markers themselves.
    """
    nearest = dict.fromkeys(n for m in markers for n in np.asarray(scene.neighbours[m], int)[:count].tolist())
    return np.array([n for n in nearest if n not in markers], int)


def usual_distances(measured: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Estimate the usual values of distances over a recording, and how much they vary.

    Parameters
    ----------
    measured : np.ndarray
        Distances (frames, k, m), mm, NaN = missing.

    Returns
    -------
    usual : np.ndarray
        Medians (k, m), mm; NaN for a distance that is never observed.
    spread : np.ndarray
        Ranges from the 16th to the 84th percentile (k, m), mm; NaN likewise.
    """
    known = ~np.isnan(measured).all(axis=0)
    low, usual, high = np.full((3, *known.shape), np.nan)
    if known.any():
        low[known], usual[known], high[known] = np.nanpercentile(measured[:, known], [16, 50, 84], axis=0)
    return usual, high - low


def length(vectors: np.ndarray) -> np.ndarray:
    """Compute Euclidean lengths.

    Parameters
    ----------
    vectors : np.ndarray
        Vectors (..., axes).

    Returns
    -------
    np.ndarray
        Lengths (...).
    """
    lengths: np.ndarray = np.sqrt(np.einsum("...i,...i->...", vectors, vectors))
    return lengths


def distances(some: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Compute the distances of points from others.

    Parameters
    ----------
    some, others : np.ndarray
        Points (..., n, axes) and (..., m, axes).

    Returns
    -------
    np.ndarray
        Distances (..., n, m).
    """
    return length(some[..., :, None, :] - others[..., None, :, :])
