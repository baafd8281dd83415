"""Options of the evidence that residual and usual distances give of a displaced level."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated

from markermend.options.declaration import (
    Above,
    AtMost,
    Count,
    NotEmpty,
    NotNegative,
    PositiveMillimetres,
    PositiveSeconds,
)


@dataclass(frozen=True)
class SimilarPosesOptions:
    """Compare the distances of a marker with those at similar poses at other times: what recurs with the pose is motion."""

    neighbours: Count = 8
    """Nearest neighbours to which the distances of a marker are compared, and whose distances among each other are the pose."""

    poses: Count = 9
    """The most similar poses from which the distances are predicted."""

    min_poses: Count = 3
    """Fewer of them predict nothing."""

    sampling_interval_s: PositiveSeconds = 0.1
    """Time from one pose that is looked at to the next."""

    pose_tolerance_mm: PositiveMillimetres = 0.5
    """Poses are equally similar where the distances of the marker would differ by less, see `distance_slope`."""

    distance_slope: NotNegative = 0.1
    """By how much the distances of a marker may differ where the pose does, per mm of its root mean square difference."""

    min_deviation_mm: PositiveMillimetres = 1.5
    """Standard deviation of the distances at equal poses, at least: a few distances do not fix a pose to the millimetre.

    Change it when small steps are missed (higher), or motion that recurs is taken for steps (lower)."""

    max_samples: Count = 8
    """Frames of a stretch, evenly spaced, that are compared."""


@dataclass(frozen=True)
class LevelOptions:
    """Judge by the residual and by the usual distances whether a marker is displaced for some time.

    Steps and dips are judged by the same evidence.
    """

    correlation_time_s: PositiveSeconds = 0.25
    """Time over which the level of a marker against its neighbours varies: samples nearer to each other say the same."""

    remaining_fractions: Annotated[tuple[Annotated[float, Above(0), AtMost(1)], ...], NotEmpty] = (1, 0.5, 0.25)
    """Parts of a displacement, all of them tried, that remain in the residual: the regression has learnt the others (0 to 1)."""

    min_shape_deviation_mm: PositiveMillimetres = 0.5
    """No distance counts as steadier than this when levels are compared."""

    similar_poses: SimilarPosesOptions = field(default_factory=SimilarPosesOptions)
    """Comparison with similar poses at other times."""
