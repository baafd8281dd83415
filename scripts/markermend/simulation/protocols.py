"""Procedures of contamination: that of the artifact detection paper, and damage as it comes in practice."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from markermend.simulation.artifact_models import Draw, Recipe, integers, normal, poisson
from markermend.simulation.contamination import Contamination

SPREAD = 0.4
"""Standard deviation of an amplitude, as a part of its mean (skurowski2022: 5 mm with 2, 10 mm with 4)."""

PRACTICE = (
    ("steps", (0.06, 1.0), 4),
    ("noise", (0.25, 0.8), 4),
    ("slow", (0.4, 1.5), 4),
    ("peaks", (0.0, 0.05), 10),
)
"""Class, duration in s, and number in a minute of 40 markers, in `in_practice`."""

NEAR_MM = 250.0
"""Markers nearer to each other than this are swapped in `in_practice`."""


def recipes(amplitude: float) -> dict[str, Recipe]:
    """The paper's recipes: normal amplitudes (mm), 50 samples on average, peaks of 1 to 5; on all axes."""
    size = normal(amplitude, SPREAD * amplitude)
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
    """Damage trajectories in the ways that the paper leaves out; with a share of 0.1, as much as is common in raw data.

    Artifacts hit one to three axes, come alone, on three neighbouring markers at once, as bursts of peaks, beside gaps, at
    the ends of the recording, and as peaks and noise upon slow changes and steps. Labels of two and three markers are
    swapped for a frame up to two seconds, and for good; markers freeze; gaps come alone, on three markers and with noisy
    tails. positions: (frames, markers, 3), mm. rate: Hz. amplitude: mean, mm. Raises ValueError where there is no room.
    """
    harm = Contamination(positions, markers, margin=round(0.15 * rate), alone=False, rng=rng)
    often = share / 0.1 * len(positions) / rate / 60 * len(markers) / 40
    size = normal(amplitude, SPREAD * amplitude)

    def number(count: float) -> int:
        return int(count * often + rng.random())

    def lasting(low: float, high: float) -> Draw:
        return integers(max(1, round(low * rate)), max(1, round(high * rate)))

    rest = integers(len(positions) // 10, len(positions) // 3)
    harm.swap(length=rest, within=NEAR_MM, at="stop", count=number(1))
    harm.swap(length=lasting(0.1, 1.0), within=NEAR_MM, markers=3, count=number(1))
    for length in (lasting(0.0, 0.02), lasting(0.1, 2.0)):
        harm.swap(length=length, within=NEAR_MM, count=number(2))
    for length, width, count in ((lasting(0.05, 1.0), 1, 6), (lasting(0.1, 0.5), 3, 2)):
        harm.gap(length=length, markers=width, at="anywhere", count=number(count))
    harm.beside_gaps("tails", Recipe(size, lasting(0.02, 0.1), 3), gap=lasting(0.05, 0.5), count=number(6))
    harm.freeze(length=lasting(0.05, 0.5), moving_mm=amplitude, count=number(4))
    usual = {kind: Recipe(size, lasting(*seconds), 3) for kind, seconds, _ in PRACTICE}
    harm.burst(usual["peaks"], peaks=integers(3, 5), pause=lasting(0.12, 0.3), count=number(2))
    for under in ("slow", "steps"):
        for over in ("peaks", "noise"):
            harm.combined(under, usual[under], over, usual[over], count=number(1))
    for kind, _, count in PRACTICE:
        harm.beside_gaps(kind, usual[kind], gap=lasting(0.05, 0.5), count=number(1))
        harm.add(kind, usual[kind], at=str(rng.choice(["start", "stop"])), count=number(1))
        harm.together(kind, usual[kind], markers=3, count=number(1))
        for _ in range(number(count)):
            harm.add(kind, replace(usual[kind], axes=int(rng.integers(1, 4))), count=1)
    return harm


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
    Poisson counts given their sum. Then peaks in between. (skurowski2022, section 4.1.3.) Raises ValueError where the
    recording is too short.
    """
    contamination = Contamination(positions, markers, margin=margin, alone=True, rng=rng)
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
        whole = np.flatnonzero(present[start:at].all(axis=0))
        if not len(whole):
            raise ValueError(f"no marker is complete in frames {start} to {at}")
        contamination.put(kind, recipes[kind], marker=int(rng.choice(whole)), start=start, stop=at)
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


def as_published(
    positions: np.ndarray,
    markers: Sequence[str],
    *,
    rate: float,
    amplitude: float,
    share: float,
    rng: np.random.Generator,
) -> Contamination:
    """The paper's procedure with its recipes, 10 frames apart; lengths are in frames whatever the rate (Hz)."""
    return one_at_a_time(positions, markers, recipes=recipes(amplitude), share=share, margin=10, rng=rng)


PROCEDURES: dict[str, Callable[..., Contamination]] = {"paper": as_published, "practice": in_practice}
"""The procedures by name, called with positions, markers, rate, amplitude, share and rng."""
