"""Known damage to clean trajectories: artifacts of every class, swapped labels and gaps, with the truth about each.

No two of them ever meet on one marker, but for what is put in beside a gap, and for combined artifacts.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from markermend.core.artifacts import CLASSES
from markermend.core.events import Event
from markermend.simulation.artifact_models import Artifact, Draw, Recipe, added


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
        """The truth as sorted events per class; label exchanges have one event for each marker."""
        found: dict[str, list[Event]] = {kind: [] for kind in CLASSES}
        for artifact in self.artifacts:
            found[artifact.kind].append(artifact.event)
        return {kind: sorted(events, key=lambda event: event.order) for kind, events in found.items()}

    def add(self, kind: str, recipe: Recipe, *, count: int, at: str = "anywhere") -> None:
        """Put in artifacts of one class on random markers, at random places or at the "start" or "stop" of the recording."""
        for _ in range(count):
            length = int(recipe.length(self._rng))
            start, m = self._draw(self._room(length, at=at, ends=at != "anywhere"))
            form = "alone" if at == "anywhere" else "at an end"
            self.put(kind, recipe, marker=m, start=start, stop=start + length, form=form)

    def put(self, kind: str, recipe: Recipe, *, marker: int, start: int, stop: int, form: str = "alone") -> None:
        """Put in one artifact of a class that adds something, at a given place."""
        change, amplitude = added(kind, recipe, stop - start, self._rng)
        self.positions[start:stop, marker] += change
        self._note(kind, marker, start, stop, amplitude, form)

    def combined(self, under: str, below: Recipe, over: str, above: Recipe, *, count: int) -> None:
        """Put in artifacts of the class `under`, each with a shorter one of the class `over` somewhere on top of it."""
        for _ in range(count):
            length = int(below.length(self._rng))
            short = min(int(above.length(self._rng)), length)
            start, m = self._draw(self._room(length))
            self.put(under, below, marker=m, start=start, stop=start + length, form="combined")
            start += int(self._rng.integers(length - short + 1))
            self.put(over, above, marker=m, start=start, stop=start + short, form="combined")

    def together(self, kind: str, recipe: Recipe, *, markers: int, count: int) -> None:
        """Put in artifacts of one class on several markers at once: a random one and its nearest, in their own directions."""
        order = np.argsort(self._distances(), axis=1, kind="stable")
        for _ in range(count):
            length = int(recipe.length(self._rng))
            room = self._room(length)
            groups = [row[:markers] for row in order]
            free = np.stack([room[:, group].all(axis=1) for group in groups], axis=1)
            start, m = self._draw(free)
            for marker in groups[m].tolist():
                self.put(kind, recipe, marker=marker, start=start, stop=start + length, form="together")

    def burst(self, recipe: Recipe, *, peaks: Draw, pause: Draw, count: int) -> None:
        """Put in peaks in quick succession on one marker; pause: frames between two of them."""
        for _ in range(count):
            lengths = [max(1, int(recipe.length(self._rng))) for _ in range(int(peaks(self._rng)))]
            pauses = [int(pause(self._rng)) for _ in lengths]
            start, m = self._draw(self._room(sum(lengths) + sum(pauses)))
            for length, rest in zip(lengths, pauses, strict=True):
                self.put("peaks", recipe, marker=m, start=start, stop=start + length, form="burst")
                start += length + rest

    def freeze(self, *, length: Draw, moving_mm: float, count: int) -> None:
        """Repeat a position for some frames in which the marker really moves away by more than `moving_mm`."""
        for _ in range(count):
            frames = int(length(self._rng))
            room = self._room(frames)
            last = np.arange(max(1, self._margin), len(room) - self._margin)
            gone = np.linalg.norm(self._clean[last + frames - 1] - self._clean[last - 1], axis=2)
            moves = np.zeros_like(room)
            moves[last] = gone > moving_mm
            start, m = self._draw(room & moves)
            self.positions[start : start + frames, m] = self.positions[start - 1, m]
            self._note("frozen", m, start, start + frames, np.zeros(3), "alone")

    def beside_gaps(self, kind: str, recipe: Recipe, *, gap: Draw, count: int) -> None:
        """Put in gaps right before or after which there is an artifact of a class, such as a tail."""
        for _ in range(count):
            hole, length = int(gap(self._rng)), int(recipe.length(self._rng))
            start, m = self._draw(self._room(hole + length))
            before = bool(self._rng.integers(2))
            change, amplitude = added(kind, recipe, length, self._rng)
            first, begin = (start, start + length) if before else (start + hole, start)
            self.positions[first : first + length, m] += change if before else change[::-1]
            self._note(kind, m, first, first + length, amplitude, "beside a gap")
            self._remove([m], begin, begin + hole)

    def swap(self, *, length: Draw, within: float, count: int, markers: int = 2, at: str = "anywhere") -> None:
        """Swap the labels of markers in a ring, each two at a median distance below `within` mm; at "stop": for good."""
        distance = self._distances()
        rings = [
            ring
            for ring in combinations(range(len(self.markers)), markers)
            if all(distance[pair] < within for pair in combinations(ring, 2))
        ]
        for _ in range(count):
            frames = int(length(self._rng))
            room = self._room(frames, at=at, ends=at != "anywhere")
            free = [ring for ring in rings if room[:, ring].all(axis=1).any()]
            if not free:
                raise ValueError(f"no {markers} markers within {within} mm have {frames} free frames")
            ring = self._rng.permutation(free[self._rng.integers(len(free))])
            start = int(self._rng.choice(np.flatnonzero(room[:, ring].all(axis=1))))
            stop, onward = start + frames, np.roll(ring, -1)
            self.positions[start:stop, onward] = self.positions[start:stop, ring]
            form = "for good" if at == "stop" else f"{markers} markers"
            for one, other in zip(ring.tolist(), onward.tolist(), strict=True):
                self._note("labels", one, start, stop, np.zeros(3), form, self.markers[other])

    def gap(self, *, length: Draw, markers: Sequence[str] | int, at: str, count: int) -> None:
        """Remove the samples of some markers together.

        markers: which, or how many random ones. at: "start" or "stop" of the recording, or "anywhere".
        """
        for _ in range(count):
            frames = int(length(self._rng))
            room = self._room(frames, at=at, ends=True)
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

    def _room(self, length: int, *, at: str = "anywhere", ends: bool = False) -> np.ndarray:
        """Bool (starts, markers): True where `length` frames from a start, and the margin around, are free.

        at: "start" or "stop" of the recording, or "anywhere". ends: the margin may lie beyond the ends of the recording.
        """
        if length > len(self._taken):
            raise ValueError(f"{length} frames do not fit into a recording of {len(self._taken)}")
        taken = np.repeat(self._taken.any(axis=1)[:, None], len(self.markers), axis=1) if self._alone else self._taken
        padded = np.pad(taken, ((self._margin, self._margin), (0, 0)), constant_values=not ends)
        total = np.pad(np.cumsum(padded, axis=0), ((1, 0), (0, 0)))
        width = length + 2 * self._margin
        room = total[width:] == total[:-width]
        room[{"anywhere": slice(0, 0), "start": slice(1, None), "stop": slice(0, -1)}[at]] = False
        return room

    def _draw(self, room: np.ndarray) -> tuple[int, int]:
        """A random start and marker among those with room."""
        places = np.flatnonzero(room)
        if not len(places):
            raise ValueError("no room left for another artifact")
        start, m = np.unravel_index(self._rng.choice(places), room.shape)
        return int(start), int(m)

    def _note(
        self, kind: str, m: int, start: int, stop: int, size: np.ndarray, form: str, partner: str | None = None
    ) -> None:
        self._take([m], start, stop)
        x, y, z = size.tolist()
        self.artifacts.append(Artifact(kind, self.markers[m], start, stop, (x, y, z), partner, form))

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
