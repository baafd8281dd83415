"""An ensemble of predictors fills a gap with the weighted mean of their predictions.

Members are weighted by their errors on pseudo-gaps, by the likelihood of the distances to the marker's references
(tits2018), or both. Pseudo-gaps also calibrate the standard deviation that is stated for every filled sample.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.filling.averaging import Averaging
from markermend.filling.candidates import Candidates, predict_candidates
from markermend.filling.distance_likelihood import DistanceModel
from markermend.filling.gap import Gap, GapKind, gap_kind, known_kind
from markermend.filling.member_weights import Evaluation, MemberWeights, deviation_scale, squared_errors
from markermend.filling.motion import motion_ratio, neighbour_motion
from markermend.filling.pseudo_gaps import PseudoGap, pseudo_gaps
from markermend.options.filling import EnsembleOptions
from markermend.prediction.interface import Abridgeable, Predictor, Trainable
from markermend.prediction.interpolation import KINDS
from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class Filling:
    """What to write into a gap of n frames.

    Attributes
    ----------
    positions : ndarray, shape (n, 3)
        Positions, mm; NaN where no member has a prediction.
    deviation : ndarray, shape (n,)
        Standard deviation of each axis, mm; NaN where unknown.
    weights : dict of str to float
        Mean weight of each member that has any, by its name; the sum is 1.
    """

    positions: np.ndarray
    deviation: np.ndarray
    weights: dict[str, float]

    def part(self, start: int, stop: int) -> Filling:
        """Take some frames.

        Parameters
        ----------
        start, stop : int
            The frames [start, stop), counted from the first of the filling.

        Returns
        -------
        Filling
            What to write into them; the weights remain those of the whole.
        """
        return Filling(self.positions[start:stop], self.deviation[start:stop], self.weights)


class Ensemble:
    """Predictors that fill gaps together.

    Parameters
    ----------
    members : sequence of Predictor
        The predictors.
    options : EnsembleOptions
        How they are weighted.
    """

    def __init__(self, members: Sequence[Predictor], options: EnsembleOptions) -> None:
        self.members, self.options = tuple(members), options
        self.trial_members = tuple(each.abridged() if isinstance(each, Abridgeable) else each for each in members)
        self._averaging = Averaging(options)
        self._motion_powers = np.array([options.motion_power_of_member.get(member.name, 0.0) for member in members])
        self._use_neighbours = np.array([member.name not in KINDS for member in members], bool)

    def kind(self, scene: Scene, gap: Gap, known: Collection[GapKind]) -> GapKind:
        """Find the kind of a gap; the result of `evaluate` for one gap holds for all gaps of its kind.

        Parameters
        ----------
        scene : Scene
            The recording.
        gap : Gap
            The gap.
        known : collection of GapKind
            Kinds of earlier gaps, which stand in for a new one where the marker has many.

        Returns
        -------
        GapKind
            The kind, one of `known` or a new one.
        """
        options = self.options
        own = gap_kind(scene, gap, length_ratio=options.max_length_ratio, neighbours=options.compared_neighbours)
        return known_kind(own, known, max_kinds=options.max_gap_kinds)

    def train(self, jobs: Sequence[tuple[Scene, int]]) -> None:
        """Train the members that are trained faster for several markers at once.

        Parameters
        ----------
        jobs : sequence of tuple
            Scenes and the markers that will be filled in them.
        """
        _train(self.members, jobs)

    def evaluate(self, scene: Scene, gap: Gap) -> Evaluation:
        """Measure the errors of the members on pseudo-gaps.

        Parameters
        ----------
        scene : Scene
            The recording; the samples of the gap are not used.
        gap : Gap
            The gap to imitate.

        Returns
        -------
        Evaluation
            Errors of the members, and how far the stated standard deviations hold.
        """
        hidden, options = scene.without(gap.marker, gap.start, gap.stop), self.options
        trials = pseudo_gaps(hidden, gap, options)
        _train(self.trial_members, list({id(trial.scene): (trial.scene, gap.marker) for trial in trials}.values()))
        candidates = [self._candidates(self.trial_members, trial.scene, trial.gap) for trial in trials]
        errors = squared_errors(
            [trial.truth for trial in trials], [each.positions for each in candidates], len(self.members)
        )
        missed = self._cross_validate(self._averaging.distance_model(hidden, gap.marker), trials, candidates, errors)
        ratios = np.array([_mean_square(each) for each in missed])
        # The factor for each pseudo-gap is estimated from the others.
        scaled = [
            each / deviation_scale(np.delete(ratios, k), options.stated_error_weight) for k, each in enumerate(missed)
        ]
        scale = deviation_scale(ratios, options.stated_error_weight)
        return Evaluation(errors, np.array([trial.motion for trial in trials]), scale, tuple(scaled))

    def fill(self, scene: Scene, gap: Gap, evaluation: Evaluation) -> Filling:
        """Fill one gap.

        Parameters
        ----------
        scene : Scene
            The recording; the samples of the gap are not used.
        gap : Gap
            The gap.
        evaluation : Evaluation
            Result of `evaluate` for the kind of the gap.

        Returns
        -------
        Filling
            Positions, their standard deviation, and the weights used.
        """
        hidden = scene.without(gap.marker, gap.start, gap.stop)
        candidates = self._candidates(self.members, hidden, gap)
        observed = hidden.positions[gap.start : gap.stop]
        distances = self._averaging.distance_model(hidden, gap.marker)
        weights, growth = self._weigh(evaluation.errors, evaluation.motions, self._motion(scene, gap))
        average = self._averaging.average(candidates, weights, distances, observed)
        unknown = np.isnan(average.positions).any(axis=1)
        deviation = np.where(unknown, np.nan, average.deviation * growth * evaluation.deviation_scale)
        if scene.inherited_std is not None:
            inherited = _inherited_deviation(hidden, gap, scene.inherited_std, self.options.distances.references)
            # What makes neighbours err, such as an unusual pose, makes the marker err, too: the errors add up. Interpolations in
            # time do not look at neighbours.
            deviation = deviation + average.weights[self._use_neighbours].sum() * inherited
        shares = zip(self.members, average.weights, strict=True)
        return Filling(
            average.positions, deviation, {member.name: float(share) for member, share in shares if share > 0}
        )

    def _candidates(self, members: Sequence[Predictor], scene: Scene, gap: Gap) -> Candidates:
        """Predict a gap with every member."""
        return predict_candidates(members, scene, gap, options=self.options)

    def _motion(self, scene: Scene, gap: Gap) -> float:
        """How much neighbours move during a gap, mm; NaN where unknown."""
        neighbours = self.options.motion_neighbours
        (motion,) = neighbour_motion(scene, gap, np.array([gap.start]), length=gap.length, neighbours=neighbours)
        return float(motion)

    def _weigh(self, errors: np.ndarray, motions: np.ndarray, motion: float) -> tuple[MemberWeights, float]:
        """Weights of the members where neighbours move so much, mm, and the factor by which their errors are larger there.

        errors: (pseudo-gaps, 2, members), motions: (pseudo-gaps,), mm, of the pseudo-gaps.
        """
        ratio = motion_ratio(motion, motions, min_motion_mm=self.options.min_error_mm)
        return self._averaging.weigh(errors, ratio**self._motion_powers), ratio**self.options.stated_motion_power

    def _cross_validate(
        self,
        distances: DistanceModel | None,
        trials: Sequence[PseudoGap],
        candidates: Sequence[Candidates],
        errors: np.ndarray,
    ) -> list[np.ndarray]:
        """Errors on each pseudo-gap in stated standard deviations, with weights from the other pseudo-gaps alone."""
        missed, motions = [], np.array([trial.motion for trial in trials])
        for k, (trial, own) in enumerate(zip(trials, candidates, strict=True)):
            others, growth = self._weigh(np.delete(errors, k, axis=0), np.delete(motions, k), trial.motion)
            observed = trial.scene.positions[trial.gap.start : trial.gap.stop]
            average = self._averaging.average(own, others, distances, observed)
            missed.append(np.linalg.norm(average.positions - trial.truth, axis=1) / (growth * average.deviation))
        return missed


def _mean_square(missed: np.ndarray) -> float:
    """Mean square per axis of the known among standardized distances (n,); NaN where none is known."""
    known = missed[~np.isnan(missed)]
    return float((known**2).mean() / 3) if len(known) else np.nan


def _inherited_deviation(scene: Scene, gap: Gap, deviation: np.ndarray, neighbours: int) -> np.ndarray:
    """Inherited standard deviation (n,), mm: the mean of those of the nearest neighbours seen in each frame.

    deviation: (frames, markers), mm, of samples filled earlier. It is the error that filled neighbours have in common.
    """
    near = np.asarray(scene.neighbours[gap.marker], int)
    seen = scene.present[gap.start : gap.stop, near]
    used = seen & (np.cumsum(seen, axis=1) <= neighbours)
    total = np.where(used, deviation[gap.start : gap.stop, near], 0.0).sum(axis=1)
    inherited: np.ndarray = total / np.maximum(used.sum(axis=1), 1)
    return inherited


def _train(members: Sequence[Predictor], jobs: Sequence[tuple[Scene, int]]) -> None:
    """Train those of the members that can be trained for all jobs at once."""
    for member in members:
        if isinstance(member, Trainable):
            member.train(jobs)
