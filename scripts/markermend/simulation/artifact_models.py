"""Models of artifacts: how their sizes and lengths are drawn, and the shapes that they take over time.

The shapes of peaks, noise, steps and slow changes are those of the artifact detection paper (skurowski2022, section 4.1.3).
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
    """How the artifacts of one class are drawn.

    Attributes
    ----------
    amplitude : Draw
        In mm.
    length : Draw
        In frames.
    axes : int
        How many axes they alter.
    """

    amplitude: Draw
    length: Draw
    axes: int


@dataclass(frozen=True)
class Artifact:
    """One artifact as it was put in.

    Attributes
    ----------
    kind : str
        The detector that ought to find it.
    marker : str
        The marker that it alters.
    start, stop : int
        Half-open interval of rows.
    amplitude : tuple of float
        Along x, y and z in mm. For noise, and at the end of a tail, the standard deviation; zero for exchanged labels
        and frozen stretches.
    partner : str or None
        The marker under whose label the samples are, where labels are exchanged.
    form : str
        The circumstances in which it was put in, such as "beside a gap".
    """

    kind: str
    marker: str
    start: int
    stop: int
    amplitude: tuple[float, float, float] = (0.0, 0.0, 0.0)
    partner: str | None = None
    form: str = "alone"

    @property
    def event(self) -> Event:
        """The artifact as a detector ought to report it."""
        axes = "".join(axis for axis, size in zip("xyz", self.amplitude, strict=True) if size)
        return Event(self.marker, self.start, self.stop, 1.0, axes or "xyz", self.partner)


def uniform(low: float, high: float) -> Draw:
    """Draw evenly from an interval.

    Parameters
    ----------
    low, high : float
        The interval [low, high).

    Returns
    -------
    Draw
        The draw.
    """
    return lambda rng: rng.uniform(low, high)


def integers(low: int, high: int) -> Draw:
    """Draw a whole number evenly from a range.

    Parameters
    ----------
    low, high : int
        The range, both included.

    Returns
    -------
    Draw
        The draw.
    """
    return lambda rng: int(rng.integers(low, high + 1))


def normal(mean: float, deviation: float) -> Draw:
    """Draw from a normal distribution.

    Parameters
    ----------
    mean, deviation : float
        Its mean and standard deviation.

    Returns
    -------
    Draw
        The draw.
    """
    return lambda rng: float(rng.normal(mean, deviation))


def poisson(mean: float) -> Draw:
    """Draw a length of at least one frame from a Poisson distribution.

    Parameters
    ----------
    mean : float
        Its mean.

    Returns
    -------
    Draw
        The draw.
    """
    return lambda rng: max(1, int(rng.poisson(mean)))


SHAPES: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "peaks": lambda time: np.sin(np.pi * time),
    "noise": np.ones_like,
    "steps": np.ones_like,
    "slow": lambda time: 1 - np.abs(2 * time - 1),
    "tails": lambda time: time,
}
"""Shape over the duration (0 to 1) of what is added: half a sine, a rectangle, a triangle, or a ramp up to the gap."""

RANDOM = ("noise", "tails")
"""Classes of which the shape is that of a standard deviation."""


def shape(kind: str, length: int) -> np.ndarray:
    """Sample the shape of an artifact.

    Parameters
    ----------
    kind : str
        A key of SHAPES.
    length : int
        In frames.

    Returns
    -------
    ndarray of float, shape (length,)
        Positive, with maximum 1.
    """
    samples = SHAPES[kind]((np.arange(length) + 0.5) / length)
    return np.asarray(samples / samples.max())


def draw_change(kind: str, recipe: Recipe, length: int, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Draw what an artifact adds, in a random direction along as many axes as the recipe asks for.

    Parameters
    ----------
    kind : str
        A key of SHAPES.
    recipe : Recipe
        How amplitude and axes are drawn.
    length : int
        In frames.
    rng : Generator
        Source of randomness.

    Returns
    -------
    change : ndarray of float, shape (length, 3)
        In mm.
    amplitude : ndarray of float, shape (3,)
        Along x, y and z in mm.
    """
    size = float(recipe.amplitude(rng))
    direction = np.zeros(3)
    axes = rng.choice(3, recipe.axes, replace=False)
    direction[axes] = rng.normal(0.0, 1.0, recipe.axes)
    amplitude = size * direction / np.linalg.norm(direction)
    envelope = shape(kind, length)[:, None]
    if kind not in RANDOM:
        return envelope * amplitude, amplitude
    amplitude = np.abs(size * (direction != 0))
    return envelope * amplitude * rng.normal(0.0, 1.0, (length, 3)), amplitude
