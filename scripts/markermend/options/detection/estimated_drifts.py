"""Options of the detector of drifts that are estimated together with the regression."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from markermend.options.declaration import (
    Above,
    Count,
    Factor,
    Millimetres,
    NotEmpty,
    NotNegative,
    Positive,
    PositiveMillimetres,
    PositiveSeconds,
    Share,
    Unit,
)


@dataclass(frozen=True)
class EstimatedDriftOptions:
    """Detect drifts together with the regression."""

    durations_s: Annotated[tuple[PositiveSeconds, ...], NotEmpty] = (
        0.3,
        0.4,
        0.55,
        0.75,
        1,
        1.4,
        2,
        2.8,
        4,
        5.6,
    )
    """Durations of the drifts that are looked for, together with the regression on the neighbours.

    Change it when slow changes of other durations are real in your data."""

    min_bins: Count = 2
    """Bins of the shortest drift that is tried where a drift begins and ends: what fits best with so few is left to the templates."""

    longest_factor: Factor = 1.2
    """Longest drift that is tried, in units of the longest that is looked for: what fits best with it is another pose."""

    threshold_sigmas: Positive = 6.3
    """Smallest drift, in standard deviations of its estimated height.

    Change it when there are too many false findings (higher), or artifacts are missed (lower)."""

    floor_mm: Millimetres = 3.5
    """Smallest height of a drift: soft tissue shifts by less in the course of seconds."""

    bin_rate_hz: Annotated[float, Unit("Hz", "hertz"), Above(0)] = 10
    """Rate of the means on which drifts are estimated."""

    coefficient_std: Positive = 1
    """Standard deviation, about 0, of the coefficients of the regression."""

    correlation_times_s: tuple[PositiveSeconds, ...] = (0.1, 0.2, 0.5, 1, 3)
    """Correlation times of the residual that are tried."""

    max_lag_s: PositiveSeconds = 4
    """Longest lag of the autocovariance of the residual."""

    outlier_sigmas: Positive = 6
    """Residuals beyond this many robust standard deviations are clipped in the autocovariance."""

    scale_neighbours: Count = 10
    """Nearest neighbours whose motion and residuals set the local scale."""

    scale_window_s: PositiveSeconds = 0.6
    """Window over which the local scale is fitted."""

    max_part_s: PositiveSeconds = 60
    """Longer recordings are divided into overlapping parts of this length, each with a regression of its own."""

    min_known_share: Share = 0.8
    """Share of a drift, by its square, that must be observed together with the neighbours."""

    precise_mm: PositiveMillimetres = 2
    """Standard deviation of the height up to which a drift may leave the distances in their usual range, but for those on a rigid
    body."""

    contradicting_distance_sigmas: Positive = 3
    """A distance speaks against such a drift if the drift would change it by this many of its deviations, and it does not change."""

    stated_duration_s: PositiveSeconds = 1
    """Duration of the drifts of which the smallest height is stated that would have been found.

    Change it when drifts of another duration would matter to you."""

    stated_share: Share = 0.85
    """Share of the times at which a drift of the stated height would have been found."""

    stated_neighbour_share: Share = 0.5
    """Share of the nearest neighbours of a marker of which a height can be stated, too: with fewer, a drift could hardly be attributed
    to the marker, and none is stated."""

    stated_places: Count = 2
    """Places over its duration at which such a drift is tried."""

    stated_margin_sigmas: NotNegative = 2
    """Standard deviations of its estimate by which the stated height exceeds the threshold."""
