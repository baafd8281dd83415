"""Samples that a marker reaches and leaves in jumps: far from where it was, they say nothing about the body.

A ghost reflection metres away, or a number such as 9999 that stands for a missing sample, makes every distance of its
marker seem to vary by metres. Such samples are left out before anything is inferred.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from markermend.core.recording import Recording
from markermend.numerics.intervals import runs

FAST_SHARE = 0.9
"""Share of the steps of all markers that are shorter than a fast one."""


def without_displaced_samples(recording: Recording, *, min_jump_mm: float, jump_factor: float) -> Recording:
    """Leave out the samples of each marker that are not on its longest continuous course.

    Parameters
    ----------
    recording : Recording
        The recording at its full rate; it is not modified.
    min_jump_mm : float
        Shortest jump, mm.
    jump_factor : float
        Shortest jump in lengths of a fast step, which 9 of 10 steps of all markers do not exceed.

    Returns
    -------
    Recording
        The recording, NaN where a marker is displaced.
    """
    steps = np.diff(recording.positions, axis=0)
    length = np.sqrt(np.einsum("tmi,tmi->tm", steps, steps))
    known = length[~np.isnan(length)]
    if not known.size:
        return recording
    step_mm = jump_factor * float(np.quantile(known, FAST_SHARE))
    jump_mm = max(min_jump_mm, step_mm)
    jumping = jumps(steps, length > jump_mm, min_jump_mm=jump_mm)
    displaced = np.zeros(recording.missing.shape, bool)
    for m, seen in enumerate(~recording.missing.T):
        parts = [part for run in runs(seen) for part in _split(run, np.flatnonzero(jumping[:, m]) + 1)]
        if len(parts) > 1:
            displaced[:, m] = seen
            for start, stop in longest_course(recording.positions[:, m], parts, jump_mm=jump_mm, step_mm=step_mm):
                displaced[start:stop, m] = False
    if not displaced.any():
        return recording
    return replace(recording, positions=np.where(displaced[..., None], np.nan, recording.positions))


def jumps(steps: np.ndarray, long: np.ndarray, *, min_jump_mm: float) -> np.ndarray:
    """Find the steps that are unlike both the step before and the step after.

    Parameters
    ----------
    steps : ndarray, shape (steps, markers, 3)
        Displacements from each frame to the next, mm; NaN = missing, counts as none.
    long : ndarray of bool, shape (steps, markers)
        The steps in question.
    min_jump_mm : float
        Smallest difference to either step, mm.

    Returns
    -------
    ndarray of bool, shape (steps, markers)
        The jumps.
    """
    jumping = np.zeros_like(long)
    rows, markers = np.nonzero(long)
    own = steps[rows, markers]
    unlike = np.ones(len(rows), bool)
    for other in (rows - 1, rows + 1):
        inside = (other >= 0) & (other < len(steps))
        beside = np.where(inside[:, None], np.nan_to_num(steps[np.where(inside, other, 0), markers]), 0.0)
        unlike &= np.linalg.norm(own - beside, axis=1) > min_jump_mm
    jumping[rows, markers] = unlike
    return jumping


def longest_course(
    trajectory: np.ndarray, parts: Sequence[tuple[int, int]], *, jump_mm: float, step_mm: float
) -> list[tuple[int, int]]:
    """Find the parts of a trajectory that follow each other without a jump and hold most samples.

    Parameters
    ----------
    trajectory : ndarray, shape (frames, 3)
        Positions of the marker, mm.
    parts : sequence of tuple of int
        Half-open intervals in which it is seen and does not jump, ascending.
    jump_mm, step_mm : float
        From the end of a part to the start of a later one the marker moves by at most `jump_mm`, and `step_mm` for each
        frame between them, mm.

    Returns
    -------
    list of tuple of int
        The parts, ascending; of several such courses that which ends first.
    """
    starts, stops = np.array(parts).T
    first, last = trajectory[starts], trajectory[stops - 1]
    best, before = (stops - starts).astype(float), np.full(len(parts), -1)
    for i in range(1, len(parts)):
        allowed = jump_mm + step_mm * (starts[i] - stops[:i] + 1)
        reachable = np.linalg.norm(first[i] - last[:i], axis=1) <= allowed
        if reachable.any():
            before[i] = int(np.argmax(np.where(reachable, best[:i], -1.0)))
            best[i] += best[before[i]]
    course, i = [], int(np.argmax(best))
    while i >= 0:
        course.append(parts[i])
        i = int(before[i])
    return course[::-1]


def _split(run: tuple[int, int], jumping: np.ndarray) -> list[tuple[int, int]]:
    """The parts of an interval between the frames, ascending, to which jumps lead."""
    inside = jumping[(jumping > run[0]) & (jumping < run[1])].tolist()
    return list(zip([run[0], *inside], [*inside, run[1]], strict=True))
