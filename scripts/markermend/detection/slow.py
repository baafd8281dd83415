"""Slow changes: a marker drifts away from where its neighbours predict it, and comes back (skurowski2022 3.5).

Natural motion leaves residuals as large as the drift. Two things distinguish a drift: its course (it rises and falls within
seconds, from baseline to baseline), and the local scale, which is larger where the pose has high leverage, where
the body moves fast, and where the neighbours fit badly as well.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.detection import inputs
from markermend.detection.neighbour.drifts.attribution import DriftAttribution
from markermend.detection.neighbour.drifts.estimated import EstimatedDrifts
from markermend.detection.neighbour.drifts.evidence import EstimatedDriftEvidence, MatchedDriftEvidence
from markermend.detection.neighbour.drifts.matched import MatchedDrifts
from markermend.detection.neighbour.drifts.regression import DriftRegression
from markermend.detection.neighbour.drifts.scores import DriftScorer
from markermend.detection.neighbour.drifts.smallest import SmallestDriftPredictor
from markermend.detection.neighbour.lasting.creeps import EstimatedCreeps
from markermend.detection.neighbour.lasting.shifts import LastingFinder, not_explained
from markermend.options.detection.slow import SlowOptions
from markermend.prediction.interface import LocalRegression, ScaledResidualSource
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.scene import Scene

STATED_DIGITS = 1
"""Decimals of the heights of the smallest drifts, mm."""


def detect_slow(
    scene: Scene, *, markers: Sequence[str], earlier: np.ndarray, options: SlowOptions, predictor: LocalRidge
) -> tuple[list[Event], dict[str, float | None]]:
    """Find the slow changes of a recording, and say which would have been found.

    Parameters
    ----------
    scene : Scene
        What is observed; nothing is found where it is missing.
    markers : Sequence[str]
        Names of the markers.
    earlier : np.ndarray
        What earlier detectors claimed, bool, like the positions.
    options : SlowOptions
        Durations, thresholds, local scale, and attribution.
    predictor : LocalRidge
        Predicts each marker from its neighbours; some of its options are changed.

    Returns
    -------
    found : list[Event]
        Events, sorted; those of one kind are disjoint, and a drift may lie within a creep.
    smallest : dict[str, float | None]
        Height of the smallest drift of each marker, of `estimated_drifts.stated_duration_s`, that would have been found, mm; None
        where that cannot be said: the motion of the marker, or of most of its neighbours, is too fast or too varied.
    """
    rest = inputs.without_claimed(scene, earlier)
    source = LocalRidge(replace(predictor.options, **options.local_ridge_changes))
    changes = SlowChanges.fit(rest, options, source)
    estimated = EstimatedCreeps(changes.estimated, options.displacement)
    # One marker after the other: the regressions of all of a long recording are not kept.
    each = [(estimated.course(m), changes.smallest.height(m)) for m in range(len(markers))]
    proposed = {m: course for m, (course, _) in enumerate(each) if course is not None}
    lasting = LastingFinder(predictor.options, options.displacement, options.shape).find(rest, markers, proposed)
    drifts = not_explained(
        changes.find(markers), lasting, frames=len(earlier), moments=True, options=options.displacement
    )
    creeps = [event for event in lasting if event.kind == "creep"]
    found = sorted([*drifts, *creeps], key=lambda event: event.order)
    heights = changes.smallest.attributable(np.array([height for _, height in each]), rest.neighbours)
    return found, {
        name: None if np.isnan(height) else round(height, STATED_DIGITS)
        for name, height in zip(markers, heights.tolist(), strict=True)
    }


@dataclass(frozen=True, eq=False)
class SlowChanges:
    """Drifts of all durations on the markers of a scene.

    Attributes
    ----------
    matched : MatchedDrifts
        Those of up to a second or so that templates find in the residuals.
    estimated : EstimatedDrifts
        Those that are estimated together with the regression, from a few tenths of a second on.
    matched_attribution, estimated_attribution : DriftAttribution
        Whose they are.
    smallest : SmallestDriftPredictor
        Which drifts would be found.
    """

    matched: MatchedDrifts
    estimated: EstimatedDrifts
    matched_attribution: DriftAttribution
    estimated_attribution: DriftAttribution
    smallest: SmallestDriftPredictor

    @classmethod
    def fit(cls, scene: Scene, options: SlowOptions, predictor: ScaledResidualSource) -> SlowChanges:
        """Score the drifts of a scene.

        Parameters
        ----------
        scene : Scene
            What is observed, without what earlier detectors claimed.
        options : SlowOptions
            Durations, thresholds, local scale, and attribution.
        predictor : ScaledResidualSource
            Predicts each marker from its neighbours.

        Returns
        -------
        SlowChanges
            The drifts, scored.
        """
        scorer, regression = DriftScorer(scene.rate, options), DriftRegression(scene.rate, options.estimated_drifts)
        residual, factors = np.full(scene.positions.shape, np.nan), np.full(scene.positions.shape[:2], np.nan)

        def regressions() -> Iterator[LocalRegression]:
            for own in predictor.regressions(scene, blocks=options.leverage_blocks):
                residual[own.frames, own.marker], factors[own.frames, own.marker] = own.residual, own.factors
                yield own

        # Their means alone: the inputs of all markers in all frames would take many times the memory of the recording.
        binned = list(regression.binned(regressions(), len(residual)))
        motion = scorer.motion(scene)
        scores = scorer.score(scene, residual, factors, motion)
        scale = regression.scale(scene, residual, motion)
        models = regression.models(binned, scale)
        estimated = EstimatedDrifts(regression, models, residual, options)
        matched_evidence = MatchedDriftEvidence(scorer, scores, predictor)
        estimated_evidence = EstimatedDriftEvidence(estimated, scale, predictor)
        return cls(
            MatchedDrifts(scorer, scores),
            estimated,
            DriftAttribution(scene, matched_evidence, options),
            DriftAttribution(scene, estimated_evidence, options),
            SmallestDriftPredictor(estimated, scale),
        )

    def find(self, markers: Sequence[str]) -> list[Event]:
        """Find the drifts of all markers that are their own.

        Parameters
        ----------
        markers : Sequence[str]
            Names of the markers.

        Returns
        -------
        list[Event]
            Disjoint events, sorted.
        """
        found = list[Event]()
        for m, name in enumerate(markers):
            found += [event for event in self.matched.find(m, name=name) if self.matched_attribution.is_own(m, event)]
            found += [
                event for event in self.estimated.find(m, name=name) if self.estimated_attribution.is_own(m, event)
            ]
        return events.disjoint(found)
