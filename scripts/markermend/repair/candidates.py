"""Candidates for the repair of one finding: what each method proposes, its expected error, and which one is taken, if any."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from markermend.core.reasons import Cause, Limit, Reason
from markermend.numerics.intervals import samples
from markermend.options.repair import RepairOptions
from markermend.prediction.interface import Prediction, Predictor
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.scene import Scene
from markermend.repair.level_separation import separate_levels
from markermend.repair.methods import Proposal, predicted, smoothed
from markermend.repair.separation import SHAPE_COVARIANCES
from markermend.repair.separator import Separator
from markermend.repair.shape_guard import ShapeGuard

NOT_PROPOSING = frozenset(("exchange", "move_back", "blank"))
"""Methods that propose no samples of their own."""


@dataclass(frozen=True)
class Candidate:
    """A proposal, with the figures by which it is compared with what was measured.

    Attributes
    ----------
    proposal : Proposal
        The samples that would be written.
    expected_error : float
        The largest expected error (68 %), mm.
    largest_change : float
        The largest change of a measured sample, mm.
    misfit_before, misfit_after : float
        Root mean square distance of what was measured, and of what is proposed, from the prediction by the neighbours, mm;
        NaN where there is no prediction, or where the proposal already weighs the prediction against what was measured, or only
        its changes.
    prediction_radius : float
        Radius around the prediction that holds the true position with probability 0.95, mm.
    shape_objection : Reason, optional
        Why the distances to the steadiest neighbours speak against the proposal; None where they do not.
    """

    proposal: Proposal
    expected_error: float
    largest_change: float
    misfit_before: float
    misfit_after: float
    prediction_radius: float
    shape_objection: Reason | None = None

    @property
    def reason_no_better(self) -> Reason | None:
        """Why the recording would be no better with it, None where it would."""
        if self.expected_error > self.largest_change:
            text = f"expected error {self.expected_error:.1f} mm for a change of {self.largest_change:.1f} mm"
            return Reason(Cause.NO_BETTER, text)
        if self.misfit_after > max(self.misfit_before, self.prediction_radius):
            figures = f"{self.misfit_after:.1f} mm from where the neighbours predict it"
            return Reason(Cause.NO_BETTER, f"{figures}, measured {self.misfit_before:.1f} mm")
        return self.shape_objection

    def reason_against(self, max_error_mm: float) -> Reason | None:
        """Find the reason why it is not taken.

        Parameters
        ----------
        max_error_mm : float
            The largest expected error that is accepted, mm.

        Returns
        -------
        Reason or None
            The reason; None where it may be taken.
        """
        if self.reason_no_better or self.expected_error <= max_error_mm:
            return self.reason_no_better
        limit = Limit("repair.max_error_mm", max_error_mm, self.expected_error)
        return Reason(Cause.UNCERTAIN, f"expected error {self.expected_error:.1f} mm ({limit.text})", limit)


def choose(candidates: Sequence[Candidate], *, max_error_mm: float, preference_factor: float) -> Candidate | None:
    """Choose the candidate to take.

    Parameters
    ----------
    candidates : sequence of Candidate
        The candidates in order of preference.
    max_error_mm : float
        The largest expected error that is accepted, mm.
    preference_factor : float
        The first candidate whose expected error is within this factor of the least is taken.

    Returns
    -------
    Candidate or None
        None where none can be taken, or where the one of least expected error would change less than its
        expected error: then what was measured is as good as any.
    """
    best = min(candidates, key=lambda candidate: candidate.expected_error, default=None)
    if best is None or best.expected_error > best.largest_change:
        return None
    acceptable = [candidate for candidate in candidates if candidate.reason_against(max_error_mm) is None]
    least = min((candidate.expected_error for candidate in acceptable), default=0.0)
    return next((own for own in acceptable if own.expected_error <= preference_factor * least), None)


def rms_distance(positions: np.ndarray, expected: np.ndarray) -> float:
    """Compute the root mean square distance between positions.

    Parameters
    ----------
    positions, expected : ndarray of float, shape (n, 3)
        Positions, mm; only samples that both have count.

    Returns
    -------
    float
        The distance, mm; NaN without any such sample.
    """
    squared = ((positions - expected) ** 2).sum(axis=1)
    known = squared[~np.isnan(squared)]
    return float(np.sqrt(known.mean())) if len(known) else float("nan")


@dataclass(frozen=True)
class CandidateMaker:
    """The trajectories of a recording, and the methods that propose repairs of them.

    Attributes
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        Positions as measured, mm.
    flagged : ndarray of bool, shape (frames, markers)
        The samples that were found.
    scene : Scene
        The trajectories without them.
    predictors : mapping of str to Predictor
        The predictors by name; `local_ridge` gives the prediction by the neighbours with which proposals are compared.
    options : RepairOptions
        Options of the methods.
    guard : ShapeGuard
        Judges proposals by the distances to the steadiest neighbours.
    """

    positions: np.ndarray
    flagged: np.ndarray
    scene: Scene
    predictors: Mapping[str, Predictor]
    options: RepairOptions
    guard: ShapeGuard

    def candidates(self, methods: Iterable[str], m: int, start: int, stop: int) -> list[Candidate]:
        """Make the candidates for a finding.

        Parameters
        ----------
        methods : iterable of str
            Names of methods.
        m : int
            Index of the marker.
        start, stop : int
            The interval.

        Returns
        -------
        list of Candidate
            Those of the methods that can be applied, in their order; none where no sample was seen, which is a gap.
        """
        measured = self.positions[start:stop, m]
        if np.isnan(measured).all():
            return []
        prediction = self._prediction(m, start, stop)
        radius = self.options.radius.outer * float(np.sqrt(np.mean(prediction.error**2)))
        proposals = [self._propose(method, m, start, stop) for method in methods if method not in NOT_PROPOSING]
        return [
            replace(
                self._candidate(proposal, measured, prediction.positions, radius),
                shape_objection=self._shape_objection(proposal, m, start, measured),
            )
            for proposal in proposals
            if proposal is not None
        ]

    def _shape_objection(self, proposal: Proposal, m: int, start: int, measured: np.ndarray) -> Reason | None:
        """Why the distances to the steadiest neighbours speak against a proposal for marker m from a frame on."""
        levels = proposal.method == "separate_levels"
        judge = self.guard.objection_to_level if levels else self.guard.objection
        return judge(m, start, measured, proposal.positions)

    def _candidate(self, proposal: Proposal, measured: np.ndarray, expected: np.ndarray, radius: float) -> Candidate:
        """A proposal, compared with what was measured and with the prediction by the neighbours, each (n, 3), mm."""
        after = np.nan
        if proposal.method not in (*SHAPE_COVARIANCES, "separate_levels"):
            after = rms_distance(np.where(np.isnan(measured), np.nan, proposal.positions), expected)
        return Candidate(
            proposal,
            expected_error=float(np.max(proposal.error)) * self.options.radius.inner,
            largest_change=float(np.nanmax(np.linalg.norm(proposal.positions - measured, axis=1))),
            misfit_before=rms_distance(measured, expected),
            misfit_after=after,
            prediction_radius=radius,
        )

    @cached_property
    def _ridges(self) -> list[LocalRidge]:
        """The local ridges whose predictions are separated from artifacts; none without the shared one."""
        shared = self.predictors.get("local_ridge")
        if not isinstance(shared, LocalRidge):
            return []
        ridges = self.options.separation.local_ridge_changes
        return [LocalRidge(replace(shared.options, **own)) if own else shared for own in ridges]

    def _prediction(self, m: int, start: int, stop: int) -> Prediction:
        """The prediction of marker m by its neighbours, and its own trajectory around, over [start, stop)."""
        if "local_ridge" not in self.predictors:
            return Prediction(np.full((stop - start, 3), np.nan), np.full(stop - start, np.nan))
        prediction = self.predictors["local_ridge"].predict(self.scene, m, start, stop)
        return Prediction(prediction.positions[1:-1], prediction.error[1:-1])

    def _levels(self, m: int, start: int, stop: int) -> Proposal | None:
        """The samples of marker m as if it flickered between two levels, see `separate_levels`."""
        ridge = self.predictors.get("local_ridge")
        if ridge is None:
            return None
        # At an end of the recording there is no sample beside the finding.
        padded = np.pad(self.positions[:, m], ((1, 1), (0, 0)), constant_values=np.nan)[start : stop + 2]
        seen = np.pad(self.scene.present[:, m], 1)
        return separate_levels(
            padded,
            ridge.predict(self.scene, m, start, stop).positions,
            outside=(bool(seen[start]), bool(seen[stop + 1])),
            options=self.options.separation,
        )

    def worse_exchanged(self, members: Sequence[int], partners: Sequence[int], start: int, stop: int) -> Reason | None:
        """Find the reason why markers would be no better with the samples of their partners.

        Parameters
        ----------
        members, partners : sequence of int
            Indices of the markers, and of the partner of each.
        start, stop : int
            The interval.

        Returns
        -------
        Reason or None
            The reason; None where they would be nearer to where their neighbours predict them.
        """
        expected = np.concatenate([self._prediction(m, start, stop).positions for m in members])
        measured, exchanged = (
            np.concatenate([self.positions[start:stop, m] for m in own]) for own in (members, partners)
        )
        unpaired = np.isnan(measured + exchanged + expected)
        # Where a sample has no counterpart, the exchange is judged by those that have; if none has, by what there is.
        expected = expected if unpaired.all() else np.where(unpaired, np.nan, expected)
        before, after = (rms_distance(part, expected) for part in (measured, exchanged))
        if after > before:
            figures = f"{after:.1f} mm from where the neighbours predict them, measured {before:.1f} mm"
            return Reason(Cause.NO_BETTER, f"no better with labels exchanged: {figures}")
        return None

    def _propose(self, method: str, m: int, start: int, stop: int) -> Proposal | None:
        """What a method would write; None where it cannot be applied to every sample."""
        options, original = self.options, self.positions[:, m]
        if method == "savitzky_golay":
            window = samples(options.savitzky_golay_window_s, self.scene.rate, odd=True)
            return smoothed(
                original, self.flagged[:, m], start, stop, window=window, order=options.savitzky_golay_order
            )
        if method == "separate_levels":
            return self._levels(m, start, stop)
        if method in SHAPE_COVARIANCES:
            if not self._ridges:
                return None
            return Separator(self._ridges, self.scene, options.separation).propose(method, original, m, start, stop)
        return predicted(self.predictors[method], self.scene, m, start, stop, trials=options.hidden_stretches)
