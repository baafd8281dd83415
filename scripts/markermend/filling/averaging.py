"""The weighted mean of the members of an ensemble: their weights, and the standard deviation of their mean."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from markermend.filling.candidates import Candidates
from markermend.filling.distance_likelihood import DistanceModel
from markermend.filling.member_weights import (
    MemberWeights,
    expected_errors,
    inverse_power_weights,
    typical_errors,
)
from markermend.filling.mixture import mixture_deviation, weighted_mean
from markermend.options.filling import EnsembleOptions
from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class Average:
    """The weighted mean of several predictions of n frames.

    Attributes
    ----------
    positions : ndarray, shape (n, 3)
        Positions, mm; NaN where no member has a prediction.
    deviation : ndarray, shape (n,)
        Stated standard deviation per axis, mm.
    weights : ndarray, shape (members,)
        Mean weight of each member.
    """

    positions: np.ndarray
    deviation: np.ndarray
    weights: np.ndarray


@dataclass(frozen=True, eq=False)
class Averaging:
    """How the members of an ensemble are averaged.

    Attributes
    ----------
    options : EnsembleOptions
        The kind of weights, and the constraint on distances.
    """

    options: EnsembleOptions

    @property
    def uses_likelihood(self) -> bool:
        """Whether members are weighted by the likelihood of distances."""
        return self.options.weights in ("pma", "both")

    def weigh(self, errors: np.ndarray, growth: np.ndarray) -> MemberWeights:
        """Weight the members by their errors on pseudo-gaps.

        Parameters
        ----------
        errors : ndarray, shape (pseudo-gaps, 2, members)
            Result of `squared_errors`.
        growth : ndarray, shape (members,)
            Factor by which the error of each member is larger in the gap than in the pseudo-gaps.

        Returns
        -------
        MemberWeights
            The weights; 1 for all where errors do not count.
        """
        options, typical = self.options, growth * typical_errors(errors)
        if options.weights in ("pma", "equal"):
            return MemberWeights(typical, np.ones(len(typical)))
        weights = inverse_power_weights(
            typical, power=options.error_power, max_ratio=options.max_error_ratio, min_error_mm=options.min_error_mm
        )
        return MemberWeights(typical, weights)

    def distance_model(self, scene: Scene, marker: int) -> DistanceModel | None:
        """Estimate the distances of a marker to its references, once for each scene.

        Parameters
        ----------
        scene : Scene
            The recording.
        marker : int
            Index of the marker.

        Returns
        -------
        DistanceModel or None
            None where neither the weights nor the spacing constraint use it.
        """
        distances = self.options.distances
        if not self.uses_likelihood and not distances.spacing_rounds:
            return None
        estimate = partial(DistanceModel.estimate, scene, marker, distances)
        return scene.cached((self, "distances", marker), estimate)

    def average(
        self, candidates: Candidates, members: MemberWeights, distances: DistanceModel | None, observed: np.ndarray
    ) -> Average:
        """Average candidate positions.

        Parameters
        ----------
        candidates : Candidates
            The predictions of all members.
        members : MemberWeights
            Their weights.
        distances : DistanceModel or None
            Result of `distance_model`.
        observed : ndarray, shape (n, markers, 3)
            Positions of all markers in the same frames, mm.

        Returns
        -------
        Average
            The mean and its standard deviation, that of the mixture of all predictions.
        """
        weights = np.broadcast_to(members.weights[:, None], candidates.errors.shape)
        if distances is not None and self.uses_likelihood:
            weights = weights * distances.likelihood(candidates.positions, observed)
        mean, weights = weighted_mean(candidates.positions, weights)
        errors = expected_errors(candidates.errors, members.typical_errors, weights)
        errors = np.maximum(errors, self.options.min_error_mm)
        deviation = mixture_deviation(candidates.positions, mean, errors, weights)
        placed = mean if distances is None else distances.constrain(mean, observed)
        return Average(placed, deviation, weights.mean(axis=1))
