"""Options of the published detectors, which look at each coordinate by itself (skurowski2022)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any, Literal

from markermend.options.declaration import (
    Changes,
    Count,
    CountOrNone,
    Factor,
    Millimetres,
    NotNegative,
    Positive,
    PositiveSeconds,
    Seconds,
    Share,
)
from markermend.options.prediction.lagged_regression import ReplicatedNetworkOptions

ScaleEstimator = Literal["mad", "std"]
SigmaOver = Literal["coordinate", "marker", "recording"]


@dataclass(frozen=True)
class ThresholdOptions:
    """What counts as a sudden change."""

    scale_estimator: ScaleEstimator = "mad"
    """Estimator of the usual size of changes: median absolute deviation (`mad`) or standard deviation (`std`)."""

    sigma_over: SigmaOver = "coordinate"
    """Whether the usual size of changes is that of each coordinate, of each marker, or of the whole recording.

    Change it when still coordinates have too many false findings (`recording`)."""

    threshold_sigmas: Positive = 5
    """Smallest sudden change, in units of the usual size of changes."""

    floor_mm: Millimetres = 1.5
    """Smallest sudden change, per frame at 100 Hz."""


@dataclass(frozen=True)
class PublishedPeaksOptions(ThresholdOptions):
    """Isolated peaks in one coordinate."""

    trend_removal: Literal["median_of_difference", "difference_of_median"] = "median_of_difference"
    """Whether the moving median is subtracted from the differences, or from the signal before them as in the paper
    (which leaks trend)."""

    window_s: PositiveSeconds = 0.19
    """Window of the moving median."""

    max_duration_s: PositiveSeconds = 0.05
    """Longest peak."""

    margin_s: Seconds = 0.03
    """Sums and morphology extend over twice the longest peak and this."""

    joined_candidates: bool = True
    """Whether candidates that are no further from each other than that are joined before those that are too long for a peak are rejected.
    The paper does not join them; then of heavy noise some samples are peaks, but two peaks within a quarter of a second are not heavy noise."""

    localisation: Literal["window", "run"] = "window"
    """Where a peak begins and ends: at the first and last sudden change in the window of the sums around it (`window`), which must not
    be farther apart than the longest peak, or at the largest of those where the sums are balanced and the largest that cancels it (`run`)."""

    balance_ratio: Factor = 5
    """The absolute sum of a peak's changes exceeds the size of their sum by this factor."""

    slope_window_s: PositiveSeconds = 0.05
    """Window over which slopes next to earlier findings are taken."""


@dataclass(frozen=True)
class PublishedNoiseOptions(ThresholdOptions):
    """Heavy noise in one coordinate."""

    window_s: PositiveSeconds = 0.13
    """Window of the Savitzky-Golay filter that removes the trend from the differences."""

    polynomial_order: Count = 5
    """Order of that filter."""

    min_duration_s: Seconds = 0.2
    """Shortest stretch of heavy noise."""

    element_s: PositiveSeconds = 0.39
    """Structuring element of the closings: pauses of this length between sudden changes are noise, too. The paper has 39 frames, twice
    the shortest stretch, which join the two jumps of a step of up to 50; its results fit 19 frames.

    Change it when steps are taken for noise (shorter)."""

    min_sudden_share: Share = 0.2
    """Share of the samples of a stretch that change suddenly, at least (0 to 1)."""

    min_sudden_changes: Count = 6
    """Sudden changes of a stretch, at least."""

    slope_window_s: PositiveSeconds = 0.05
    """Window over which slopes next to earlier findings are taken."""


@dataclass(frozen=True)
class PublishedStepsOptions(ThresholdOptions):
    """Steps in one coordinate."""

    window_s: PositiveSeconds = 0.13
    """Window of the Savitzky-Golay filter that removes the trend from the differences."""

    polynomial_order: Count = 5
    """Order of that filter."""

    min_duration_s: Seconds = 0.06
    """Shortest time between the two jumps of a step."""

    max_duration_s: PositiveSeconds = 2
    """Longest time between the two jumps of a step."""

    min_jump_ratio: Share = 0.5
    """Size of the smaller of the two jumps of a step as a part of the larger, at least (0 to 1)."""

    slope_window_s: PositiveSeconds = 0.05
    """Window over which slopes next to earlier findings are taken."""


@dataclass(frozen=True)
class PublishedSlowOptions(ThresholdOptions):
    """Slow changes in one coordinate of the residual."""

    predictor: Literal["replicated_network", "polynomial", "savitzky_golay", "moving_median", "local_ridge"] = (
        "replicated_network"
    )
    """The predictor whose residual is examined.

    Change it when the network takes too long, or another predictor predicts better."""

    replicated_network_changes: Annotated[Mapping[str, Any], Changes(ReplicatedNetworkOptions)] = field(
        default_factory=dict
    )
    """Options of the predictor replicated_network that differ in this stage.

    Change it when training takes too long (fewer `max_iterations`)."""

    smoothing_window_s: PositiveSeconds = 2
    """Window of the predictors savitzky_golay and moving_median."""

    polynomial_order: CountOrNone = 5
    """Order of the predictor savitzky_golay."""

    scale_estimator: ScaleEstimator = "mad"
    """Estimator of the usual size of the residual: median absolute deviation (`mad`) or standard deviation (`std`)."""

    threshold_sigmas: Positive = 3
    """Upper threshold, in units of the usual size."""

    floor_mm: Millimetres = 0
    """Smallest upper threshold."""

    lower_sigmas: NotNegative = 0.5
    """Lower threshold, at which a finding begins and ends, in units of the usual size."""

    min_upper_duration_s: Seconds = 0.2
    """Shortest time beyond the upper threshold."""

    min_duration_s: Seconds = 0.5
    """Shortest time beyond the lower threshold; by that of the paper, half of the slow changes of 0.5 s on average are lost.

    Change it when short slow changes are missed (shorter)."""

    slope_window_s: PositiveSeconds = 0.05
    """Window over which slopes next to earlier findings are taken."""
