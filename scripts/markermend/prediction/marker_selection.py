"""Choice of frames and of markers to learn from: subsets of frames, reference markers, jointly observed markers."""

from __future__ import annotations

from functools import partial

import numpy as np

from markermend.numerics.distances import distances
from markermend.prediction.scene import Scene

GOLDEN_RATIO = np.uint64(0x9E3779B97F4A7C15)
"""The fractional part of the golden ratio, in units of 2^-64."""


def evenly_spaced(frames: np.ndarray, count: int) -> np.ndarray:
    """Take evenly spaced frames.

    Parameters
    ----------
    frames : np.ndarray
        Frames (n,).
    count : int
        Largest number of frames to take.

    Returns
    -------
    np.ndarray
        The chosen frames, in their order; all if there are no more than `count`.
    """
    if len(frames) <= count:
        return frames
    chosen: np.ndarray = frames[np.unique(np.linspace(0, len(frames) - 1, count).astype(int))]
    return chosen


def pseudo_random_subset(frames: np.ndarray, count: int) -> np.ndarray:
    """Take frames of even density at irregular distances, so that pairs of them lie at every lag.

    A frame's rank is the fractional part of the golden ratio times its square (in 64-bit integers, which wrap), so the
    choice depends on nothing but the frames.

    Parameters
    ----------
    frames : np.ndarray
        Frames (n,), ascending.
    count : int
        Largest number of frames to take.

    Returns
    -------
    np.ndarray
        The chosen frames, ascending; all if there are no more than `count`.
    """
    if len(frames) <= count:
        return frames
    rank = frames.astype(np.uint64) ** 2 * GOLDEN_RATIO
    chosen: np.ndarray = frames[np.sort(np.argpartition(rank, count)[:count])]
    return chosen


def reference_markers(scene: Scene, marker: int, *, max_frames: int, min_frames: int) -> tuple[np.ndarray, np.ndarray]:
    """Rank a marker's neighbours by the standard deviation of their distance to it.

    Parameters
    ----------
    scene : Scene
        What is observed.
    marker : int
        Index of the marker.
    max_frames : int
        Largest number of frames from which deviations are estimated.
    min_frames : int
        Neighbours observed together with the marker in fewer frames are left out.

    Returns
    -------
    markers : np.ndarray
        Indices of neighbours (k,), the steadiest distance first.
    deviations : np.ndarray
        Standard deviations of their distances (k,), mm, ascending.

    References
    ----------
    tits2018 eq 1.
    """
    key = "reference markers", marker, max_frames, min_frames
    return scene.cached(key, partial(_rank_by_deviation, scene, marker, max_frames, min_frames))


def _rank_by_deviation(scene: Scene, marker: int, max_frames: int, min_frames: int) -> tuple[np.ndarray, np.ndarray]:
    """See reference_markers."""
    near = np.asarray(scene.neighbours[marker], int)
    observed = scene.present[:, marker]
    joint = np.count_nonzero(scene.present[:, near] & observed[:, None], axis=0)
    near = near[joint >= min_frames]
    if len(near) == 0:
        return near, np.zeros(0)
    rows = evenly_spaced(np.flatnonzero(observed), max_frames)
    distance = distances(scene.positions[rows, marker], scene.positions[np.ix_(rows, near)])
    known = ~np.isnan(distance)
    count = np.maximum(known.sum(axis=0), 1)
    mean = np.where(known, distance, 0).sum(axis=0) / count
    deviation = np.sqrt((np.where(known, distance - mean, 0) ** 2).sum(axis=0) / count)
    deviation[known.sum(axis=0) < 2] = np.inf
    order = np.argsort(deviation, kind="stable")
    order = order[np.isfinite(deviation[order])]
    return near[order], deviation[order]


def jointly_observed(
    scene: Scene, marker: int, ranked: np.ndarray, *, min_share: float, min_frames: int
) -> tuple[np.ndarray, np.ndarray]:
    """Choose markers that are observed together with a marker in enough frames to learn from.

    The candidates are tried in their order. One is left out if, with it, too few frames would show all chosen markers.

    Parameters
    ----------
    scene : Scene
        What is observed.
    marker : int
        Index of the marker.
    ranked : np.ndarray
        Indices of candidates (n,), the best first.
    min_share : float
        Least share of the marker's frames that shows all chosen markers.
    min_frames : int
        Least number of such frames.

    Returns
    -------
    markers : np.ndarray
        Indices of the chosen candidates (k,), in their order; none where the marker is observed too rarely.
    frames : np.ndarray
        The frames, ascending, that show the marker and all chosen ones; none likewise.
    """
    joint = scene.present[:, marker].copy()
    required = max(min_frames, int(np.ceil(min_share * np.count_nonzero(joint))))
    if np.count_nonzero(joint) < min_frames:
        return np.zeros(0, int), np.zeros(0, int)
    chosen = []
    for candidate in np.asarray(ranked, int).tolist():
        together = joint & scene.present[:, candidate]
        if np.count_nonzero(together) >= required:
            chosen.append(candidate)
            joint = together
    return np.array(chosen, int), np.flatnonzero(joint)
