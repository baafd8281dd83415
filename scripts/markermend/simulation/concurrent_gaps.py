"""The gap generator of the model averaging paper (tits2018, section Experiments): concurrent gaps, and fragments of recordings."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.core.events import Event
from markermend.numerics.intervals import samples


def draw_concurrent_gaps(
    missing: np.ndarray, markers: Sequence[str], *, count: int, length: int, rng: np.random.Generator
) -> list[Event]:
    """Draw gaps of one length that begin at the same random frame, on different random markers.

    Frames and markers are drawn uniformly among the frames at which enough markers are measured throughout the gap. The gaps may lie
    at the ends of the recording, as in the released program.

    Parameters
    ----------
    missing : ndarray of bool, shape (frames, markers)
        Whether each marker is missing already.
    markers : sequence of str
        Names of the markers.
    count : int
        Number of gaps.
    length : int
        Their length, frames.
    rng : Generator
        Source of randomness.

    Returns
    -------
    list of Event
        The gaps, in the order of the markers.

    Raises
    ------
    ValueError
        If nowhere as many markers are measured for so long, or a number is less than 1.

    References
    ----------
    tits2018, section Experiments.
    """
    if count < 1 or length < 1:
        raise ValueError(f"gaps need a number and a length of at least 1: {count}, {length}")
    frames = len(missing)
    before = np.pad(np.cumsum(missing, axis=0), ((1, 0), (0, 0)))  # missing samples before each frame
    starts = np.arange(max(frames - length + 1, 0))
    free = before[starts + length] == before[starts]  # bool (starts, markers)
    possible = starts[free.sum(axis=1) >= count]
    if len(possible) == 0:
        raise ValueError(
            f"no room for {count} gaps of {length} frames at once in {frames} frames of {len(markers)} markers"
        )
    start = int(rng.choice(possible))
    chosen = np.sort(rng.choice(np.flatnonzero(free[start]), count, replace=False))
    return [Event(markers[m], start, start + length, 1.0) for m in chosen.tolist()]


def draw_fragment(frames: int, *, duration_s: float, rate: float, rng: np.random.Generator) -> tuple[int, int]:
    """Draw a fragment of a recording.

    Parameters
    ----------
    frames : int
        Number of frames of the recording.
    duration_s : float
        Duration of the fragment, s.
    rate : float
        Sampling rate, Hz.
    rng : Generator
        Source of randomness.

    Returns
    -------
    start, stop : int
        The fragment, [start, stop); all of a recording that is not longer than it.

    References
    ----------
    tits2018, Figure 5.
    """
    length = min(samples(duration_s, rate), frames)
    start = int(rng.integers(frames - length + 1))
    return start, start + length
