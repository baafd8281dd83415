"""Options of the models in the local frame of anchors: local_ridge and local_gp."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from markermend.options.declaration import (
    Above,
    AtLeast,
    Count,
    Millimetres,
    NotEmpty,
    NotNegative,
    Positive,
    PositiveSeconds,
    Share,
    Unit,
)


@dataclass(frozen=True)
class LocalRidgeOptions:
    """Ridge regression on the neighbours in a local frame: local_ridge."""

    anchors: Annotated[int, AtLeast(3)] = 3
    """Markers that carry the local frame."""

    inputs: Count = 12
    """Neighbours from which a marker is predicted, at most.

    Change it when marker sets have fewer than ten markers (lower)."""

    min_anchor_extent_mm: Millimetres = 15
    """Anchors are added while their extent across their longest direction is below this."""

    ridge_mm2: Annotated[float, Unit("mm^2", "square millimetres"), Above(0)] = 5
    """Penalty of the regression: the variance of the noise on an input."""

    max_training_frames: Count = 2500
    """Training frames, at most; they are scattered evenly over the recording.

    Change it when recordings are long and their motion is varied (higher, at the cost of time)."""

    min_training_frames: Count = 60
    """Frames on which marker and neighbours must be seen for a model."""

    min_own_frames: Annotated[int, AtLeast(2)] = 12
    """Frames on which they must be seen in the recording itself where the subject's other recordings show them often enough."""

    outlier_sigmas: Positive = 6
    """Training residuals beyond this many robust standard deviations lose weight."""

    correlation_times_s: tuple[PositiveSeconds, ...] = (0.02, 0.05, 0.1, 0.2, 0.5, 1, 3)
    """Correlation times of the residual that are tried."""

    max_lag_s: PositiveSeconds = 2
    """Longest lag of the autocovariance of the residual."""

    border_s: PositiveSeconds = 0.15
    """Time on either side of a gap whose samples are used."""

    max_leverage: Positive = 20
    """Limit of the leverage of a pose, in units of its mean over the training; the expected error grows with it where poses
    are unlike those of the training."""

    pool_weights: Annotated[tuple[NotNegative, ...], NotEmpty] = (0, 0.1, 0.3, 1, 3)
    """Weights of the subject's other recordings that are tried, in units of the weight of the recording itself."""

    pool_validation_blocks: Annotated[int, AtLeast(2)] = 6
    """Stretches of the recording that are left out in turn to choose among them."""

    min_pooled_rows: Count = 5
    """Poses of another recording that show the marker and its inputs, at least, to learn from that recording."""


@dataclass(frozen=True)
class GaussianProcessOptions:
    """Gaussian process in the local frame, beyond the options of local_ridge: local_gp."""

    max_training_frames: Count = 1500
    """Training frames, at most; those of local_ridge if they are fewer."""

    inducing_points: Count = 120
    """Poses whose kernel functions the process uses, at most; they are evenly spaced among training frames and pooled poses.

    Change it when motion is varied (higher, at the cost of time)."""

    min_variance: Share = 0.01
    """Poses at which the process would be known this well from the others are left out: variance left, as a share of that of the
    process."""

    length_scale: Positive = 1
    """Length scale of the kernel, in units of the typical distance of two poses."""

    border_s: PositiveSeconds = 0.3
    """Time on either side of a gap whose samples are used, at least; that of local_ridge if it is longer."""

    offset_share: Share = 0.8
    """Share of the mean of a stretch of time about which its training frames are taken, since markers shift slowly; 0 for none."""

    offset_s: PositiveSeconds = 2
    """Length of such a stretch, at least."""

    offset_gaps: NotNegative = 2
    """Length of such a stretch, at least, in lengths of the gap."""

    penalty: Positive = 0.0005
    """Ratio of the variances of noise and process, per unit of weight of the training frames."""
