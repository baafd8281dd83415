"""The smallest drift of each marker that would have been found: below it, that nothing is found means nothing."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.detection.neighbour.drifts.estimated import EstimatedDrifts
from markermend.detection.neighbour.drifts.regression import bin_means
from markermend.detection.neighbour.drifts.scores import required_score
from markermend.numerics import robust

FLOOR_MARGIN = 1.1
"""Factor above the smallest height: between bins a drift appears to be lower by up to a tenth."""


@dataclass(frozen=True, eq=False)
class SmallestDriftPredictor:
    """Predicts, from the thresholds of the detector and its standard deviations, which drifts it finds.

    Attributes
    ----------
    drifts : EstimatedDrifts
        The models of all markers, and the thresholds.
    scale : np.ndarray
        Local scale (bins, markers), mm.
    """

    drifts: EstimatedDrifts
    scale: np.ndarray

    @property
    def length(self) -> int:
        """Bins of the drift of which the height is stated."""
        return self.drifts.regression.bins(self.drifts.own.stated_duration_s)

    def attributable(self, heights: np.ndarray, neighbours: Sequence[np.ndarray]) -> np.ndarray:
        """Leave out heights of markers whose drifts would stand out, and could not be attributed to them.

        A drift is found if it can be attributed to its marker, which takes neighbours that are predicted well themselves.

        Parameters
        ----------
        heights : np.ndarray
            The height (markers,) of each, mm, see `height`.
        neighbours : Sequence[np.ndarray]
            For each marker its neighbours, the nearest first.

        Returns
        -------
        np.ndarray
            The heights (markers,), mm; NaN where that cannot be said of the marker or of too many of its neighbours.
        """
        options = self.drifts.options
        known = ~np.isnan(heights)
        near = [np.asarray(around, int)[: options.attribution_neighbours] for around in neighbours]
        share = np.array([known[around].mean() if len(around) else 0.0 for around in near])
        return np.where(share >= options.estimated_drifts.stated_neighbour_share, heights, np.nan)

    def height(self, marker: int) -> float:
        """Predict the smallest height of a drift of one marker that would stand out at most times.

        Parameters
        ----------
        marker : int
            Index of the marker.

        Returns
        -------
        float
            The height, mm; NaN where too few drifts would be estimated precisely for that to be said.
        """
        own = self.drifts.own
        heights = list(self._at_places(marker)) if self.drifts.models[marker].parts else []
        if not heights:
            return float("nan")
        height = float(np.quantile(np.concatenate(heights), own.stated_share, method="higher"))
        return height if np.isfinite(height) else float("nan")

    def threshold_sigmas(self, marker: int) -> float:
        """Give the threshold of a marker, raised by what it does elsewhere.

        Parameters
        ----------
        marker : int
            Index of the marker.

        Returns
        -------
        float
            The statistic that a drift must reach.
        """
        score, _ = self.drifts.scores(self.drifts.models[marker])
        factor = self.drifts.options.distinct_factor
        required = required_score(score, 0, 0, reach=self.length // 2, factor=factor, limit=np.inf)
        return self.drifts.own.threshold_sigmas * required

    def _at_places(self, marker: int) -> Iterator[np.ndarray]:
        """Smallest heights (places,) at places of each part of the recording, mm; infinite where none is found."""
        drifts, threshold, length = self.drifts, self.threshold_sigmas(marker), self.length
        residual = bin_means(drifts.residual[:, marker], drifts.regression.step)
        for first, part in drifts.models[marker].regressions():
            deviation = part.responses(length, min_known_share=drifts.own.min_known_share).deviation
            places = np.flatnonzero(np.isfinite(deviation))[:: max(1, length // drifts.own.stated_places)]
            if not len(places):
                continue
            bins = slice(first, first + len(part.weighted))
            scale = self.scale[bins, marker]
            masking = part.masking(length, places, scale=scale)
            usual = robust.mad_std((residual[bins] / scale[:, None])[~np.isnan(residual[bins])])
            clipped = drifts.own.outlier_sigmas * usual * scale[places + length // 2]
            yield self._found_from(deviation[places], masking, clipped, threshold=threshold)

    def _found_from(
        self, deviation: np.ndarray, masking: np.ndarray, clipped: np.ndarray, *, threshold: float
    ) -> np.ndarray:
        """Heights (k,), mm, that reach the threshold although they raise their own standard deviation.

        They are infinite where a drift is not estimated precisely: whether it is found depends on its direction.

        Parameters
        ----------
        deviation : np.ndarray
            Standard deviation (k,) of the height without a drift, mm.
        masking : np.ndarray
            Variance (k,) that a drift of height 1 adds.
        clipped : np.ndarray
            Height (k,) above which drifts are clipped where the covariance is estimated, mm.
        threshold : float
            The statistic to be reached.

        Returns
        -------
        np.ndarray
            The heights.
        """
        own = self.drifts.own
        remaining = np.maximum(1 - masking * threshold**2, 1e-9)
        height = threshold * np.minimum(
            deviation / np.sqrt(remaining), np.sqrt(deviation**2 + masking * np.minimum(clipped, 1e6) ** 2)
        )
        masked = height / threshold
        height = np.maximum(height, FLOOR_MARGIN * own.floor_mm) + own.stated_margin_sigmas * masked
        found: np.ndarray = np.where(masked > own.precise_mm, np.inf, height)
        return found
