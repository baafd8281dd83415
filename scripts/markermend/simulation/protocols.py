"""Protocols of contamination: that of the artifact detection paper, displacements in space, and artifacts as they occur in practice."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from markermend.simulation.artifact_models import Draw, Recipe, integers, normal, poisson
from markermend.simulation.contamination import Contamination
from markermend.simulation.published_contamination import AMPLITUDE_DEVIATION, contaminate_coordinates

PRACTICE = (
    ("steps", (0.06, 1.0), 4),
    ("noise", (0.25, 0.8), 4),
    ("slow", (0.4, 1.5), 4),
    ("peaks", (0.0, 0.05), 10),
)
"""Class, duration in s, and number in a minute of 40 markers, of `in_practice`."""

NEAR_MM = 250.0
"""Labels of markers nearer to each other than this are exchanged in `in_practice`."""


def recipes(amplitude: float) -> dict[str, Recipe]:
    """Give the recipes of the protocol `spatial`.

    Parameters
    ----------
    amplitude : float
        Mean amplitude in mm.

    Returns
    -------
    dict of str to Recipe
        By class: normal amplitudes, 50 frames on average, peaks of 1 to 5, on all axes.
    """
    size = normal(amplitude, AMPLITUDE_DEVIATION * amplitude)
    bulk = {kind: Recipe(size, poisson(50), 3) for kind in ("noise", "steps", "slow")}
    return {**bulk, "peaks": Recipe(size, integers(1, 5), 3)}


def in_practice(
    positions: np.ndarray,
    markers: Sequence[str],
    *,
    rate: float,
    amplitude: float,
    share: float,
    rng: np.random.Generator,
) -> Contamination:
    """Contaminate trajectories in the ways that the paper leaves out.

    Artifacts alter one to three axes. They occur alone, on three neighbouring markers at once, as bursts of peaks, next
    to gaps, at the ends of the recording, and as peaks and noise on top of slow changes and steps. Labels of two and
    three markers are exchanged for a frame up to two seconds, and for good; markers freeze; gaps occur alone, on three
    markers at once and with noisy tails.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        The clean trajectories in mm; NaN = missing.
    markers : sequence of str
        Names of the markers.
    rate : float
        Frame rate in Hz.
    amplitude : float
        Mean amplitude in mm.
    share : float
        How much: 0.1 gives as much as is common in raw data.
    rng : Generator
        Source of randomness.

    Returns
    -------
    Contamination
        The contaminated trajectories and the truth.

    Raises
    ------
    ValueError
        If the recording is too short for so much.
    """
    result = Contamination(positions, markers, margin=round(0.15 * rate), one_at_a_time=False, rng=rng)
    often = share / 0.1 * len(positions) / rate / 60 * len(markers) / 40
    size = normal(amplitude, AMPLITUDE_DEVIATION * amplitude)

    def number(count: float) -> int:
        return int(count * often + rng.random())

    def lasting(low: float, high: float) -> Draw:
        return integers(max(1, round(low * rate)), max(1, round(high * rate)))

    rest = integers(len(positions) // 10, len(positions) // 3)
    result.swap(length=rest, within_mm=NEAR_MM, at="stop", count=number(1))
    result.swap(length=lasting(0.1, 1.0), within_mm=NEAR_MM, markers=3, count=number(1))
    for length in (lasting(0.0, 0.02), lasting(0.1, 2.0)):
        result.swap(length=length, within_mm=NEAR_MM, count=number(2))
    for length, width, count in ((lasting(0.05, 1.0), 1, 6), (lasting(0.1, 0.5), 3, 2)):
        result.gap(length=length, markers=width, at="anywhere", count=number(count))
    result.add_at_gaps("tails", Recipe(size, lasting(0.02, 0.1), 3), gap=lasting(0.05, 0.5), count=number(6))
    result.freeze(length=lasting(0.05, 0.5), moving_mm=amplitude, count=number(4))
    usual = {kind: Recipe(size, lasting(*seconds), 3) for kind, seconds, _ in PRACTICE}
    result.add_bursts(usual["peaks"], peaks=integers(3, 5), pause=lasting(0.12, 0.3), count=number(2))
    for under in ("slow", "steps"):
        for over in ("peaks", "noise"):
            result.combine(under, usual[under], over, usual[over], count=number(1))
    for kind, _, count in PRACTICE:
        result.add_at_gaps(kind, usual[kind], gap=lasting(0.05, 0.5), count=number(1))
        result.add(kind, usual[kind], at=str(rng.choice(["start", "stop"])), count=number(1))
        result.add_concurrent(kind, usual[kind], markers=3, count=number(1))
        for _ in range(number(count)):
            result.add(kind, replace(usual[kind], axes=int(rng.integers(1, 4))), count=1)
    return result


def one_at_a_time(
    positions: np.ndarray,
    markers: Sequence[str],
    *,
    recipes: Mapping[str, Recipe],
    share: float,
    margin: int,
    rng: np.random.Generator,
) -> Contamination:
    """Distort a share of the time, one marker at a time, with equal shares of the classes that have a recipe.

    First noise, steps and slow changes in random order: their lengths are drawn, and the intervals between them are
    Poisson counts given their sum. Then peaks in between.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        The clean trajectories in mm; NaN = missing.
    markers : sequence of str
        Names of the markers.
    recipes : mapping of str to Recipe
        How artifacts are drawn, by class.
    share : float
        Share of the frames that is distorted, over all classes.
    margin : int
        Frames kept free around each artifact.
    rng : Generator
        Source of randomness.

    Returns
    -------
    Contamination
        The contaminated trajectories and the truth.

    Raises
    ------
    ValueError
        If the recording is too short for so much.
    """
    contamination = Contamination(positions, markers, margin=margin, one_at_a_time=True, rng=rng)
    frames = len(positions)
    bulk: list[tuple[str, int]] = []
    for kind in ("noise", "steps", "slow"):
        if kind in recipes:
            bulk += [(kind, length) for length in _lengths(recipes[kind].length, share * frames / len(recipes), rng)]
    bulk = [bulk[i] for i in rng.permutation(len(bulk))]
    rest = frames - sum(length for _, length in bulk) - margin * (len(bulk) + 1)
    if rest < 0:
        raise ValueError(f"{share:.0%} of {frames} frames cannot be distorted with {margin} frames between")
    pauses = margin + rng.multinomial(rest, np.full(len(bulk) + 1, 1 / (len(bulk) + 1)))
    present = ~np.isnan(positions).any(axis=2)
    at = 0
    for (kind, length), pause in zip(bulk, pauses[:-1], strict=True):
        start = at + int(pause)
        at = start + length
        complete = np.flatnonzero(present[start:at].all(axis=0))
        if not len(complete):
            raise ValueError(f"no marker is complete in frames {start} to {at}")
        contamination.put(kind, recipes[kind], marker=int(rng.choice(complete)), start=start, stop=at)
    if "peaks" in recipes:
        for length in _lengths(recipes["peaks"].length, share * frames / len(recipes), rng):
            recipe = recipes["peaks"]
            contamination.add("peaks", Recipe(recipe.amplitude, integers(length, length), recipe.axes), count=1)
    return contamination


def _lengths(draw: Draw, total: float, rng: np.random.Generator) -> list[int]:
    """Lengths drawn until their sum is as near to the total as it gets; if that is 0, one by chance."""
    lengths: list[int] = []
    while True:
        length = int(draw(rng))
        if sum(lengths) + length / 2 > total:
            return lengths if lengths or rng.random() > total / length else [length]
        lengths.append(length)


def in_space(
    positions: np.ndarray,
    markers: Sequence[str],
    *,
    rate: float,
    amplitude: float,
    share: float,
    rng: np.random.Generator,
) -> Contamination:
    """Displace one marker at a time in a random direction, artifacts 10 frames apart; lengths are in frames whatever the rate.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        The clean trajectories in mm; NaN = missing.
    markers : sequence of str
        Names of the markers.
    rate : float
        Frame rate in Hz; not used.
    amplitude : float
        Mean amplitude in mm.
    share : float
        Share of the frames that is distorted, over all classes.
    rng : Generator
        Source of randomness.

    Returns
    -------
    Contamination
        The contaminated trajectories and the truth.
    """
    return one_at_a_time(positions, markers, recipes=recipes(amplitude), share=share, margin=10, rng=rng)


def as_published(
    positions: np.ndarray,
    markers: Sequence[str],
    *,
    rate: float,
    amplitude: float,
    share: float,
    rng: np.random.Generator,
) -> Contamination:
    """Follow the paper's protocol with all classes; see published_contamination. Lengths are in frames whatever the rate.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        The clean trajectories in mm; NaN = missing.
    markers : sequence of str
        Names of the markers.
    rate : float
        Frame rate in Hz; not used.
    amplitude : float
        Mean amplitude in mm.
    share : float
        Share of the frames that each class distorts.
    rng : Generator
        Source of randomness.

    Returns
    -------
    Contamination
        The contaminated trajectories and the truth.
    """
    return contaminate_coordinates(positions, markers, amplitude=amplitude, share=share, rng=rng)


PROTOCOLS: dict[str, Callable[..., Contamination]] = {
    "spatial": in_space,
    "paper": as_published,
    "practice": in_practice,
}
"""The protocols by name, called with positions, markers, rate, amplitude, share and rng."""
