"""The gap generator of the gap reconstruction paper (skurowski2021, section 3.5, "Gap Generation Procedure").

The paper calls lengths and intervals "a Poisson process". They are read as Poisson counts: with linear interpolation and a mean
length of 10 frames the square of the printed RMSE over all samples is 1.07 to 1.14 times the mean square of the printed errors of
single gaps, at 200 frames 0.99 to 1.01 times (Tables 3 and A1 to A5). On the synthetic walker, Poisson counts give 1.1 to 1.6 at
10 frames and 1.05 at 50; exponential lengths, whose long gaps hold most of the samples, give more than 2 at any mean length.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.core import events
from markermend.core.events import Event

GAPS = 2
"""Gaps in a run of the paper."""

MEAN_LENGTHS = (10, 20, 50, 100, 200)
"""Mean lengths of the gaps of the paper, frames."""

ATTEMPTS = 1000
"""Draws of all gaps, at most, before a recording counts as having no room for them."""


def draw_gaps(
    missing: np.ndarray, markers: Sequence[str], *, mean_length: float, rng: np.random.Generator, count: int = GAPS
) -> list[Event]:
    """Draw the gaps of a run: first when they are, then a random marker for each.

    Gaps alternate with one more interval than there are gaps. Their lengths are Poisson counts with the given mean; those of
    the intervals are Poisson counts with a common mean, which follows from the number of frames, and the last interval is
    the rest. Draws that do not fit are repeated: no gap and no interval is empty, and the marker of a gap is measured
    throughout it and in the frames on either side, so that no gap becomes longer by what is missing already.

    Parameters
    ----------
    missing : ndarray of bool, shape (frames, markers)
        Whether each marker is missing already.
    markers : sequence of str
        Names of the markers.
    mean_length : float
        Mean length of a gap, frames.
    rng : Generator
        Source of randomness.
    count : int
        Number of gaps.

    Returns
    -------
    list of Event
        The gaps in the order of time; no two share a frame.

    Raises
    ------
    ValueError
        If the recording is too short for gaps of that length, or too few markers are measured for so long.

    References
    ----------
    skurowski2021, section 3.5.
    """
    frames = len(missing)
    if mean_length < 1 or count < 1:
        raise ValueError(
            f"gaps need a mean length of at least 1 frame and a number of at least 1: {mean_length}, {count}"
        )
    pause = (frames - count * mean_length) / (count + 1)
    if pause < 1:
        least = int(np.ceil(count * mean_length + count + 1))
        raise ValueError(
            f"{frames} frames are too few for {count} gaps of {mean_length:g} frames on average: {least} are needed at least"
        )
    before = np.pad(np.cumsum(missing, axis=0), ((1, 0), (0, 0)))  # missing samples before each frame
    for _ in range(ATTEMPTS):
        starts, stops = _intervals(mean_length, pause, count, rng)
        if stops[-1] >= frames or (starts == stops).any() or starts[0] == 0 or (starts[1:] == stops[:-1]).any():
            continue
        free = before[stops + 1] == before[starts - 1]  # bool (gaps, markers)
        if free.any(axis=1).all():
            chosen = [int(rng.choice(np.flatnonzero(row))) for row in free]
            spans = zip(chosen, starts.tolist(), stops.tolist(), strict=True)
            return [Event(markers[m], start, stop, 1.0) for m, start, stop in spans]
    raise ValueError(
        f"no room for {count} gaps of {mean_length:g} frames on average in {frames} frames: no marker is measured for so long, "
        f"or too few frames are left between the gaps"
    )


def hide(positions: np.ndarray, markers: Sequence[str], gaps: Sequence[Event]) -> np.ndarray:
    """Remove the samples of gaps.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        Positions in mm; NaN = missing.
    markers : sequence of str
        Names of the markers.
    gaps : sequence of Event
        The gaps.

    Returns
    -------
    ndarray of float, shape (frames, markers, 3)
        A copy with NaN in the gaps.
    """
    hidden = positions.copy()
    hidden[events.mask(gaps, len(positions), markers)] = np.nan
    return hidden


def _intervals(length: float, pause: float, count: int, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Starts and stops (count,) of gaps of a mean length with pauses before each, of which Poisson counts are drawn."""
    pauses, lengths = rng.poisson(pause, count), rng.poisson(length, count)
    stops = np.cumsum(pauses + lengths)
    return stops - lengths, stops
