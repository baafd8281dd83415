"""Options of lasting displacements: markers that were knocked, or crept, to another place on their segment."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any

from markermend.options.declaration import (
    Above,
    AtLeast,
    Below,
    Changes,
    Count,
    CountOrNone,
    Factor,
    Millimetres,
    NotEmpty,
    NotNegative,
    Positive,
    PositiveSeconds,
    Share,
)
from markermend.options.prediction.local_ridge import LocalRidgeOptions


@dataclass(frozen=True)
class DisplacementOptions:
    """Detect markers that were knocked, or crept, to another place on their segment, and move them back.

    The stages steps (knocked) and slow (creeping) and the repair share them.
    """

    local_ridge_changes: Annotated[Mapping[str, Any], Changes(LocalRidgeOptions)] = field(
        default_factory=lambda: {"anchors": 4, "inputs": 8, "ridge_mm2": 1, "max_training_frames": 400}
    )
    """Options of local_ridge that differ here: the regression on the pose must leave a displacement alone."""

    moments: Annotated[int, AtLeast(2)] = 60
    """Moments, evenly spaced, at which a displacement may begin or end; a sudden one is then placed to the frame."""

    rise_durations_s: Annotated[tuple[PositiveSeconds, ...], NotEmpty] = (0.5, 1, 2, 4)
    """Durations over which a marker may creep to its new place."""

    min_duration_s: PositiveSeconds = 0.3
    """Shortest time at either of the two places, and before and after a displacement that ends."""

    min_duration_share: Share = 0.1
    """The shortest time at either of the two places as a share of the recording (0 to 1)."""

    min_stay_s: PositiveSeconds = 1
    """A creep that ends, or whose height is estimated, stays at the second place for this long, at least, and for as long as it
    rose: else it is a drift."""

    min_explained_share: Annotated[float, Above(0), Below(1)] = 0.7
    """Share of the variance that the pose leaves unexplained which a sudden displacement must explain, at least (0 to 1)."""

    min_creep_explained_share: Annotated[float, Above(0), Below(1)] = 0.8
    """The same of a creep, which a slow change of pose resembles (0 to 1)."""

    estimated_rise_durations_s: Annotated[tuple[PositiveSeconds, ...], NotEmpty] = (1, 1.5, 2, 3, 4)
    """Durations of creeps whose height is estimated together with the regression."""

    creep_threshold_sigmas: Positive = 7
    """Such a creep stands out if its height is so many of its standard deviations, at least."""

    min_estimated_explained_share: Annotated[float, Above(0), Below(1)] = 0.65
    """Share of the variance that the pose leaves unexplained which such a creep must explain, at least (0 to 1)."""

    min_independent_variance: NotNegative = 0.015
    """Variance of the course of the displacement (0 before, 1 after) that the pose does not explain, at least: where poses
    before and after are unlike, there is nothing to compare."""

    floor_mm: Millimetres = 5
    """Smallest displacement."""

    ceiling_mm: Millimetres = 100
    """Largest displacement: markers that are further away are not on their segment."""

    screening_fraction: Share = 0.5
    """A marker is searched closely where a sudden displacement explains this part of `min_explained_share`, at least (0 to 1)."""

    creep_gain: Share = 0.8
    """A creep must leave at most this part of the variance that a sudden displacement leaves (0 to 1)."""

    return_gain: Share = 0.6
    """A displacement that ends must leave at most this part of the variance that one to the end leaves (0 to 1)."""

    drift_widths: Annotated[tuple[Positive, ...], NotEmpty] = (0.8, 1, 1.25)
    """Widths of drifts, in units of its duration, that must explain less than a displacement that ends."""

    shared_evidence_fraction: NotNegative = 0.25
    """Where the same course explains the motion of a neighbour as well, the marker excluded, the pose has changed and not the
    place of one marker: its evidence (explained to unexplained variance) is at least this part of the marker's."""

    shared_size_fraction: NotNegative = 0.3
    """Such a neighbour is displaced by this part of the marker's displacement, at least."""

    outlier_sigmas: Positive = 4
    """Residuals beyond this many robust standard deviations lose weight."""

    max_findings: Count = 2
    """Lasting displacements of one marker, at most."""

    refine_s: PositiveSeconds = 0.3
    """Time on either side of a sudden displacement, beyond the distance of two moments, in which its frame is looked for."""

    same_share: Share = 0.5
    """Two findings of a marker that overlap by this share of the longer one are the same (0 to 1)."""

    moment_frames: CountOrNone = 5
    """What was found as near as this to where a displacement begins or ends shows that moment and nothing else, frames."""

    max_usual_deviation: NotNegative = 0.35
    """The usual distances decide which of the two places is right if those at one deviate from them by at most this part of
    the displacement; see also `usual_factor`."""

    usual_factor: Factor = 1.5
    """Those at the other place must deviate from them by this many times as much."""

    longer_factor: Factor = 1.5
    """Where the usual distances do not decide, the earlier place counts as right if the marker is there for longer by this
    factor."""

    later_longer_factor: Factor = 3
    """The later place counts as right if the marker is there for longer by this factor: most markers are knocked after they were
    placed. Between the two factors it is undecided, and the earlier place is taken."""

    level_block_s: PositiveSeconds = 1
    """The error of a displacement follows from the means of the remaining residual over blocks of this duration."""

    level_correlation_s: PositiveSeconds = 4
    """Time over which these means are correlated."""
