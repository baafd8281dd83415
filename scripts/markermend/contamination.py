"""Known damage to clean trajectories: artifacts of every class, swapped labels and gaps, with the truth about each.

No two of them ever meet on one marker, but for a noisy tail and its gap.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.damage import Artifact, Draw, Recipe, added
from markermend.events import CLASSES, Event


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
        """Put in one artifact of a class that adds something, at a given place."""
        change, amplitude = added(kind, recipe, stop - start, self._rng)
        self.positions[start:stop, marker] += change
        self._note(kind, marker, start, stop, amplitude)

    def together(self, kind: str, recipe: Recipe, *, markers: int, count: int) -> None:
        """Put in artifacts of one class on several markers at once: a random one and its nearest, in their own directions."""
        order = np.argsort(self._distances(), axis=1, kind="stable")
        for _ in range(count):
            length = int(recipe.length(self._rng))
            room = self._room(length, ends=False)
            groups = [row[:markers] for row in order]
            free = np.stack([room[:, group].all(axis=1) for group in groups], axis=1)
            start, m = self._draw(free)
            for marker in groups[m].tolist():
                self.put(kind, recipe, marker=marker, start=start, stop=start + length)

    def burst(self, recipe: Recipe, *, peaks: Draw, pause: Draw, count: int) -> None:
        """Put in peaks in quick succession on one marker; pause: frames between two of them."""
        for _ in range(count):
            lengths = [max(1, int(recipe.length(self._rng))) for _ in range(int(peaks(self._rng)))]
            pauses = [int(pause(self._rng)) for _ in lengths]
            start, m = self._draw(self._room(sum(lengths) + sum(pauses), ends=False))
            for length, rest in zip(lengths, pauses, strict=True):
                self.put("peaks", recipe, marker=m, start=start, stop=start + length)
                start += length + rest

    def freeze(self, *, length: Draw, moving_mm: float, count: int) -> None:
        """Repeat a position for some frames in which the marker really moves away by more than `moving_mm`."""
        for _ in range(count):
            frames = int(length(self._rng))
            room = self._room(frames, ends=False)
            last = np.arange(max(1, self._margin), len(room) - self._margin)
            gone = np.linalg.norm(self._clean[last + frames - 1] - self._clean[last - 1], axis=2)
            moves = np.zeros_like(room)
            moves[last] = gone > moving_mm
            start, m = self._draw(room & moves)
            self.positions[start : start + frames, m] = self.positions[start - 1, m]
            self._note("frozen", m, start, start + frames, np.zeros(3))

    def tail(self, recipe: Recipe, *, gap: Draw, count: int) -> None:
        """Put in gaps before or after which the marker wanders off."""
        for _ in range(count):
            hole, length = int(gap(self._rng)), int(recipe.length(self._rng))
            start, m = self._draw(self._room(hole + length, ends=False))
            before = bool(self._rng.integers(2))
            change, amplitude = added("tails", recipe, length, self._rng)
            first, begin = (start, start + length) if before else (start + hole, start)
            self.positions[first : first + length, m] += change if before else change[::-1]
            self._note("tails", m, first, first + length, amplitude)
            self._remove([m], begin, begin + hole)

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
            self._remove(chosen, start, start + frames)

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

    def _note(self, kind: str, m: int, start: int, stop: int, amplitude: np.ndarray) -> None:
        self._take([m], start, stop)
        x, y, z = amplitude.tolist()
        self.artifacts.append(Artifact(kind, self.markers[m], start, stop, (x, y, z)))

    def _remove(self, markers: Sequence[int], start: int, stop: int) -> None:
        self.positions[start:stop, markers] = np.nan
        self._take(markers, start, stop)
        self.gaps += [(self.markers[m], start, stop) for m in markers]

    def _take(self, markers: Sequence[int], start: int, stop: int) -> None:
        self._taken[start:stop, markers] = True

    def _distances(self) -> np.ndarray:
        """Median distance in mm of every two markers, over some frames; that of a marker to itself does not matter."""
        some = self._clean[:: max(1, len(self._clean) // 50)]
        return np.nanmedian(np.linalg.norm(some[:, :, None] - some[:, None], axis=3), axis=0)
