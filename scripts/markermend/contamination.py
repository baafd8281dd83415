"""Known damage to clean trajectories: artifacts of the four classes, swapped labels and gaps, with the truth about each.

No two of them ever meet on one marker. The shapes and the procedure `one_at_a_time` are those of the artifact detection
paper (skurowski2022, section 4.1.3).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.events import CLASSES, Event

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

    For noise the amplitude is the standard deviation. A swap has class steps, a partner and no amplitude.
    """

    kind: str
    marker: str
    start: int
    stop: int
    amplitude: tuple[float, float, float]
    partner: str | None = None

    @property
    def event(self) -> Event:
        """The artifact as a detector ought to report it."""
        axes = "".join(axis for axis, size in zip("xyz", self.amplitude, strict=True) if size or self.partner)
        return Event(self.marker, self.start, self.stop, 1.0, axes, self.partner)


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


def shape(kind: str, length: int) -> np.ndarray:
    """Course of an artifact of amplitude 1 over its frames: a bump, a rectangle or a triangle; noise has amplitude 1."""
    at = (np.arange(length) + 0.5) / length
    course = {
        "peaks": np.sin(np.pi * at),
        "noise": np.ones(length),
        "steps": np.ones(length),
        "slow": 1 - np.abs(2 * at - 1),
    }[kind]
    return course / course.max()


