"""Drifts of up to a second or so: templates are matched to the residual, the clearest drifts found first."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.detection.neighbour.drifts import shape as drift_shape
from markermend.detection.neighbour.drifts.scores import DriftScorer, DriftScores
from markermend.numerics import intervals
from markermend.numerics.intervals import runs
from markermend.options.detection.slow import SlowOptions


@dataclass(frozen=True)
class MatchedDrifts:
    """Finds the drifts of each marker by their scores.

    Attributes
    ----------
    scorer : DriftScorer
        By which they were scored.
    scores : DriftScores
        The scores.
    """

    scorer: DriftScorer
    scores: DriftScores

    @property
    def options(self) -> SlowOptions:
        """The options."""
        return self.scorer.options

    def find(self, marker: int, *, name: str) -> list[Event]:
        """Find the drifts of one marker, the clearest first; none reaches into the flanks of a clearer one.

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
        score, residual, flank = (
            self.scores.score[:, marker],
            self.scores.residual[:, marker],
            self.options.flank_fraction,
        )
        peaks = [start + int(score[start:stop].argmax()) for start, stop in runs(score > 1)]
        found, taken = list[Event](), np.zeros(len(score), bool)
        for peak in sorted(peaks, key=lambda peak: -score[peak]):
            start, stop = self.extent(marker, peak)
            if taken[start:stop].any():
                continue
            side = int(flank * (stop - start))
            taken[max(0, start - side) : stop + side] = True
            if self.is_drift(marker, peak, start, stop):
                change = drift_shape.displacement(residual, start, stop, flank=flank)
                found.append(Event(name, start, stop, float(score[peak]), events.main_axes(change[None])))
        return found

    def extent(self, marker: int, peak: int) -> tuple[int, int]:
        """Fit where the drift at a peak of the score begins and ends.

        An obvious one may be the tip of a longer drift: it lasts as long as it takes to return to the baseline.

        Parameters
        ----------
        marker : int
            Index of the marker.
        peak : int
            Frame of the peak.

        Returns
        -------
        tuple[int, int]
            The drift, [start, stop).
        """
        own, residual = self.scores.length[peak, marker], self.scores.residual[:, marker]
        obvious = self.scores.score[peak, marker] >= self.options.obvious_factor
        lengths = [length for length in self.scorer.lengths if length == own or (obvious and length > own)]
        spans = [drift_shape.fit_extent(residual, peak, n, flank=self.options.flank_fraction) for n in lengths]
        return next((span for span in spans if self.rises_from_baseline(residual, *span)), spans[0])

    def is_drift(self, marker: int, peak: int, start: int, stop: int) -> bool:
        """Check whether what stands out at a peak of the score is a drift.

        Parameters
        ----------
        marker : int
            Index of the marker.
        peak : int
            Frame of the peak.
        start, stop : int
            Its extent, [start, stop).

        Returns
        -------
        bool
            Whether it rises from the baseline, is distinct from what the marker does elsewhere, clear enough where the
            local scale is high, and long enough.
        """
        options, score = self.options, self.scores.score[:, marker]
        return bool(
            self.rises_from_baseline(self.scores.residual[:, marker], start, stop)
            and score[peak] >= self.scorer.required_score(score, start, stop)
            and (
                score[peak] >= options.high_scale_factor or self.scores.scale_mm[peak, marker] <= options.high_scale_mm
            )
            and stop - start >= intervals.samples(options.min_duration_s, self.scorer.rate)
        )

    def rises_from_baseline(self, residual: np.ndarray, start: int, stop: int) -> bool:
        """Check whether a residual rises high enough in an interval, from baseline to baseline.

        Parameters
        ----------
        residual : np.ndarray
            Residual (frames, 3), mm, NaN = missing.
        start, stop : int
            The interval, [start, stop).

        Returns
        -------
        bool
            Whether it does.
        """
        flank = self.options.flank_fraction
        deviation = drift_shape.baseline_deviation(residual, start, stop, flank=flank)
        lowest = max(self.options.floor_mm, deviation / self.options.max_baseline_fraction)
        return drift_shape.height(residual, start, stop, flank=flank) >= lowest
