"""The contamination of the artifact detection paper: one coordinate of one marker at a time (skurowski2022, section 4.1.3).

How the text is read follows from the printed errors of the distorted recordings: they are those of a share of the time for
each class, in one coordinate, with peaks of one sample at full height, noise whose standard deviation is the amplitude,
and slow changes that are triangles.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np

from markermend.simulation.artifact_models import Recipe, integers, normal, poisson
from markermend.simulation.contamination import Contamination

CLASSES = ("peaks", "noise", "steps", "slow")
"""The classes of artifacts of the paper."""

AMPLITUDE_DEVIATION = 0.4
"""Standard deviation of an amplitude, as a fraction of its mean: 5 mm with 2, 10 mm with 4."""

MEAN_LENGTH = 50.0
"""Mean length of noise, steps and slow changes, frames."""


def contaminate_coordinates(
    positions: np.ndarray,
    markers: Sequence[str],
    *,
    amplitude: float,
    share: float,
    rng: np.random.Generator,
    kinds: Collection[str] = CLASSES,
) -> Contamination:
    """Distort a share of the time for each class, one coordinate of one marker at a time.

    Noise, steps and slow changes alternate with clean intervals: the starts are a Poisson process, lengths are Poisson counts,
    and the class of each is drawn with equal probabilities. Then frames that are still clean get a peak of one sample, independently
    of each other. Artifacts at the ends of the recording are cut short.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        The clean trajectories in mm; NaN = missing.
    markers : sequence of str
        Names of the markers.
    amplitude : float
        Mean amplitude in mm.
    share : float
        Share of the frames that each class distorts on average.
    rng : Generator
        Source of randomness.
    kinds : collection of str
        Which of CLASSES.

    Returns
    -------
    Contamination
        The contaminated trajectories and the truth; every artifact is on one axis.

    Raises
    ------
    ValueError
        If the shares of all classes do not leave any clean frames, a class is unknown, or no marker is complete during an artifact.

    References
    ----------
    skurowski2022, section 4.1.3; the errors of distorted recordings are in Tables 3 to 5.
    """
    if unknown := set(kinds) - set(CLASSES):
        raise ValueError(f"the paper has no {', '.join(sorted(unknown))}, but {', '.join(CLASSES)}")
    if share * len(kinds) >= 1:
        raise ValueError(f"{share:.0%} of the time for each of {len(kinds)} classes leaves no clean frames")
    contamination = Contamination(positions, markers, margin=0, one_at_a_time=True, rng=rng)
    size = normal(amplitude, AMPLITUDE_DEVIATION * amplitude)
    present = ~np.isnan(positions).any(axis=2)
    bulk = [kind for kind in CLASSES if kind in kinds and kind != "peaks"]
    clean = np.ones(len(positions), bool)
    for start, stop in _intervals(len(positions), share * len(bulk), rng):
        recipe = Recipe(size, integers(stop - start, stop - start), axes=1)
        kind = bulk[rng.integers(len(bulk))]
        contamination.put(kind, recipe, marker=_complete(present, start, stop, rng), start=start, stop=stop)
        clean[start:stop] = False
    if "peaks" in kinds and clean.any():
        probability = share * len(positions) / clean.sum()
        for frame in np.flatnonzero(clean & (rng.random(len(clean)) < probability)).tolist():
            marker = _complete(present, frame, frame + 1, rng)
            contamination.put("peaks", Recipe(size, integers(1, 1), axes=1), marker=marker, start=frame, stop=frame + 1)
    return contamination


def _intervals(frames: int, share: float, rng: np.random.Generator) -> list[tuple[int, int]]:
    """Half-open intervals of a Poisson process that cover a share of the frames on average."""
    if not share:
        return []
    length = poisson(MEAN_LENGTH)
    pause = MEAN_LENGTH * (1 - share) / share
    # The process is stationary: at the beginning of the recording, too, an artifact is under way with a probability of the share.
    at = -int(rng.integers(int(length(rng)))) if rng.random() < share else _pause(pause, rng)
    intervals: list[tuple[int, int]] = []
    while at < frames:
        stop = at + int(length(rng))
        if stop > 0:
            intervals.append((max(0, at), min(stop, frames)))
        at = stop + _pause(pause, rng)
    return intervals


def _pause(mean: float, rng: np.random.Generator) -> int:
    """Draw a number of frames without memory, at least 0, with a given mean."""
    return int(rng.geometric(1 / (1 + mean))) - 1


def _complete(present: np.ndarray, start: int, stop: int, rng: np.random.Generator) -> int:
    """Draw one of the markers that are complete in an interval; present: bool (frames, markers)."""
    complete = np.flatnonzero(present[start:stop].all(axis=0))
    if not len(complete):
        raise ValueError(f"no marker is complete in frames {start} to {stop}")
    return int(rng.choice(complete))
