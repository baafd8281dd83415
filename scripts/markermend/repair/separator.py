"""The method that proposes the measured samples of a marker without the artifact on them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from markermend.numerics.kriging import Covariance, fit_covariance
from markermend.options.repair import SeparationOptions
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.scene import Scene
from markermend.repair.methods import Proposal
from markermend.repair.separation import (
    artifact_covariances,
    average_by_likelihood,
    conditional_correlation,
    separate,
)


@dataclass(frozen=True)
class Separator:
    """Separates the trajectories of a recording from artifacts.

    Attributes
    ----------
    ridges : sequence of LocalRidge
        The predictors; the covariance of the error is estimated from the residual of the first.
    scene : Scene
        The trajectories without any finding.
    options : SeparationOptions
        What is assumed of artifacts.
    """

    ridges: Sequence[LocalRidge]
    scene: Scene
    options: SeparationOptions

    def propose(self, method: str, original: np.ndarray, marker: int, start: int, stop: int) -> Proposal | None:
        """Propose the measured samples without the artifact on them.

        Parameters
        ----------
        method : str
            A key of `SHAPE_COVARIANCES`: the artifacts that are tried.
        original : ndarray of float, shape (frames, 3)
            The trajectory of the marker as measured, mm; NaN = missing.
        marker : int
            Index of the marker.
        start, stop : int
            The interval.

        Returns
        -------
        Proposal or None
            The proposal; None where the neighbours have no value for some sample, or for more samples than the options
            allow.
        """
        shares = self.options.margin_fractions if method == "separate_slow" else (0,)
        margins = [round(share * (stop - start)) for share in shares]
        first, last = _observed_extent(self.scene.present[:, marker], start, stop, max(margins))
        if last - first > self.options.max_frames or np.isnan(original[start:stop]).all():
            return None
        extents = [(max(start - margin, first) - first, min(stop + margin, last) - first) for margin in margins]
        correlation = self._error_correlation(marker, first, last)
        trajectories, separations = [], []
        for ridge in self.ridges:
            prediction = ridge.predict(self.scene, marker, first, last)
            positions, deviation = prediction.positions[1:-1], prediction.error[1:-1]
            if np.isnan(positions).any() or np.isnan(deviation).any():
                continue
            tried = artifact_covariances(method, last - first, self.options, extents, rate=self.scene.rate)
            error = correlation * deviation * deviation[:, None]
            difference, power = original[first:last] - positions, self.options.likelihood_power
            separations.append(separate(difference, error, tried, likelihood_power=power))
            trajectories.append(positions + separations[-1].mean)
        if not separations:
            return None
        mean, deviation = average_by_likelihood(trajectories, separations)
        own = slice(start - first, stop - first)
        return Proposal(method, mean[own], deviation[own])

    def _error_correlation(self, marker: int, first: int, last: int) -> np.ndarray:
        """Correlation (n, n) of the error of a prediction over [first, last), which is known on either side."""
        present, rate, border = self.scene.present, self.scene.rate, round(self.options.border_s * self.scene.rate)
        around = np.arange(first - border, last + border)
        around = around[(around >= 0) & (around < len(present)) & ((around < first) | (around >= last))]
        around = around[present[around, marker]]
        ridge = self.ridges[0]
        compute = partial(residual_covariance, ridge, self.scene, marker)
        covariance = self.scene.cached((ridge, "residual", marker), compute)
        return conditional_correlation(covariance, known_s=around / rate, wanted_s=np.arange(first, last) / rate)


def _observed_extent(present: np.ndarray, start: int, stop: int, margin: int) -> tuple[int, int]:
    """The interval [start, stop) with up to `margin` frames on either side, as far as the marker is observed there."""
    absent = np.flatnonzero(~present)
    before, after = absent[absent < start], absent[absent >= stop]
    first = max(start - margin, before[-1] + 1 if len(before) else 0)
    return first, min(stop + margin, after[0] if len(after) else len(present))


def residual_covariance(ridge: LocalRidge, scene: Scene, marker: int) -> Covariance:
    """Estimate the covariance of the residual of a marker over time.

    Parameters
    ----------
    ridge : LocalRidge
        The predictor.
    scene : Scene
        The trajectories without any finding.
    marker : int
        Index of the marker.

    Returns
    -------
    Covariance
        The covariance over the whole recording, mm^2.
    """
    residual = ridge.residuals(scene, np.array([marker]))[:, marker]
    scales_s = np.array(ridge.options.correlation_times_s)
    return fit_covariance(residual, rate=scene.rate, scales_s=scales_s, max_lag_s=ridge.options.max_lag_s)
