"""Options of the detection of steps."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated

from markermend.options.declaration import (
    Above,
    AtLeast,
    AtMost,
    CountOrNone,
    Factor,
    Laboratory,
    NotNegative,
    Positive,
    PositiveSeconds,
    Seconds,
    Share,
    Shared,
)
from markermend.options.detection.detector import DetectorOptions, Preset
from markermend.options.detection.displacement import DisplacementOptions
from markermend.options.detection.level import LevelOptions
from markermend.options.detection.published import PublishedStepsOptions
from markermend.options.detection.residual_windows import ResidualWindowOptions
from markermend.options.shape import ShapeOptions


@dataclass(frozen=True)
class StepsOptions(ResidualWindowOptions, DetectorOptions):
    """Detect steps.

    The options here and in `advanced.steps` are those of the preset `default`; each other preset has its own in
    `advanced.steps.PRESET`.
    """

    shape: Annotated[ShapeOptions, Shared()] = field(default_factory=ShapeOptions)
    """The evidence of the subject's usual shape."""

    level: Annotated[LevelOptions, Shared()] = field(default_factory=LevelOptions)
    """The evidence of a displaced level."""

    displacement: Annotated[DisplacementOptions, Shared()] = field(default_factory=DisplacementOptions)
    """Lasting displacements."""

    preset: Preset = "default"
    """The detector: `default` (against the neighbours, all axes together), `coordinates` (coordinate by coordinate, with
    robust thresholds) or `paper` (as published: skurowski2022).

    Change it when you repeat the paper (`paper`), or there are no neighbours to compare with (`coordinates`)."""

    min_duration_s: Annotated[Seconds, Laboratory] = 0.06
    """Shortest time between the two jumps of a step.

    Change it when findings are too short to be of this class."""

    max_duration_s: Annotated[PositiveSeconds, Laboratory] = 2
    """Longest time between the two jumps of a step.

    Change it when longer artifacts of this class are real in your data."""

    threshold_sigmas: Annotated[Positive, Laboratory] = 6.9
    """Smallest jump, in units of the usual residual.

    Change it when there are too many false findings (higher), or artifacts are missed (lower)."""

    context_s: PositiveSeconds = 0.04
    """Context on either side with which a jump is compared."""

    polynomial_order: Annotated[int, AtLeast(0), AtMost(5)] = 3
    """Polynomials in time up to this order are never a finding, whatever their size."""

    white_noise_ratio: Positive = 1000
    """Independent noise that is always allowed for, in units of the mean variance (far above 1: samples count as independent)."""

    max_ramp_frames: CountOrNone = 3
    """Samples on the way between the two levels of a jump, at most."""

    ramp_cost: NotNegative = 0.15
    """By which part of itself the threshold of a jump rises with each sample on the way: motion has ramps."""

    sidelobe_fraction: Share = 0.25
    """A jump whose window overlaps that of a larger one is a sidelobe of it below this part of its score (0 to 1)."""

    clear_acceleration_ratio: NotNegative = 3
    """The threshold of a jump rises in proportion where the marker is accelerated by less than this many times what most of its
    neighbours are at that moment.

    Change it when motion is taken for steps (higher), or steps amid motion are missed (lower)."""

    neighbour_acceleration_quantile: Share = 0.75
    """Quantile of the accelerations of the neighbours with which that of the marker is compared: artifacts of a few must not excuse
    it (0 to 1)."""

    single_jump_fraction: Annotated[float, Above(0), AtMost(1)] = 0.6
    """Size of each of the two jumps as a part of the threshold, at least (0 to 1).

    Change it when steps whose jumps differ in clearness are missed (lower)."""

    joint_jump_fraction: Annotated[float, Above(0), AtMost(1)] = 0.78
    """Geometric mean of the two jumps as a part of the threshold, at least (0 to 1).

    Change it when weak steps are missed (lower)."""

    jump_exponent: Positive = 8
    """Jumps of motion become rarer with this power of their size."""

    jump_mismatch_fraction: Positive = 0.2
    """Standard deviation of the sum of the two jumps of a step, as a part of their size."""

    displaced_cost_per_s: NotNegative = 8
    """By how much the logarithm of the likelihood of a step falls with its duration, per second: the longer part is right where
    nothing else decides."""

    min_probability: Share = 0.95
    """Probability that a stretch is displaced rather than the stretches around it, or none, at least (0 to 1).

    Change it when good stretches are moved (higher)."""

    level_window_s: PositiveSeconds = 0.3
    """Time beyond a gap over which a marker must be back where a gap cuts a step short, and within which a marker that flickers
    returns to the same level."""

    min_flicker_duration_s: Seconds = 0.02
    """Shortest time between two jumps of a marker that flickers, with a step to the same level nearby."""

    recording_end_factor: Factor = 2
    """Size of the jump, in units of the threshold, of a step that an end of the recording cuts short, at least."""

    coordinates: PublishedStepsOptions = field(default_factory=PublishedStepsOptions)
    """Options of the preset `coordinates`: coordinate by coordinate, with robust thresholds."""

    paper: PublishedStepsOptions = field(
        default_factory=lambda: PublishedStepsOptions(
            scale_estimator="std", sigma_over="recording", threshold_sigmas=3, floor_mm=0, min_duration_s=0.2
        )
    )
    """Options of the preset `paper`: as published (skurowski2022)."""
