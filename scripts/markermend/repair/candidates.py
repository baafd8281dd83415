"""What each method offers for one finding, what it is expected to err by, and which offer is taken, if any."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from markermend.core.reasons import Cause, Limit, Reason
from markermend.numerics.intervals import samples
from markermend.options.repair import RepairOptions, SeparationOptions
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.scene import Prediction, Predictor, Scene
from markermend.repair.methods import Proposal, predicted, separated, smoothed
from markermend.repair.separation import SHAPE_COVARIANCES


@dataclass(frozen=True)
class Offer:
    """A proposal, and what it would make better.

    expected: the largest expected error, mm (68 %). change: the largest change to what was measured, mm. before, after:
    root mean square distance, mm, of what was measured and of what is proposed from where the neighbours say; NaN where
    they cannot tell, or where the proposal weighs what they say against what was measured. blur: how far from there the true position may well be (95 %), mm.
    """

    proposal: Proposal
    expected: float
    change: float
    before: float
    after: float
    blur: float

    @property
    def no_better(self) -> Reason | None:
        """Why the recording would be no better for it, or None."""
        if self.expected > self.change:
            text = f"expected error {self.expected:.1f} mm for a change of {self.change:.1f} mm"
            return Reason(Cause.NO_BETTER, text)
        if self.after > max(self.before, self.blur):
            text = f"{self.after:.1f} mm from where the neighbours predict it, measured {self.before:.1f} mm"
            return Reason(Cause.NO_BETTER, text)
        return None

    def against(self, limit_mm: float) -> Reason | None:
        """Give the reason why it is not taken.

        Parameters
        ----------
        limit_mm
            The largest expected error that is accepted, mm: the option `max_error_mm`.

        Returns
        -------
        Reason or None
            The reason, None where it may be taken.
        """
        if self.no_better or self.expected <= limit_mm:
            return self.no_better
        limit = Limit("repair.max_error_mm", limit_mm, self.expected)
        text = f"expected error {self.expected:.1f} mm ({limit.text})"
        return Reason(Cause.UNCERTAIN, text, limit)


def choose(offers: Iterable[Offer], *, limit_mm: float, prefer: float) -> Offer | None:
    """The first of the offers that can be trusted whose expected error is within `prefer` times the least of them.

    limit_mm: largest expected error. None where none can be trusted, or where the surest would change less than it may
    err: then what was measured is as good as any.
    """
    told = list(offers)
    surest = min(told, key=lambda offer: offer.expected, default=None)
    if surest is None or surest.expected > surest.change:
        return None
    trusted = [offer for offer in told if offer.against(limit_mm) is None]
    least = min((offer.expected for offer in trusted), default=0.0)
    return next((offer for offer in trusted if offer.expected <= prefer * least), None)


def misfit(positions: np.ndarray, expected: np.ndarray) -> float:
    """Root mean square distance, mm, between positions (n, 3) over the samples that both have; NaN without any."""
    squared = ((positions - expected) ** 2).sum(axis=1)
    known = squared[~np.isnan(squared)]
    return float(np.sqrt(known.mean())) if len(known) else float("nan")


@dataclass(frozen=True)
class Offers:
    """Asks the methods what they offer.

    positions: (frames, markers, 3), mm, as measured. flagged: bool (frames, markers), samples that were found. scene: all
    that was not. predictors: by name; `local_ridge` tells where the neighbours say a marker is, without it nothing does.
    """

    positions: np.ndarray
    flagged: np.ndarray
    scene: Scene
    predictors: Mapping[str, Predictor]
    options: RepairOptions

    def of(self, methods: Iterable[str], m: int, start: int, stop: int) -> list[Offer]:
        """The offers for marker m over [start, stop), of the methods that can tell, in their order."""
        measured, told = self.positions[start:stop, m], self._told(m, start, stop)
        expected, radius = told.positions, self.options.radius
        blur = radius["outer"] * float(np.sqrt(np.mean(told.error**2)))
        proposals = [self._propose(method, m, start, stop) for method in methods if method not in ("exchange", "blank")]
        return [
            Offer(
                proposal,
                float(np.max(proposal.error)) * radius["inner"],
                float(np.nanmax(np.linalg.norm(proposal.positions - measured, axis=1))),
                misfit(measured, expected),
                np.nan
                if proposal.method in SHAPE_COVARIANCES
                else misfit(np.where(np.isnan(measured), np.nan, proposal.positions), expected),
                blur,
            )
            for proposal in proposals
            if proposal is not None
        ]

    @cached_property
    def _ridges(self) -> list[LocalRidge]:
        """The local ridges whose predictions are parted from artifacts; none without the shared one."""
        shared = self.predictors.get("local_ridge")
        if not isinstance(shared, LocalRidge):
            return []
        ridges = self.options.separation["ridges"]
        return [LocalRidge(replace(shared.options, **own)) if own else shared for own in ridges]

    def _told(self, m: int, start: int, stop: int) -> Prediction:
        """Where the neighbours, and the marker's own course around, say that marker m is over [start, stop)."""
        if "local_ridge" not in self.predictors:
            return Prediction(np.full((stop - start, 3), np.nan), np.full(stop - start, np.nan))
        told = self.predictors["local_ridge"].predict(self.scene, m, start, stop)
        return Prediction(told.positions[1:-1], told.error[1:-1])

    def worse_swapped(self, members: Sequence[int], partners: Sequence[int], start: int, stop: int) -> Reason | None:
        """Why markers would be no nearer to where they should be with the samples of their partners, or None."""
        expected = np.concatenate([self._told(m, start, stop).positions for m in members])
        measured, exchanged = (
            np.concatenate([self.positions[start:stop, m] for m in own]) for own in (members, partners)
        )
        both = np.isnan(measured + exchanged + expected)
        # Where a sample has no counterpart, the exchange is judged by those that have; if none has, by what there is.
        expected = expected if both.all() else np.where(both, np.nan, expected)
        before, after = (misfit(part, expected) for part in (measured, exchanged))
        if after > before:
            figures = f"{after:.1f} mm from where the neighbours predict them, measured {before:.1f} mm"
            return Reason(Cause.NO_BETTER, f"no better with labels exchanged: {figures}")
        return None

    def _propose(self, method: str, m: int, start: int, stop: int) -> Proposal | None:
        """What a method would write, or None where it cannot tell for every sample."""
        options, original = self.options, self.positions[:, m]
        if method == "savitzky_golay":
            window = samples(options.savitzky_golay_s, self.scene.rate, odd=True)
            return smoothed(
                original, self.flagged[:, m], start, stop, window=window, order=options.savitzky_golay_order
            )
        if method in SHAPE_COVARIANCES:
            if not self._ridges:
                return None
            settings = SeparationOptions(**options.separation)
            return separated(method, original, self._ridges, self.scene, m, start, stop, options=settings)
        return predicted(self.predictors[method], self.scene, m, start, stop, trials=options.trials)
