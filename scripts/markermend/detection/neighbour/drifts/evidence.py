"""Evidence by which drifts are attributed: heights, scores, and what remains without some neighbours.

Templates find drifts in the residuals; others are estimated together with the regression. Either kind has evidence of its own.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from markermend.core.events import Event
from markermend.detection.neighbour.drifts import shape as drift_shape
from markermend.detection.neighbour.drifts.estimated import EstimatedDrifts
from markermend.detection.neighbour.drifts.model import DriftModel
from markermend.detection.neighbour.drifts.scores import DriftScorer, DriftScores
from markermend.numerics.pulse_regression import PulseResponses
from markermend.prediction.interface import ScaledResidualSource
from markermend.prediction.scene import Scene


class DriftEvidence(Protocol):
    """How drifts of one kind stand out on each marker."""

    @property
    def max_distance_deviation_mm(self) -> float:
        """Largest deviation of the steadiest distance with which a drift can be distinguished from a rare pose, mm."""
        ...

    def displacement(self, marker: int, event: Event) -> np.ndarray:
        """Estimate how far a marker is displaced at the height of a drift.

        Parameters
        ----------
        marker : int
            Index of the marker.
        event : Event
            When it is; of any marker.

        Returns
        -------
        np.ndarray
            Displacement (3,), mm, laboratory axes; NaN where it is unknown.
        """
        ...

    def stands_out(self, marker: int, event: Event) -> bool:
        """Check whether a marker has a drift at the time of another.

        Parameters
        ----------
        marker : int
            Index of the marker.
        event : Event
            The other drift.

        Returns
        -------
        bool
            Whether its score exceeds the threshold.
        """
        ...

    def is_precise(self, marker: int, event: Event) -> bool:
        """Check whether a drift is estimated so precisely that it may stay in the usual range of the distances.

        Parameters
        ----------
        marker : int
            Index of the marker.
        event : Event
            The drift.

        Returns
        -------
        bool
            Whether it is.
        """
        ...

    def remaining_score(self, scene: Scene, marker: int, event: Event) -> float:
        """Score a drift in a scene with fewer neighbours.

        Parameters
        ----------
        scene : Scene
            The scene.
        marker : int
            Index of the marker.
        event : Event
            The drift.

        Returns
        -------
        float
            Its score as a part of what is required.
        """
        ...


@dataclass(frozen=True, eq=False)
class MatchedDriftEvidence:
    """Evidence of drifts that templates find in residuals.

    Attributes
    ----------
    scorer : DriftScorer
        By which they were scored.
    scores : DriftScores
        The scores.
    predictor : ScaledResidualSource
        Source of the residuals.
    """

    scorer: DriftScorer
    scores: DriftScores
    predictor: ScaledResidualSource

    @property
    def max_distance_deviation_mm(self) -> float:
        """Any: few poses are so brief. See `DriftEvidence.max_distance_deviation_mm`."""
        return float("inf")

    def displacement(self, marker: int, event: Event) -> np.ndarray:
        """Measure the displacement in the residual. See `DriftEvidence.displacement`."""
        flank = self.scorer.options.flank_fraction
        return drift_shape.displacement(self.scores.residual[:, marker], event.start, event.stop, flank=flank)

    def stands_out(self, marker: int, event: Event) -> bool:
        """Compare the scores with the threshold. See `DriftEvidence.stands_out`."""
        return bool(self.scores.score[event.start : event.stop, marker].max(initial=0.0) > 1)

    def is_precise(self, marker: int, event: Event) -> bool:
        """Say no: the scale of residuals is too small where a motion occurs only once. See `DriftEvidence.is_precise`."""
        return False

    def remaining_score(self, scene: Scene, marker: int, event: Event) -> float:
        """Score the residual in the scene. See `DriftEvidence.remaining_score`."""
        residual, factors = self.predictor.scaled_residuals(
            scene, np.array([marker]), blocks=self.scorer.options.leverage_blocks
        )
        score = self.scorer.rescore(self.scores, residual[:, marker], factors[:, marker], marker=marker)
        required = self.scorer.required_score(score, event.start, event.stop)
        return float(score[event.start : event.stop].max() / required)


@dataclass(frozen=True, eq=False)
class EstimatedDriftEvidence:
    """Evidence of drifts that are estimated together with the regression.

    Attributes
    ----------
    drifts : EstimatedDrifts
        The models of all markers.
    scale : np.ndarray
        Local scale (bins, markers), mm.
    predictor : ScaledResidualSource
        Source of the regressions.
    """

    drifts: EstimatedDrifts
    scale: np.ndarray
    predictor: ScaledResidualSource

    @property
    def max_distance_deviation_mm(self) -> float:
        """Local scale above which drifts are hardly found. See `DriftEvidence.max_distance_deviation_mm`."""
        return self.drifts.options.high_scale_mm

    def displacement(self, marker: int, event: Event) -> np.ndarray:
        """Estimate the height together with the regression, the direction in the residual. See `DriftEvidence.displacement`."""
        height = float(np.linalg.norm(self._estimate(self.drifts.models[marker], event).height[0]))
        displaced: np.ndarray = height * self.drifts.direction(marker, event.start, event.stop)
        return displaced

    def stands_out(self, marker: int, event: Event) -> bool:
        """Compare the statistic with the threshold. See `DriftEvidence.stands_out`."""
        return bool(self._estimate(self.drifts.models[marker], event).statistic[0] > self.drifts.own.threshold_sigmas)

    def is_precise(self, marker: int, event: Event) -> bool:
        """Compare the standard deviation of the height with its limit. See `DriftEvidence.is_precise`."""
        return bool(self._estimate(self.drifts.models[marker], event).deviation[0] <= self.drifts.own.precise_mm)

    def remaining_score(self, scene: Scene, marker: int, event: Event) -> float:
        """Fit the model in the scene. See `DriftEvidence.remaining_score`."""
        blocks = self.drifts.options.leverage_blocks
        regressions = self.predictor.regressions(scene, np.array([marker]), blocks=blocks)
        fitted = self.drifts.regression
        models = fitted.models(fitted.binned(regressions, len(scene.positions)), self.scale)
        return float(self._estimate(models[marker], event).statistic[0] / self.drifts.own.threshold_sigmas)

    def _estimate(self, model: DriftModel, event: Event) -> PulseResponses:
        """The drift in the model of a marker."""
        return model.estimate(self.drifts.regression.shape(event.start, event.stop, model.bins)[None])
