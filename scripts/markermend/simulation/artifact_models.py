"""What damage is made of: artifacts as they are put in, how their sizes are drawn, and the courses that they take.

The courses of peaks, noise, steps and slow changes are those of the artifact detection paper (skurowski2022, section 4.1.3).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from markermend.core.events import Event

Draw = Callable[[np.random.Generator], float]
"""How an amplitude (mm) or a length (frames) is drawn."""


@dataclass(frozen=True)
class Recipe:
    """How the artifacts of one class are drawn: amplitude in mm, length in frames, and how many axes they hit."""

    amplitude: Draw
    length: Draw
    axes: int


@dataclass(frozen=True)
class Artifact:
    """One artifact as it was put in: class, marker, half-open interval, and its amplitude along x, y and z in mm.

    For noise, and at the end of a tail, the amplitude is the standard deviation. A swap has class labels and a partner,
    under whose label the marker's own samples are; neither it nor a frozen stretch has an amplitude. form: in which
    circumstances it was put in, such as "beside a gap", in a few words.
    """

    kind: str
    marker: str
    start: int
    stop: int
    amplitude: tuple[float, float, float]
    partner: str | None = None
    form: str = "alone"

    @property
    def event(self) -> Event:
        """The artifact as a detector ought to report it."""
        axes = "".join(axis for axis, size in zip("xyz", self.amplitude, strict=True) if size)
        return Event(self.marker, self.start, self.stop, 1.0, axes or "xyz", self.partner)


def uniform(low: float, high: float) -> Draw:
    """Draw evenly from [low, high)."""
    return lambda rng: rng.uniform(low, high)


def integers(low: int, high: int) -> Draw:
    """Draw a whole number evenly from low to high, both included."""
    return lambda rng: int(rng.integers(low, high + 1))


def normal(mean: float, deviation: float) -> Draw:
    """Draw from a normal distribution."""
    return lambda rng: rng.normal(mean, deviation)


def poisson(mean: float) -> Draw:
    """Draw a length of at least one frame from a Poisson distribution."""
    return lambda rng: max(1, int(rng.poisson(mean)))


SHAPES: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "peaks": lambda at: np.sin(np.pi * at),
    "noise": np.ones_like,
    "steps": np.ones_like,
    "slow": lambda at: 1 - np.abs(2 * at - 1),
    "tails": lambda at: at,
}
"""Course over its duration (0 to 1) of what is added: a bump, a rectangle, a triangle, or a ramp up to the gap."""

RANDOM = ("noise", "tails")
"""Classes of which the course is that of a standard deviation."""


def shape(kind: str, length: int) -> np.ndarray:
    """Course of an artifact of amplitude 1 over its frames; frozen stretches and swaps have none."""
    course = SHAPES[kind]((np.arange(length) + 0.5) / length)
    return course / course.max()


def added(kind: str, recipe: Recipe, length: int, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """What an artifact adds, (length, 3), mm, and its amplitude along x, y and z: in a random direction along as many
    axes as asked."""
    size = float(recipe.amplitude(rng))
    direction = np.zeros(3)
    axes = rng.choice(3, recipe.axes, replace=False)
    direction[axes] = rng.normal(0.0, 1.0, recipe.axes)
    amplitude = size * direction / np.linalg.norm(direction)
    course = shape(kind, length)[:, None]
    if kind not in RANDOM:
        return course * amplitude, amplitude
    amplitude = np.abs(size * (direction != 0))
    return course * amplitude * rng.normal(0.0, 1.0, (length, 3)), amplitude
