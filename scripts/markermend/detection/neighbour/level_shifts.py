"""Level shifts: which stretches between the edges of a marker are displaced, by comparison of all explanations.

An explanation is a set of level shifts without a common edge. A level shift from one edge to another explains both and
returns to where it began. Its likelihood against none follows from the edges (large ones are rare in motion), the mismatch
of their jumps, the level of the marker in between against its neighbours and its shape, and the time displaced: the longer
part is right where nothing else decides. All explanations together give the probability that a stretch is displaced.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.detection.neighbour.edges import Edge
from markermend.detection.neighbour.level_evidence import LevelEvidence
from markermend.numerics import intervals
from markermend.options.detection.steps import StepsOptions

MAX_EVIDENCE = 50.0
"""The level decides no more than this: the logarithm of a ratio of likelihoods that spares looking at it."""


@dataclass(frozen=True, eq=False)
class DisplacedStretch:
    """A stretch of a marker that is displaced.

    Attributes
    ----------
    start, stop : int
        First frame, and the frame after the last.
    edges : tuple of Edge
        The edges at its ends: one where a gap or an end of the recording cuts it short.
    displacement : ndarray of float, shape (3,)
        By how much the marker is displaced, mm.
    """

    start: int
    stop: int
    edges: tuple[Edge, ...]
    displacement: np.ndarray

    def event(self, marker: str, sufficient: float) -> Event:
        """Report the stretch as an event.

        Parameters
        ----------
        marker : str
            Name of the marker.
        sufficient : float
            Score of an edge that just suffices.

        Returns
        -------
        Event
            The event; its score is the root mean square of those of the edges in units of one that suffices.
        """
        score = float(np.sqrt(np.mean([edge.score**2 for edge in self.edges]))) / sufficient
        axes = events.main_axes(np.array([edge.jump for edge in self.edges]))
        return Event(marker, self.start, self.stop, max(1.0, score), axes)


@dataclass(frozen=True)
class Explanations:
    """All explanations of the edges of a marker over a run of frames in which it is observed.

    Attributes
    ----------
    edges : Sequence[Edge]
        The edges in the run, by frame.
    run : tuple of int
        The frames, [start, stop).
    beyond : tuple of ndarray of int
        Frames before and after the run in which the marker is observed, as far as levels are compared with them; none at an
        end of the recording.
    evidence : LevelEvidence
        What the level of the marker says.
    rate : float
        Sampling rate, Hz.
    options : StepsOptions
        Lengths and thresholds of a step and its two jumps, context, and attribution.
    """

    edges: Sequence[Edge]
    run: tuple[int, int]
    beyond: tuple[np.ndarray, np.ndarray]
    evidence: LevelEvidence
    rate: float
    options: StepsOptions

    @cached_property
    def frames(self) -> np.ndarray:
        """The start of the run, the frames of the edges, and the stop of the run (edges + 2,)."""
        return np.array([self.run[0], *(edge.frame for edge in self.edges), self.run[1]])

    @cached_property
    def rarity(self) -> np.ndarray:
        """How much rarer each edge is in motion than one that just suffices, less for an end in its place (edges + 2,)."""
        sufficient, factor = self.options.joint_jump_fraction, self.options.recording_end_factor
        ends = [sufficient / (1.0 if len(frames) else factor) for frames in self.beyond]
        scores = [edge.score / sufficient for edge in self.edges]
        rarity: np.ndarray = self.options.jump_exponent * np.log([ends[0], *scores, ends[1]])
        return rarity

    def displaced(self) -> list[DisplacedStretch]:
        """Find the stretches that are displaced with sufficient probability; short ones only as part of a flicker.

        Returns
        -------
        list[DisplacedStretch]
            The stretches in order; adjacent ones are one.
        """
        found, steps = [], []
        shortest = intervals.samples(self.options.min_duration_s, self.rate)
        for first, last in intervals.runs(self.probabilities() >= self.options.min_probability):
            displacements = self._displacements(first, last)
            if displacements:
                found.append(self._stretch(first, last, np.mean(displacements, axis=0)))
                steps += found[-1:] if self.frames[last] - self.frames[first] >= shortest else []
        return [one for one in found if one in steps or any(self._flickers(one, step) for step in steps)]

    def _stretch(self, first: int, last: int, displacement: np.ndarray) -> DisplacedStretch:
        """The stretch between two edges or ends, with the samples on the way back."""
        edges = tuple(self.edges[k - 1] for k in (first, last) if 0 < k <= len(self.edges))
        stop = self.frames[last] + (edges[-1].ramp if last <= len(self.edges) else 0)
        return DisplacedStretch(int(self.frames[first]), int(stop), edges, displacement)

    def _flickers(self, one: DisplacedStretch, other: DisplacedStretch) -> bool:
        """Whether two stretches are displaced to the same level, one soon after the other."""
        apart = max(one.start, other.start) - min(one.stop, other.stop)
        difference = np.linalg.norm(one.displacement - other.displacement)
        scale = self.options.jump_mismatch_fraction * np.linalg.norm(other.displacement)
        return bool(apart <= self.options.level_window_s * self.rate and difference <= 2 * scale)

    def probabilities(self) -> np.ndarray:
        """Compute the probability of each stretch between successive edges and ends to be displaced.

        Returns
        -------
        np.ndarray
            Probabilities (edges + 1,).
        """
        ratios, count = self.log_ratios(), len(self.frames)
        before, after = np.zeros(count + 1), np.zeros(count + 1)
        for k in range(count):
            before[k + 1] = np.logaddexp.reduce([before[k], *(before[:k] + ratios[:k, k])])
        for k in reversed(range(count)):
            after[k] = np.logaddexp.reduce([after[k + 1], *(ratios[k, k + 1 :] + after[k + 2 :])])
        each = np.exp(before[:-1, None] + ratios + after[None, 1:] - before[-1])
        probabilities: np.ndarray = np.cumsum(each.sum(axis=1) - each.sum(axis=0))[:-1]
        return probabilities

    def log_ratios(self) -> np.ndarray:
        """Compute the likelihood of each level shift against none.

        Returns
        -------
        np.ndarray
            Logarithms (edges + 2, edges + 2) by the first and the last edge or end; -inf where there can be no level shift.
        """
        shortest, longest = (
            intervals.samples(seconds, self.rate)
            for seconds in (self.options.min_flicker_duration_s, self.options.max_duration_s)
        )
        count = len(self.frames)
        ratios = np.full((count, count), -np.inf)
        for k in range(count - 1):
            first, last = np.searchsorted(self.frames, self.frames[k] + np.array([shortest, longest + 1]))
            for j in range(max(int(first), k + 1), int(last)):
                ratios[k, j] = self._log_ratio(k, j)
        return ratios

    def _log_ratio(self, first: int, last: int) -> float:
        """The likelihood of a level shift between two edges or ends."""
        known = self._displacements(first, last)
        # Where motion may have made the jumps, a level in between is motion as well.
        if not known or self.rarity[first] + self.rarity[last] < 0:
            return -np.inf
        displacement = np.mean(known, axis=0)
        start, stop = int(self.frames[first]), int(self.frames[last])
        scale = self.options.jump_mismatch_fraction * max(float(np.linalg.norm(displacement)), 1e-9)
        mismatch = float(np.linalg.norm(known[-1] - known[0])) / scale
        ratio = float(self.rarity[first] + self.rarity[last]) - mismatch**2 / 2
        ratio -= self.options.displaced_cost_per_s * (stop - start) / self.rate
        if ratio < -MAX_EVIDENCE:
            return -np.inf
        return ratio + self._level_ratio(displacement, first, last)

    def _level_ratio(self, displacement: np.ndarray, first: int, last: int) -> float:
        """What the level says for a displacement between two edges or ends, and against it beyond an end."""
        inside = np.arange(self.frames[first], self.frames[last])
        apart = intervals.samples(self.options.level_window_s, self.rate)
        ratio = self.evidence.log_ratio(displacement, inside)
        ratio += self.evidence.recurrence(displacement, inside, apart=apart)
        for end, edge, beyond in ((first, last, self.beyond[0]), (last, first, self.beyond[1])):
            if end in (0, len(self.frames) - 1):
                if len(beyond):
                    ratio = min(ratio, -self.evidence.log_ratio(displacement, beyond))
                elif self.edges[edge - 1].score < self.options.recording_end_factor:
                    return -np.inf
        return ratio

    def _displacements(self, first: int, last: int) -> list[np.ndarray]:
        """The displacements to which the first of two edges leads and from which the last returns; an end has none."""
        known = [(sign, node - 1) for sign, node in ((1, first), (-1, last)) if 0 < node <= len(self.edges)]
        return [sign * self.edges[k].jump for sign, k in known]


def explanations(
    edges: Sequence[Edge], evidence: LevelEvidence, *, missing: np.ndarray, rate: float, options: StepsOptions
) -> list[Explanations]:
    """Make the explanations of each run of frames in which a marker is observed and has an edge.

    Parameters
    ----------
    edges : Sequence[Edge]
        The edges of the marker, by frame.
    evidence : LevelEvidence
        What the level of the marker says.
    missing : np.ndarray
        Where the marker is not observed, bool (frames,): no level shift goes on across such frames.
    rate : float
        Sampling rate, Hz.
    options : StepsOptions
        Lengths and thresholds of a step and its two jumps, context, and attribution.

    Returns
    -------
    list[Explanations]
        The explanations, by frame.
    """
    seen, reach = np.flatnonzero(~missing), intervals.samples(options.level_window_s, rate)
    made = []
    for start, stop in intervals.runs(~missing):
        own = [edge for edge in edges if start < edge.frame < stop]
        beyond = seen[seen < start][-reach:], seen[seen >= stop][:reach]
        if own:
            made.append(Explanations(own, (start, stop), beyond, evidence, rate, options))
    return made
