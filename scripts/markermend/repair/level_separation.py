"""Flicker between two levels: samples at the wrong one are moved back by the jumps between them, the others stay as measured."""

from __future__ import annotations

import numpy as np

from markermend.numerics import moving
from markermend.numerics.intervals import runs
from markermend.options.repair import SeparationOptions
from markermend.repair.methods import Proposal

ESTIMATION_ROUNDS = 3
"""Rounds in which the jumps between the levels and their size are estimated in turn."""


def separate_levels(
    measured: np.ndarray, expected: np.ndarray, *, outside: tuple[bool, bool], options: SeparationOptions
) -> Proposal | None:
    """Propose the samples of a marker that flickers between its place and another one at a constant distance.

    The jumps are taken from what the prediction by the neighbours leaves from frame to frame, where its slow error cancels.

    Parameters
    ----------
    measured : ndarray of float, shape (n + 2, 3)
        The samples as measured, with one on either side of the finding, mm; NaN = missing.
    expected : ndarray of float, shape (n + 2, 3)
        The prediction by the neighbours, mm.
    outside : tuple of bool
        Whether the first and the last sample are seen and belong to no finding: there the marker is at its place.
    options : SeparationOptions
        How well two levels must explain the jumps.

    Returns
    -------
    Proposal or None
        The proposal; None where two levels do not explain the samples, or nothing says which level is right.
    """
    first, last = (0 if outside[0] else 1), len(measured) - (0 if outside[1] else 1)
    residual = (measured - expected)[first:last]
    if not any(outside) or np.isnan(residual).any() or len(residual) < 2:
        return None
    changes = np.diff(residual, axis=0)
    jumps, vector, changes = _jumps(changes, options.level_trend_frames)
    distance = float(np.linalg.norm(vector))
    left = changes - jumps[:, None] * vector
    # Jitter to and fro has changes of any size along its direction.
    along = np.sqrt(np.mean((left @ vector) ** 2)) / max(distance, 1e-9)
    level = np.concatenate([[0], np.cumsum(jumps)])
    level -= level.min()
    known = level[[own for own, seen in zip((0, -1), outside, strict=True) if seen]]
    if (
        level.max() != 1
        or len(set(known.tolist())) != 1
        or np.count_nonzero(jumps) < options.min_level_changes
        or max(np.sqrt(np.mean(left**2)), along) > options.max_level_error * distance
    ):
        return None
    sign = 1 if known[0] == 0 else -1
    displacement, error = _displacements(level != known[0], sign * jumps[:, None] * changes, sign * vector)
    own = slice(1 - first, len(measured) - 1 - first)
    return Proposal("separate_levels", (measured[first:last] - displacement)[own], np.full(len(measured) - 2, error))


def _jumps(changes: np.ndarray, window: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The jumps between two levels, -1, 0 or 1 at each of some changes (n, 3), the vector from the one to the other, and the changes
    without their trend, mm: the moving mean of those that are no jumps.
    """
    detrended, trend = changes, np.zeros_like(changes)
    size = np.linalg.norm(changes, axis=1)
    vector = changes[int(np.argsort(size, kind="stable")[-max(1, len(size) // 10)])]
    jumps = np.zeros(len(changes), int)
    for _ in range(ESTIMATION_ROUNDS):
        detrended = changes - trend
        jumps = _alternating(detrended @ vector / max(float(vector @ vector), 1e-12))
        if not jumps.any():
            break
        vector = (jumps[:, None] * detrended).sum(axis=0) / np.count_nonzero(jumps)
        within = (jumps == 0).astype(float)[:, None]
        total, count = (moving.mean(own, window, mode="edge") for own in (within * changes, within))
        trend = total / np.maximum(count, 0.5 / window)
    return jumps, vector, detrended


def _alternating(parts: np.ndarray) -> np.ndarray:
    """The jumps, -1, 0 or 1, by how many times the vector between the levels is in each change: of successive ones of a sign the largest."""
    jumps: np.ndarray = np.clip(np.rint(parts), -1, 1).astype(int)
    frames = np.flatnonzero(jumps)
    if not len(frames):
        return jumps
    # By sign, and within it by size: the last of each is the largest.
    run = np.cumsum(np.diff(jumps[frames], prepend=0) != 0)
    order = np.lexsort((np.abs(parts[frames]), run))
    largest = order[np.append(np.diff(run[order]) != 0, True)]
    single: np.ndarray = np.zeros_like(jumps)
    single[frames[largest]] = jumps[frames[largest]]
    return single


def _displacements(displaced: np.ndarray, jumps: np.ndarray, vector: np.ndarray) -> tuple[np.ndarray, float]:
    """The displacement of samples (n, 3) which of them are displaced, mm, and its standard deviation per axis.

    That of each displaced stretch is the mean of the jumps (n - 1, 3) to it and back, drawn towards the vector common to all by as
    much as the jumps say no more than that (empirical Bayes).
    """
    stretches = [
        (start, stop, jumps[[k - 1 for k in (start, stop) if 0 < k < len(displaced)]])
        for start, stop in runs(displaced)
    ]
    means = np.array([own.mean(axis=0) for _, _, own in stretches])
    pairs = [own for _, _, own in stretches if len(own) == 2]
    single = np.mean([(own[0] - own[1]) ** 2 for own in pairs]) / 2 if pairs else np.mean((means - vector) ** 2)
    each = single / np.array([len(own) for _, _, own in stretches])
    between = max(0.0, float(np.mean((means - vector) ** 2) - each.mean()))
    weight = between / np.maximum(between + each, 1e-12)
    displacement = np.zeros((len(displaced), 3))
    for (start, stop, _), mean, own in zip(stretches, means, weight, strict=True):
        displacement[start:stop] = vector + own * (mean - vector)
    return displacement, float(np.sqrt(np.max(weight * each) + single / max(1, 2 * len(stretches))))