class Contamination:
    """Trajectories that are being damaged, and the truth so far.

    positions: the damaged copy. artifacts, gaps: what was put in, gaps as (marker, start, stop). Every method raises
    ValueError where there is no room left. margin: frames kept free around each. alone: at most one marker is damaged
    at a time. Samples missing from the start are left alone.
    """

    def __init__(
        self, positions: np.ndarray, markers: Sequence[str], *, margin: int, alone: bool, rng: np.random.Generator
    ) -> None:
        self.positions = positions.copy()
        self.markers = tuple(markers)
        self.artifacts: list[Artifact] = []
        self.gaps: list[tuple[str, int, int]] = []
        self._clean = positions
        self._margin = margin
        self._alone = alone
        self._rng = rng
        self._taken = np.isnan(positions).any(axis=2)

    @property
    def events(self) -> dict[str, list[Event]]:
        """The truth as sorted events per class; swaps are among the steps, one event for each of the two markers."""
        found: dict[str, list[Event]] = {kind: [] for kind in CLASSES}
        for artifact in self.artifacts:
            found[artifact.kind].append(artifact.event)
        return {kind: sorted(events, key=lambda event: event.order) for kind, events in found.items()}

    def add(self, kind: str, recipe: Recipe, *, count: int) -> None:
        """Put in artifacts of one class at random places on random markers."""
        for _ in range(count):
            length = int(recipe.length(self._rng))
            start, m = self._draw(self._room(length, ends=False))
            self.put(kind, recipe, marker=m, start=start, stop=start + length)

    def put(self, kind: str, recipe: Recipe, *, marker: int, start: int, stop: int) -> None:
        """Put in one artifact at a given place; its amplitude goes in a random direction along as many axes as asked."""
        size = float(recipe.amplitude(self._rng))
        direction = np.zeros(3)
        axes = self._rng.choice(3, recipe.axes, replace=False)
        direction[axes] = self._rng.normal(0.0, 1.0, recipe.axes)
        amplitude = size * direction / np.linalg.norm(direction)
        change = shape(kind, stop - start)[:, None] * amplitude
        if kind == "noise":
            amplitude = np.abs(size * (direction != 0))
            change = self._rng.normal(0.0, 1.0, (stop - start, 3)) * amplitude
        self.positions[start:stop, marker] += change
        self._take([marker], start, stop)
        x, y, z = amplitude.tolist()
        self.artifacts.append(Artifact(kind, self.markers[marker], start, stop, (x, y, z)))

    def swap(self, *, length: Draw, within: float, count: int) -> None:
        """Swap the labels of pairs of markers whose median distance is below `within` mm."""
        distance = self._distances()
        for _ in range(count):
            frames = int(length(self._rng))
            room = self._room(frames, ends=False)
            pairs = [(a, b) for a, b in np.argwhere(np.triu(distance < within, 1)) if (room[:, a] & room[:, b]).any()]
            if not pairs:
                raise ValueError(f"no two markers within {within} mm have {frames} free frames")
            a, b = self._rng.permutation(pairs[self._rng.integers(len(pairs))]).tolist()
            start = int(self._rng.choice(np.flatnonzero(room[:, a] & room[:, b])))
            stop = start + frames
            self.positions[start:stop, [a, b]] = self.positions[start:stop, [b, a]]
            self._take([a, b], start, stop)
            for one, other in ((a, b), (b, a)):
                names = self.markers[one], self.markers[other]
                self.artifacts.append(Artifact("steps", names[0], start, stop, (0.0, 0.0, 0.0), names[1]))

    def gap(self, *, length: Draw, markers: Sequence[str] | int, at: str, count: int) -> None:
        """Remove the samples of some markers together.

        markers: which, or how many random ones. at: "start" or "stop" of the recording, or "anywhere".
        """
        for _ in range(count):
            frames = int(length(self._rng))
            room = self._room(frames, ends=True)
            last = len(room) - 1
            room[{"anywhere": slice(0, 0), "start": slice(1, None), "stop": slice(0, last)}[at]] = False
            if isinstance(markers, int):
                rows = np.flatnonzero(room.sum(axis=1) >= markers)
            else:
                chosen = [self.markers.index(marker) for marker in markers]
                rows = np.flatnonzero(room[:, chosen].all(axis=1))
            if not len(rows):
                raise ValueError(f"no {frames} free frames for a gap of {markers} at {at}")
            start = int(self._rng.choice(rows))
            if isinstance(markers, int):
                chosen = sorted(self._rng.choice(np.flatnonzero(room[start]), markers, replace=False).tolist())
            self.positions[start : start + frames, chosen] = np.nan
            self._take(chosen, start, start + frames)
            self.gaps += [(self.markers[m], start, start + frames) for m in chosen]

    def _room(self, length: int, *, ends: bool) -> np.ndarray:
        """Bool (starts, markers): True where `length` frames from a start, and the margin around, are free.

        ends: the margin may lie beyond the ends of the recording.
        """
        if length > len(self._taken):
            raise ValueError(f"{length} frames do not fit into a recording of {len(self._taken)}")
        taken = np.repeat(self._taken.any(axis=1)[:, None], len(self.markers), axis=1) if self._alone else self._taken
        padded = np.pad(taken, ((self._margin, self._margin), (0, 0)), constant_values=not ends)
        total = np.pad(np.cumsum(padded, axis=0), ((1, 0), (0, 0)))
        width = length + 2 * self._margin
        return total[width:] == total[:-width]

    def _draw(self, room: np.ndarray) -> tuple[int, int]:
        """A random start and marker among those with room."""
        places = np.flatnonzero(room)
        if not len(places):
            raise ValueError("no room left for another artifact")
        start, m = np.unravel_index(self._rng.choice(places), room.shape)
        return int(start), int(m)

    def _take(self, markers: Sequence[int], start: int, stop: int) -> None:
        self._taken[start:stop, markers] = True

    def _distances(self) -> np.ndarray:
        """Median distance in mm of every two markers, over some frames; that of a marker to itself does not matter."""
        some = self._clean[:: max(1, len(self._clean) // 50)]
        return np.nanmedian(np.linalg.norm(some[:, :, None] - some[:, None], axis=3), axis=0)


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
    """Lengths drawn until their sum is as near to the total as it gets."""
    lengths: list[int] = []
    while True:
        length = int(draw(rng))
        if sum(lengths) + length / 2 > total:
            return lengths
        lengths.append(length)
