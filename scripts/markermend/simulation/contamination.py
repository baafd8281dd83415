"""Known contamination of clean trajectories: artifacts of every class, exchanged labels and gaps, with the truth.

No two of them ever meet on one marker, except what is put in next to a gap, and combined artifacts.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from markermend.core.artifacts import DETECTORS
from markermend.core.events import Event
from markermend.simulation.artifact_models import Artifact, Draw, Recipe, draw_change
from markermend.simulation.free_space import FreeSpace, choose


class Contamination:
    """Trajectories that are being contaminated, and the truth so far.

    Every method draws its artifacts at random and raises ValueError where nothing is free any more. Samples that are
    missing from the start are left alone.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        The clean trajectories in mm; NaN = missing. They are not changed.
    markers : sequence of str
        Names of the markers.
    margin : int
        Frames kept free around each artifact and gap.
    one_at_a_time : bool
        Whether at most one marker is altered in any frame.
    rng : Generator
        Source of randomness.

    Attributes
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        The contaminated trajectories in mm.
    artifacts : list of Artifact
        What was put in.
    gaps : list of (str, int, int)
        Marker, start and stop of the gaps that were made.
    """

    def __init__(
        self,
        positions: np.ndarray,
        markers: Sequence[str],
        *,
        margin: int,
        one_at_a_time: bool,
        rng: np.random.Generator,
    ) -> None:
        self.positions = positions.copy()
        self.markers = tuple(markers)
        self.artifacts: list[Artifact] = []
        self.gaps: list[tuple[str, int, int]] = []
        self._clean = positions
        self._rng = rng
        self._space = FreeSpace(np.isnan(positions).any(axis=2), margin=margin, one_at_a_time=one_at_a_time)

    @property
    def events(self) -> dict[str, list[Event]]:
        """The truth as sorted events per class; exchanged labels have one event for each marker."""
        found: dict[str, list[Event]] = {kind: [] for kind in DETECTORS}
        for artifact in self.artifacts:
            found[artifact.kind].append(artifact.event)
        return {kind: sorted(events, key=lambda event: event.order) for kind, events in found.items()}

    @property
    def gap_events(self) -> list[Event]:
        """The gaps that were made, as sorted events."""
        return [Event(marker, start, stop, 1.0) for marker, start, stop in sorted(self.gaps)]

    def add(self, kind: str, recipe: Recipe, *, count: int, at: str = "anywhere") -> None:
        """Put in artifacts of one class on random markers.

        Parameters
        ----------
        kind : str
            A key of artifact_models.SHAPES.
        recipe : Recipe
            How they are drawn.
        count : int
            How many.
        at : str
            "start" or "stop" of the recording, or "anywhere".
        """
        for _ in range(count):
            length = int(recipe.length(self._rng))
            start, m = choose(self._space.starts(length, at=at, ends=at != "anywhere"), self._rng)
            form = "alone" if at == "anywhere" else "at an end"
            self.put(kind, recipe, marker=m, start=start, stop=start + length, form=form)

    def put(self, kind: str, recipe: Recipe, *, marker: int, start: int, stop: int, form: str = "alone") -> None:
        """Put in one artifact at a given place.

        Parameters
        ----------
        kind : str
            A key of artifact_models.SHAPES.
        recipe : Recipe
            How its amplitude is drawn.
        marker, start, stop : int
            Index of the marker, and the half-open interval.
        form : str
            See Artifact.
        """
        change, amplitude = draw_change(kind, recipe, stop - start, self._rng)
        self.positions[start:stop, marker] += change
        self._record(Artifact(kind, self.markers[marker], start, stop, _along_axes(amplitude), form=form))

    def combine(self, under: str, below: Recipe, over: str, above: Recipe, *, count: int) -> None:
        """Put in artifacts of one class, each with a shorter one of another class on top of it.

        Parameters
        ----------
        under : str
            The class of the longer one.
        below : Recipe
            How it is drawn.
        over : str
            The class of the one on top of it.
        above : Recipe
            How that is drawn.
        count : int
            How many pairs.
        """
        for _ in range(count):
            length = int(below.length(self._rng))
            short = min(int(above.length(self._rng)), length)
            start, m = choose(self._space.starts(length), self._rng)
            self.put(under, below, marker=m, start=start, stop=start + length, form="combined")
            start += int(self._rng.integers(length - short + 1))
            self.put(over, above, marker=m, start=start, stop=start + short, form="combined")

    def add_concurrent(self, kind: str, recipe: Recipe, *, markers: int, count: int) -> None:
        """Put in artifacts of one class on several markers at once, each in its own direction.

        Parameters
        ----------
        kind : str
            A key of artifact_models.SHAPES.
        recipe : Recipe
            How they are drawn.
        markers : int
            How many markers at once: a random one and those nearest to it.
        count : int
            How often.
        """
        order = np.argsort(self._distances(), axis=1, kind="stable")
        for _ in range(count):
            length = int(recipe.length(self._rng))
            free = self._space.starts(length)
            groups = [row[:markers] for row in order]
            start, m = choose(np.stack([free[:, group].all(axis=1) for group in groups], axis=1), self._rng)
            for marker in groups[m].tolist():
                self.put(kind, recipe, marker=marker, start=start, stop=start + length, form="together")

    def add_bursts(self, recipe: Recipe, *, peaks: Draw, pause: Draw, count: int) -> None:
        """Put in peaks in quick succession on one marker.

        Parameters
        ----------
        recipe : Recipe
            How a peak is drawn.
        peaks, pause : Draw
            How many peaks, and how many frames between two of them.
        count : int
            How many bursts.
        """
        for _ in range(count):
            lengths = [max(1, int(recipe.length(self._rng))) for _ in range(int(peaks(self._rng)))]
            pauses = [int(pause(self._rng)) for _ in lengths]
            start, m = choose(self._space.starts(sum(lengths) + sum(pauses)), self._rng)
            for length, rest in zip(lengths, pauses, strict=True):
                self.put("peaks", recipe, marker=m, start=start, stop=start + length, form="burst")
                start += length + rest

    def freeze(self, *, length: Draw, moving_mm: float, count: int) -> None:
        """Repeat a position for some frames in which the marker really moves away.

        Parameters
        ----------
        length : Draw
            For how many frames.
        moving_mm : float
            The least distance that the marker moves meanwhile, in mm.
        count : int
            How often.
        """
        for _ in range(count):
            frames = int(length(self._rng))
            free = self._space.starts(frames)
            first = np.arange(max(1, self._space.margin), len(free) - self._space.margin)
            distance = np.linalg.norm(self._clean[first + frames - 1] - self._clean[first - 1], axis=2)
            moves = np.zeros_like(free)
            moves[first] = distance > moving_mm
            start, m = choose(free & moves, self._rng)
            self.positions[start : start + frames, m] = self.positions[start - 1, m]
            self._record(Artifact("frozen", self.markers[m], start, start + frames))

    def add_at_gaps(self, kind: str, recipe: Recipe, *, gap: Draw, count: int) -> None:
        """Put in gaps that an artifact precedes or follows, such as a tail.

        Parameters
        ----------
        kind : str
            A key of artifact_models.SHAPES.
        recipe : Recipe
            How the artifact is drawn.
        gap : Draw
            How long the gap is, in frames.
        count : int
            How many.
        """
        for _ in range(count):
            missing, length = int(gap(self._rng)), int(recipe.length(self._rng))
            start, m = choose(self._space.starts(missing + length), self._rng)
            before = bool(self._rng.integers(2))
            change, amplitude = draw_change(kind, recipe, length, self._rng)
            first, begin = (start, start + length) if before else (start + missing, start)
            self.positions[first : first + length, m] += change if before else change[::-1]
            artifact = Artifact(
                kind, self.markers[m], first, first + length, _along_axes(amplitude), form="beside a gap"
            )
            self._record(artifact)
            self._remove([m], begin, begin + missing)

    def swap(self, *, length: Draw, within_mm: float, count: int, markers: int = 2, at: str = "anywhere") -> None:
        """Exchange the labels of markers in a ring.

        Parameters
        ----------
        length : Draw
            For how many frames.
        within_mm : float
            The largest median distance of any two of them, in mm.
        count : int
            How often.
        markers : int
            How many markers exchange their labels.
        at : str
            "start" of the recording, "anywhere", or "stop", where the labels are never exchanged back.
        """
        distance = self._distances()
        rings = [
            ring
            for ring in combinations(range(len(self.markers)), markers)
            if all(distance[pair] < within_mm for pair in combinations(ring, 2))
        ]
        for _ in range(count):
            frames = int(length(self._rng))
            free = self._space.starts(frames, at=at, ends=at != "anywhere")
            possible = [ring for ring in rings if free[:, ring].all(axis=1).any()]
            if not possible:
                raise ValueError(f"no {markers} markers within {within_mm} mm have {frames} free frames")
            ring = self._rng.permutation(possible[self._rng.integers(len(possible))])
            start = int(self._rng.choice(np.flatnonzero(free[:, ring].all(axis=1))))
            stop, onward = start + frames, np.roll(ring, -1)
            self.positions[start:stop, onward] = self.positions[start:stop, ring]
            form = "for good" if at == "stop" else f"{markers} markers"
            for one, other in zip(ring.tolist(), onward.tolist(), strict=True):
                partner = self.markers[other]
                self._record(Artifact("labels", self.markers[one], start, stop, partner=partner, form=form))

    def gap(self, *, length: Draw, markers: Sequence[str] | int, at: str, count: int) -> None:
        """Remove the samples of some markers at once.

        Parameters
        ----------
        length : Draw
            How many frames.
        markers : sequence of str or int
            Which markers, or how many random ones.
        at : str
            "start" or "stop" of the recording, or "anywhere".
        count : int
            How often.
        """
        for _ in range(count):
            frames = int(length(self._rng))
            free = self._space.starts(frames, at=at, ends=True)
            if isinstance(markers, int):
                rows = np.flatnonzero(free.sum(axis=1) >= markers)
            else:
                chosen = [self.markers.index(marker) for marker in markers]
                rows = np.flatnonzero(free[:, chosen].all(axis=1))
            if not len(rows):
                raise ValueError(f"no {frames} free frames for a gap of {markers} at {at}")
            start = int(self._rng.choice(rows))
            if isinstance(markers, int):
                chosen = sorted(self._rng.choice(np.flatnonzero(free[start]), markers, replace=False).tolist())
            self._remove(chosen, start, start + frames)

    def _record(self, artifact: Artifact) -> None:
        """Add an artifact to the truth, and take its samples."""
        self._space.take([self.markers.index(artifact.marker)], artifact.start, artifact.stop)
        self.artifacts.append(artifact)

    def _remove(self, markers: Sequence[int], start: int, stop: int) -> None:
        """Make a gap, and take its samples."""
        self.positions[start:stop, markers] = np.nan
        self._space.take(markers, start, stop)
        self.gaps += [(self.markers[m], start, stop) for m in markers]

    def _distances(self) -> np.ndarray:
        """Median distance in mm of every two markers, over some frames; that of a marker to itself does not matter."""
        some = self._clean[:: max(1, len(self._clean) // 50)]
        return np.asarray(np.nanmedian(np.linalg.norm(some[:, :, None] - some[:, None], axis=3), axis=0))


def _along_axes(amplitude: np.ndarray) -> tuple[float, float, float]:
    """An amplitude (3,) as numbers along x, y and z."""
    x, y, z = amplitude.tolist()
    return x, y, z
