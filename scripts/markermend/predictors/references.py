"""References of a marker: the markers whose distance to it varies least (tits2018 eq 1)."""

from __future__ import annotations

import numpy as np

from markermend.predictors import Scene


def thinned(frames: np.ndarray, most: int) -> np.ndarray:
    """At most `most` of the frames, evenly spaced."""
    if len(frames) <= most:
        return frames
    return frames[np.unique(np.linspace(0, len(frames) - 1, most).astype(int))]


def references(scene: Scene, marker: int, *, frames: int, minimum_frames: int) -> tuple[np.ndarray, np.ndarray]:
    """Rank a marker's neighbours by the standard deviation of their distance to it; source: tits2018 eq 1.

    Returns indices (k,) and deviations (k,), mm, ascending. At most `frames` frames are looked at; neighbours seen
    together with the marker on fewer than `minimum_frames` of all are left out.
    """
    near = np.asarray(scene.neighbours[marker], int)
    seen = scene.present[:, marker]
    joint = np.count_nonzero(scene.present[:, near] & seen[:, None], axis=0)
    near = near[joint >= minimum_frames]
    if len(near) == 0:
        return near, np.zeros(0)
    rows = thinned(np.flatnonzero(seen), frames)
    distance = np.linalg.norm(scene.positions[np.ix_(rows, near)] - scene.positions[rows, marker][:, None], axis=2)
    known = ~np.isnan(distance)
    count = np.maximum(known.sum(axis=0), 1)
    mean = np.where(known, distance, 0).sum(axis=0) / count
    deviation = np.sqrt((np.where(known, distance - mean, 0) ** 2).sum(axis=0) / count)
    deviation[known.sum(axis=0) < 2] = np.inf
    order = np.argsort(deviation, kind="stable")
    order = order[np.isfinite(deviation[order])]
    return near[order], deviation[order]
