"""Options of the detection of slow changes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any, Literal

from markermend.options.declaration import (
    AtLeast,
    Changes,
    Count,
    Factor,
    Laboratory,
    Millimetres,
    NotEmpty,
    NotNegative,
    Positive,
    PositiveMillimetres,
    PositiveSeconds,
    Seconds,
    Shared,
)
from markermend.options.detection.detector import DetectorOptions
from markermend.options.detection.displacement import DisplacementOptions
from markermend.options.detection.estimated_drifts import EstimatedDriftOptions
from markermend.options.detection.published import PublishedSlowOptions
from markermend.options.prediction.local_ridge import LocalRidgeOptions
from markermend.options.prediction.predictors import PredictorOptions
from markermend.options.shape import ShapeOptions


@dataclass(frozen=True)
class SlowOptions(DetectorOptions):
    """Detect slow changes.

    The options here and in `advanced.slow` are those of the preset `default`; the preset `paper` has its own in
    `advanced.slow.paper`.
    """

    predictors: Annotated[PredictorOptions, Shared(("local_ridge", "polynomial", "replicated_network"))] = field(
        default_factory=PredictorOptions
    )
    """The predictors."""

    shape: Annotated[ShapeOptions, Shared()] = field(default_factory=ShapeOptions)
    """The evidence of the subject's usual shape."""

    displacement: Annotated[DisplacementOptions, Shared()] = field(default_factory=DisplacementOptions)
    """Lasting displacements."""

    preset: Annotated[Literal["default", "paper"], Laboratory] = "default"
    """The detector: `default` (against the neighbours, all axes together) or `paper` (as published: skurowski2022).

    Change it when you repeat the paper (`paper`)."""

    durations_s: Annotated[tuple[PositiveSeconds, ...], NotEmpty, Laboratory] = (0.25, 0.32, 0.42, 0.55, 0.75, 1)
    """Durations of the drifts that are looked for.

    Change it when slow changes of other durations are real in your data."""

    threshold_sigmas: Annotated[Positive, Laboratory] = 4.5
    """Smallest drift, in units of the local scale of the residual.

    Change it when there are too many false findings (higher), or artifacts are missed (lower)."""

    floor_mm: Annotated[Millimetres, Laboratory] = 2.5
    """Smallest height of a drift.

    Change it when changes too small to matter to you are reported (higher)."""

    min_duration_s: Seconds = 0.15
    """Shortest finding.

    Change it when findings are too short to be of this class."""

    local_ridge_changes: Annotated[Mapping[str, Any], Changes(LocalRidgeOptions)] = field(
        default_factory=lambda: {"inputs": 14, "ridge_mm2": 1.0}
    )
    """Options of the predictor local_ridge that differ in this stage: a closer fit than filling needs."""

    flank_fraction: Positive = 0.5
    """Time on either side of a drift that is looked at, as a part of its duration."""

    samples_per_duration: Annotated[int, AtLeast(5)] = 24
    """Samples with which the shape of a drift is resolved over its duration."""

    correlation_times_s: tuple[PositiveSeconds, ...] = (0.02, 0.05, 0.1, 0.2, 0.5, 1, 3)
    """Correlation times of the residual that are tried."""

    max_lag_s: PositiveSeconds = 2
    """Longest lag of the autocovariance of the residual."""

    outlier_sigmas: Positive = 6
    """Residuals beyond this many robust standard deviations do not count in the autocovariance."""

    leverage_blocks: Annotated[int, AtLeast(2)] = 12
    """Parts of the recording that are left out in turn to estimate how leverage widens the residual."""

    scale_neighbours: Count = 10
    """Nearest neighbours whose motion and residuals set the local scale."""

    high_scale_mm: PositiveMillimetres = 3
    """Local scale, as the height of a drift, above which a drift must exceed the threshold by `high_scale_factor`; the same holds
    for the deviation of the steadiest distance. Above it drifts that are estimated with the regression, but not precisely, are not
    found."""

    high_scale_factor: Factor = 1.4
    """Factor by which the threshold rises there.

    Change it when false slow changes are found in fast motion (higher), or large drifts are missed there (lower)."""

    min_scale_sigmas: Positive = 1
    """Smallest local scale, in standard deviations of the residual."""

    distinct_factor: NotNegative = 1.7
    """A drift exceeds the second largest elsewhere on the marker by this factor: what a marker does again and again is motion.

    Change it when false slow changes are found (higher), or repeated ones are missed (lower)."""

    obvious_factor: Factor = 5
    """A drift that exceeds the threshold by this factor need not be distinct, and may be the tip of a longer one.

    Change it when a loose marker drifts three times or more in a similar way (lower)."""

    max_baseline_fraction: Positive = 0.35
    """Deviation of the residual from its usual level just before and after a drift, as a part of its height, at most."""

    bridged_gap_s: Seconds = 0.05
    """Gaps up to this are bridged, and neighbours may be missing for this long."""

    attribution_neighbours: Count = 12
    """Nearest neighbours to which a drift may be attributed, and whose gaps must not bound it."""

    suspect_fraction: NotNegative = 0.75
    """Neighbours that deviate by this part of the marker's own height are left out in turn to attribute the drift."""

    remaining_fraction: NotNegative = 1
    """Part of the threshold that the drift must still reach without them."""

    min_distance_sigmas: Positive = 2
    """Distances to the neighbours show a drift if it would change them, together, by this many of their deviations, times
    `high_scale_factor` where even the steadiest of them deviates by more than `high_scale_mm`."""

    min_distance_fraction: NotNegative = 0.5
    """Such distances must change by this part of what the drift would change them: those on rigid segments decide."""

    rigid_distance_fraction: Positive = 0.03
    """Distances that deviate by at most this part of the height of a drift decide alone: they are those on a rigid body."""

    estimated_drifts: EstimatedDriftOptions = field(default_factory=EstimatedDriftOptions)
    """Options of the drifts that are estimated together with the regression."""

    paper: PublishedSlowOptions = field(default_factory=lambda: PublishedSlowOptions(scale_estimator="std"))
    """Options of the preset `paper`: as published (skurowski2022)."""
