"""Probabilistic model averaging: several predictors of one gap, weighted by how likely and how good each is.

The likelihood of a member's positions comes from their distances to the marker's references (tits2018). How good it is
for this marker and this length is measured on pseudo-gaps: stretches of the same marker, hidden together with the
markers that the real gap misses. They also calibrate the error that is stated for every sample.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from markermend.filling.constraints import constrain_time
from markermend.filling.distance_likelihood import Distances
from markermend.filling.member_weights import (
    Trust,
    expected_errors,
    shares,
    squared_errors,
    stated_scale,
    typical_errors,
)
from markermend.filling.model_averaging import weighted_mean
from markermend.filling.pseudo_gaps import pseudo_gaps
from markermend.options.filling import DistanceOptions, EnsembleOptions
from markermend.prediction.interpolation import KINDS
from markermend.prediction.scene import Predictor, Scene, Trainable


@dataclass(frozen=True)
class Sort:
    """What gaps of a marker have in common: about their length, whether they are at the start or end, who is missing."""

    marker: int
    size: int
    ends: tuple[bool, bool]
    absent: frozenset[int]


@dataclass(frozen=True)
class Filling:
    """What to write into a gap of n frames.

    positions: (n, 3), mm, NaN where no member can tell. deviation: (n,), mm, standard deviation of each axis. weights:
    the members' mean shares.
    """

    positions: np.ndarray
    deviation: np.ndarray
    weights: dict[str, float]


@dataclass(frozen=True)
class _Candidates:
    """What the members say on one gap: positions (members, n, 3) after the time constraint, errors (members, n), mm."""

    positions: np.ndarray
    errors: np.ndarray


class Ensemble:
    """Predictors that fill gaps together."""

    def __init__(
        self, members: Sequence[Predictor], trial_members: Sequence[Predictor], options: EnsembleOptions
    ) -> None:
        """trial_members: what stands for each member on pseudo-gaps, such as the same with less training."""
        if [member.name for member in members] != [member.name for member in trial_members]:
            raise ValueError("trial members differ from the members")
        self.members, self.trial_members = tuple(members), tuple(trial_members)
        self.options = options
        self._judging = DistanceOptions(**options.distances)  # type: ignore[arg-type]

    def sort(self, scene: Scene, marker: int, start: int, stop: int, known: Collection[Sort]) -> Sort:
        """The sort of gap that this is: what try_out tells of one holds for all of its sort.

        known: the sorts of before. Where these are many of the marker, it is the one most alike of those.
        """
        near = np.asarray(scene.neighbours[marker], int)[: self.options.similar_neighbours]
        absent = np.flatnonzero(~scene.present[start:stop, near].all(axis=0))
        size = math.floor(math.log(stop - start, self.options.similar_length))
        ends = start == 0, stop == len(scene.positions)
        own = Sort(marker, size, ends, frozenset(near[absent].tolist()))
        before = [sort for sort in known if sort.marker == marker]
        alike = [sort for sort in before if sort.ends == ends]
        if own in known or len(before) < self.options.most_sorts or not alike:
            return own
        return min(alike, key=lambda sort: (abs(sort.size - size), len(sort.absent ^ own.absent), sorted(sort.absent)))

    def train(self, jobs: Sequence[tuple[Scene, int]]) -> None:
        """Let the members that learn faster together learn for each scene and marker."""
        _train(self.members, jobs)

    def try_out(self, scene: Scene, marker: int, start: int, stop: int) -> Trust:
        """Measure on pseudo-gaps what to think of the members on gaps such as [start, stop)."""
        hidden = scene.without(marker, start, stop)
        options = self.options
        trials = pseudo_gaps(
            hidden,
            marker,
            start,
            stop,
            count=options.pseudo_gaps,
            share=options.hidden_share,
            company=options.similar_neighbours,
        )
        _train(self.trial_members, list({id(trial.scene): (trial.scene, marker) for trial in trials}.values()))
        tried = [self._candidates(self.trial_members, trial.scene, marker, trial.start, trial.stop) for trial in trials]
        errors = squared_errors(
            [trial.truth for trial in trials], [each.positions for each in tried], len(self.members)
        )
        distances = self._distances(hidden, marker)
        ratios, missed, prior = np.full(len(trials), np.nan), [], options.prior
        for k, (trial, candidates) in enumerate(zip(trials, tried, strict=True)):
            others = self._trust(np.delete(errors, k, axis=0))
            guess, stated, _ = self._average(trial.scene, distances, trial.start, candidates, others)
            missed.append(np.linalg.norm(guess - trial.truth, axis=1) / stated)
            known = missed[-1][~np.isnan(missed[-1])]
            ratios[k] = (known**2).mean() / 3 if len(known) else np.nan
        scaled = [values / stated_scale(np.delete(ratios, k), prior) for k, values in enumerate(missed)]
        # Tried on shorter stretches only, errors are taken to grow as a random walk does.
        beyond = math.sqrt((stop - start) / (trials[0].stop - trials[0].start)) if trials else 1.0
        return replace(self._trust(errors), scale=beyond * stated_scale(ratios, prior), missed=tuple(scaled))

    def fill(self, scene: Scene, marker: int, start: int, stop: int, trust: Trust) -> Filling:
        """Fill one gap. The marker's samples in [start, stop) are not looked at."""
        hidden = scene.without(marker, start, stop)
        candidates = self._candidates(self.members, hidden, marker, start, stop)
        distances = self._distances(hidden, marker)
        positions, stated, means = self._average(hidden, distances, start, candidates, trust)
        deviation = np.where(np.isnan(positions).any(axis=1), np.nan, stated * trust.scale)
        if scene.inherited_std is not None:
            deviation = np.hypot(deviation, self._inherited(hidden, marker, start, stop, scene.inherited_std))
        named = {member.name: float(share) for member, share in zip(self.members, means, strict=True) if share > 0}
        return Filling(positions, deviation, named)

    def _inherited(self, scene: Scene, marker: int, start: int, stop: int, doubt: np.ndarray) -> np.ndarray:
        """Mean doubt (n,), mm, of the nearest neighbours seen in each frame: what filled neighbours have in common."""
        near = np.asarray(scene.neighbours[marker], int)
        seen = scene.present[start:stop, near]
        used = seen & (np.cumsum(seen, axis=1) <= self._judging.references)
        return np.where(used, doubt[start:stop, near], 0.0).sum(axis=1) / np.maximum(used.sum(axis=1), 1)

    def _candidates(
        self, members: Sequence[Predictor], scene: Scene, marker: int, start: int, stop: int
    ) -> _Candidates:
        """Ask every member."""
        positions = np.full((len(members), stop - start, 3), np.nan)
        errors = np.full((len(members), stop - start), np.nan)
        borders = np.full((2, 3), np.nan)
        for side, frame in enumerate((start - 1, stop)):
            if 0 <= frame < len(scene.positions):
                borders[side] = scene.positions[frame, marker]
        body = [member.name not in KINDS for member in members]
        for k, member in sorted(enumerate(members), key=lambda pair: pair[1].name in self.options.fallback):
            if stop - start > self.options.longest_s.get(member.name, np.inf) * scene.rate:
                continue
            if member.name in self.options.fallback and not np.isnan(positions[body]).any(axis=(1, 2)).all():
                continue
            predicted = member.predict(scene, marker, start, stop)
            course = predicted.positions if member.continuous else constrain_time(predicted.positions, borders)
            positions[k], errors[k] = course[1:-1], predicted.error[1:-1]
        return _Candidates(positions, errors)

    def _trust(self, errors: np.ndarray) -> Trust:
        """What to think of the members after errors on pseudo-gaps as from squared_errors."""
        options, typical = self.options, typical_errors(errors)
        if options.weights in ("pma", "equal"):
            return Trust(typical, np.ones(len(typical)), 1.0, ())
        weights = shares(typical, power=options.power, worst=options.worst, least=options.error_mm)
        return Trust(typical, weights, 1.0, ())

    def _distances(self, scene: Scene, marker: int) -> Distances:
        """What distances of the marker to others usually are."""
        return scene.cached((self, "distances", marker), partial(Distances.learn, scene, marker, self._judging))

    def _average(
        self,
        scene: Scene,
        distances: Distances,
        start: int,
        candidates: _Candidates,
        trust: Trust,
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Weighted mean (n, 3), its stated standard deviation (n,) per axis, and the members' mean shares."""
        body = scene.positions[start : start + candidates.positions.shape[1]]
        weights = np.broadcast_to(trust.shares[:, None], candidates.errors.shape)
        if self.options.weights in ("pma", "both"):
            weights = weights * distances.likelihood(candidates.positions, body)
        positions, weights = weighted_mean(candidates.positions, weights)
        errors = np.maximum(expected_errors(candidates.errors, trust.typical, weights), self.options.error_mm)
        # The variance of a mixture: what the members state, and how far apart they are.
        apart = ((np.nan_to_num(candidates.positions) - positions) ** 2).mean(axis=2)
        variance = (weights * (errors**2 + np.where(weights > 0, apart, 0))).sum(axis=0)
        return distances.constrained(positions, body), np.sqrt(variance), weights.mean(axis=1)


def _train(members: Sequence[Predictor], jobs: Sequence[tuple[Scene, int]]) -> None:
    """Let those of the members that can learn for all jobs at once."""
    for member in members:
        if isinstance(member, Trainable):
            member.train(jobs)
