"""References of a marker: whose distance to it varies least (tits2018 eq 1), and who can be used together."""

from __future__ import annotations

from functools import partial

import numpy as np

from markermend.prediction.scene import Scene


def evenly_spaced(frames: np.ndarray, most: int) -> np.ndarray:
    """At most `most` of the frames, evenly spaced."""
    if len(frames) <= most:
        return frames
    return frames[np.unique(np.linspace(0, len(frames) - 1, most).astype(int))]


def pseudo_random_subset(frames: np.ndarray, most: int) -> np.ndarray:
    """At most `most` of the frames, spread evenly but at irregular distances, so that some pairs are at every lag.

    Taken are the first by the fractional part of the golden ratio times the frame squared, which is as irregular as
    chance (to 64 bits, by integers that wrap).
    """
    if len(frames) <= most:
        return frames
    drawn = frames.astype(np.uint64) ** 2 * np.uint64(0x9E3779B97F4A7C15)
    return frames[np.sort(np.argpartition(drawn, most)[:most])]


def reference_markers(scene: Scene, marker: int, *, frames: int, minimum_frames: int) -> tuple[np.ndarray, np.ndarray]:
    """Rank a marker's neighbours by the standard deviation of their distance to it; source: tits2018 eq 1.

    Returns indices (k,) and deviations (k,), mm, ascending. At most `frames` frames are looked at; neighbours seen
    together with the marker on fewer than `minimum_frames` of all are left out.
    """
    key = "references", marker, frames, minimum_frames
    return scene.cached(key, partial(_ranked, scene, marker, frames, minimum_frames))


def _ranked(scene: Scene, marker: int, frames: int, minimum_frames: int) -> tuple[np.ndarray, np.ndarray]:
    """See references."""
    near = np.asarray(scene.neighbours[marker], int)
    seen = scene.present[:, marker]
    joint = np.count_nonzero(scene.present[:, near] & seen[:, None], axis=0)
    near = near[joint >= minimum_frames]
    if len(near) == 0:
        return near, np.zeros(0)
    rows = evenly_spaced(np.flatnonzero(seen), frames)
    distance = np.linalg.norm(scene.positions[np.ix_(rows, near)] - scene.positions[rows, marker][:, None], axis=2)
    known = ~np.isnan(distance)
    count = np.maximum(known.sum(axis=0), 1)
    mean = np.where(known, distance, 0).sum(axis=0) / count
    deviation = np.sqrt((np.where(known, distance - mean, 0) ** 2).sum(axis=0) / count)
    deviation[known.sum(axis=0) < 2] = np.inf
    order = np.argsort(deviation, kind="stable")
    order = order[np.isfinite(deviation[order])]
    return near[order], deviation[order]


def jointly_observed(
    scene: Scene, marker: int, ranked: np.ndarray, *, share: float, minimum_frames: int
) -> tuple[np.ndarray, np.ndarray]:
    """Of the ranked markers, in their order, those with which enough joint frames remain to learn from.

    A marker is passed over if with it fewer than `share` of the frames that show `marker`, or fewer than
    `minimum_frames`, would show all chosen ones. Returns indices (k,) and the joint frames, ascending; both empty where
    the marker itself is seen too rarely.
    """
    joint = scene.present[:, marker].copy()
    enough = max(minimum_frames, int(np.ceil(share * np.count_nonzero(joint))))
    if np.count_nonzero(joint) < minimum_frames:
        return np.zeros(0, int), np.zeros(0, int)
    chosen = []
    for other in np.asarray(ranked, int).tolist():
        together = joint & scene.present[:, other]
        if np.count_nonzero(together) >= enough:
            chosen.append(other)
            joint = together
    return np.array(chosen, int), np.flatnonzero(joint)
