"""Drifts of a few tenths of a second to seconds: scored at all places by generalised least squares, the clearest found first."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.detection.neighbour.drifts import shape as drift_shape
from markermend.detection.neighbour.drifts.model import DriftModel
from markermend.detection.neighbour.drifts.regression import DriftRegression
from markermend.detection.neighbour.drifts.scores import required_score
from markermend.numerics import intervals
from markermend.numerics.intervals import runs
from markermend.options.detection.estimated_drifts import EstimatedDriftOptions
from markermend.options.detection.slow import SlowOptions


@dataclass(frozen=True, eq=False)
class EstimatedDrifts:
    """Finds the drifts of each marker that are estimated together with its regression.

    Attributes
    ----------
    regression : DriftRegression
        By which the models were fitted.
    models : Sequence[DriftModel]
        The models of all markers.
    residual : np.ndarray
        Residuals (frames, markers, 3), mm, NaN = missing: they show the axes of a drift.
    options : SlowOptions
        What a drift of any length must be.
    """

    regression: DriftRegression
    models: Sequence[DriftModel]
    residual: np.ndarray
    options: SlowOptions

    @property
    def own(self) -> EstimatedDriftOptions:
        """The options of these drifts."""
        return self.options.estimated_drifts

    @property
    def longest(self) -> int:
        """Bins of the longest drift that is tried: what fits best with so many may last longer, as another pose does."""
        return int(self.own.longest_factor * self.regression.bins(max(self.own.durations_s)))

    def find(self, marker: int, *, name: str) -> list[Event]:
        """Find the drifts of one marker, the clearest first; none overlaps a clearer one.

        What is fitted best by a drift shorter than the shortest of them is left to the templates.

        Parameters
        ----------
        marker : int
            Index of the marker.
        name : str
            Its name.

        Returns
        -------
        list[Event]
            The drifts.
        """
        model, step = self.models[marker], self.regression.step
        shortest = self.regression.bins(min(self.own.durations_s))
        score, length = self.scores(model)
        peaks = [start + int(score[start:stop].argmax()) for start, stop in runs(score > 1)]
        found, taken = list[Event](), np.zeros(model.bins, bool)
        for peak in sorted(peaks, key=lambda peak: -score[peak]):
            start, stop = self.extent(model, peak, int(length[peak]))
            if taken[start:stop].any():
                continue
            taken[start:stop] = True
            if shortest <= stop - start < self.longest and self.is_drift(model, score, start, stop):
                first, last = self.frames(marker, start * step, min(stop * step, len(self.residual)))
                axes = events.main_axes(self.direction(marker, first, last)[None])
                found.append(Event(name, first, last, float(score[peak]), axes))
        return found

    def frames(self, marker: int, start: int, stop: int) -> tuple[int, int]:
        """Fit where a drift begins and ends to the frame, if it is as short as templates are: bins are coarse for it.

        Parameters
        ----------
        marker : int
            Index of the marker.
        start, stop : int
            The drift, frames [start, stop), to a bin.

        Returns
        -------
        tuple[int, int]
            The drift, frames [start, stop).
        """
        if stop - start > intervals.samples(max(self.options.durations_s), self.regression.rate):
            return start, stop
        flank = self.options.flank_fraction
        return drift_shape.fit_extent(self.residual[:, marker], (start + stop) // 2, stop - start, flank=flank)

    def scores(self, model: DriftModel) -> tuple[np.ndarray, np.ndarray]:
        """Score drifts of all lengths.

        Parameters
        ----------
        model : DriftModel
            The model of a marker.

        Returns
        -------
        score : np.ndarray
            Score (bins,) of the clearest drift whose middle is there, in units of the threshold; 0 where unknown.
        length : np.ndarray
            Its length (bins,), bins.
        """
        return model.cached(("scores", self.own), partial(self._scores, model))

    def _scores(self, model: DriftModel) -> tuple[np.ndarray, np.ndarray]:
        """Score drifts of all lengths, see `scores`."""
        score, best = np.zeros(model.bins), np.zeros(model.bins, int)
        lengths = list(map(self.regression.bins, self.own.durations_s))
        found = model.responses(lengths, min_known_share=self.own.min_known_share)
        for length, statistic in zip(lengths, (each.statistic for each in found), strict=True):
            there = slice(length // 2, length // 2 + len(statistic))
            better = statistic / self.own.threshold_sigmas > score[there]
            score[there][better] = statistic[better] / self.own.threshold_sigmas
            best[there][better] = length
        return score, best

    def extent(self, model: DriftModel, peak: int, length: int) -> tuple[int, int]:
        """Fit where a drift begins and ends: the likeliest of several lengths and places.

        Parameters
        ----------
        model : DriftModel
            The model of the marker.
        peak : int
            Bin of its middle.
        length : int
            Length by which it was found, bins.

        Returns
        -------
        tuple[int, int]
            The drift, bins [start, stop).
        """
        best = (0.0, peak - length // 2, peak - length // 2 + length)
        lengths = sorted(
            {min(max(self.own.min_bins, int(factor * length)), self.longest) for factor in drift_shape.LENGTH_FACTORS}
        )
        found = model.responses(lengths, min_known_share=self.own.min_known_share)
        for own, statistic in zip(lengths, (each.statistic for each in found), strict=True):
            first = max(0, peak - own // 2 - length // 4)
            near = statistic[first : peak - own // 2 + length // 4 + 1]
            if len(near):
                place = first + int(near.argmax())
                best = max(best, (float(near.max()), place, place + own))
        return best[1], best[2]

    def is_drift(self, model: DriftModel, score: np.ndarray, start: int, stop: int) -> bool:
        """Check whether what stands out is a drift.

        Parameters
        ----------
        model : DriftModel
            The model of the marker.
        score : np.ndarray
            Scores (bins,) of the marker.
        start, stop : int
            Its extent, bins [start, stop).

        Returns
        -------
        bool
            Whether it is high enough, is distinct from what the marker does elsewhere, and comes back: no shift of the level
            explains the signal as well.
        """
        side, step = (stop - start) // 2, self.regression.step
        edges = np.arange(max(1, start - side), min(model.bins, stop + side))
        shapes = np.concatenate(
            [
                self.regression.shape(start * step, stop * step, model.bins)[None],
                (np.arange(model.bins) >= edges[:, None]).astype(float),
            ]
        )
        estimated = model.estimate(shapes)
        statistic, *shifts = estimated.statistic.tolist()
        required = required_score(
            score,
            start,
            stop,
            reach=(stop - start) // 2,
            factor=self.options.distinct_factor,
            limit=np.inf,  # what recurs is motion, however large: its covariance is estimated from few repetitions
        )
        return bool(
            np.linalg.norm(estimated.height[0]) >= self.own.floor_mm
            and statistic >= self.own.threshold_sigmas * required
            and statistic > max(shifts, default=0.0)
        )

    def direction(self, marker: int, start: int, stop: int) -> np.ndarray:
        """Measure the direction of a drift in the residual, which follows the regression but points the same way.

        Parameters
        ----------
        marker : int
            Index of the marker.
        start, stop : int
            The drift, frames [start, stop).

        Returns
        -------
        np.ndarray
            Unit vector (3,), laboratory axes; NaN where the residual is unknown.
        """
        residual, third = self.residual[:, marker], (stop - start) // 3
        change = drift_shape.known_median(residual[start + third : stop - third]) - drift_shape.known_median(residual)
        unit: np.ndarray = change / max(float(np.linalg.norm(change)), 1e-9)
        return unit
