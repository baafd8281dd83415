"""Options of the detectors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any, Literal

from markermend.options.declaration import (
    Above,
    AtLeast,
    AtMost,
    Changes,
    Count,
    CountOrNone,
    Factor,
    Laboratory,
    Millimetres,
    NotEmpty,
    NotNegative,
    Positive,
    PositiveMillimetres,
    PositiveSeconds,
    Seconds,
    Share,
    Shared,
)
from markermend.options.displacement import DisplacementOptions
from markermend.options.long_drifts import LongDriftOptions
from markermend.options.prediction import LocalRidgeOptions, PredictorOptions
from markermend.options.published import (
    PublishedNoiseOptions,
    PublishedPeaksOptions,
    PublishedSlowOptions,
    PublishedStepsOptions,
)
from markermend.options.shape import ShapeOptions

Preset = Annotated[Literal["default", "coordinates", "paper"], Laboratory]
"""The detector: against the neighbours, or coordinate by coordinate with robust thresholds, or as published."""


@dataclass(frozen=True)
class LabelsOptions:
    """Detect exchanged labels.

    The detectors that come after look at trajectories on which these exchanges are undone; those of the preset `paper` look
    at the trajectories as recorded. Without `labels` among `detect`, nothing is exchanged anywhere.
    """

    floor_mm: Annotated[PositiveMillimetres, Laboratory] = 8
    """Smallest jump of an exchange.

    Change it when markers that are exchanged are closer together than this (lower)."""

    max_remaining_fraction: Annotated[float, Above(0), AtMost(1)] = 0.35
    """Largest part of a jump that may remain once two labels are exchanged back (0 to 1).

    Change it when exchanges between close markers in fast motion are missed (higher)."""

    jump_factor: NotNegative = 4
    """A marker jumps if it departs from its median motion by this many times its usual departure."""

    window_s: PositiveSeconds = 0.11
    """Window of the median motion."""

    shape_neighbours: Count = 6
    """Neighbours of either marker whose distances decide which label is which."""

    recorded_label_weight: Share = 0.3
    """The recorded labels count as much as distances of this clearness (0 to 1)."""

    min_clearness: Share = 0.1
    """Smallest clearness with which distances and recorded labels must identify the exchanged part (0 to 1).

    Change it when exchanges that never swap back are missed (lower), or false ones are found (higher)."""

    min_cycle_clearness: Share = 0.3
    """Smallest clearness with which distances alone must show that three or more labels are exchanged (0 to 1).

    Change it when exchanges of three labels are missed (lower), or false ones are found (higher)."""

    spacing_s: PositiveSeconds = 0.1
    """Time between the frames in which labels are judged by the subject's usual shape."""

    max_frames: Count = 2000
    """Frames in which labels are judged so, at most."""

    correlation_s: PositiveSeconds = 0.3
    """Frames count as independent evidence if they are this far apart."""

    min_mean_gain: NotNegative = 0.5
    """Smallest gain of log likelihood with other labels, mean of a stretch."""

    min_gain: Positive = 3
    """Smallest gain of log likelihood with other labels, sum of a stretch.

    Change it when exchanges across gaps are missed (lower), or false ones are found (higher)."""

    change_penalty: NotNegative = 1
    """Gain of log likelihood that each further change of labels in time must bring."""

    max_misfit: NotNegative = 5
    """Largest loss of log likelihood against what is usual of a marker, mean of the samples that get another label."""

    usual_quantile: Share = 0.8
    """Quantile of the log likelihood of a marker over the recording that counts as usual (0 to 1)."""

    min_group_pairs: Count = 2
    """Pairs of left and right markers, or of two subjects, that make a group, at least."""

    max_group_sections: Count = 20
    """Sections between frames at which trajectories of several markers are broken in which groups are looked for, at most."""

    group_anchors: Count = 16
    """Markers to which the distances of a marker are judged where labels of a whole group may be exchanged."""

    min_broken_share: Share = 0.75
    """Labels of several markers pass to each other where so many of their trajectories are broken at the same time (0 to 1)."""

    max_changes: Count = 100
    """Changes of labels that are found by the usual shape, at most."""

    min_foreign_misfit: Positive = 5
    """Smallest loss of log likelihood of a label that is on something else, against what is usual of the marker, mean of a stretch.

    Change it when labels on reflections are missed (lower), or false ones are found (higher)."""

    max_anchor_misfit_fraction: Share = 0.5
    """The markers by which it is judged lose less than this part of it (0 to 1), median of them."""

    min_foreign_mm: Millimetres = 60
    """Smallest deviation of three quarters of the distances; less may be a marker that was displaced on its segment."""

    min_foreign_s: Seconds = 0.5
    """Shortest stretch between two jumps without a gap; shorter ones are left to peaks and steps."""

    max_foreign_share: Share = 0.5
    """Largest share of the samples of a label in a recording that is on something else (0 to 1), unless it rests there."""

    max_rest_mm: Millimetres = 10
    """A label rests if its samples extend no farther than this, from the 5th to the 95th percentile."""

    min_anchor_motion_mm: Millimetres = 30
    """Smallest extent of the samples of the markers by which it is judged in the meantime, median of them."""

    max_still_mm: Millimetres = 3
    """A fallen marker lies still to the end of its trajectory: its samples are not farther from the place than this."""

    min_still_s: Seconds = 1
    """Shortest time that it lies still, while three quarters of the markers by which it is judged move."""

    max_same_mm: Millimetres = 10
    """Labels nearer to each other than this are on the same marker."""

    fall_s: Seconds = 0.5
    """Longest time in which a marker falls off."""

    max_onset_misfit: NotNegative = 1
    """A fall begins after the last sample whose loss of log likelihood is below this."""

    max_exchanged_share: Share = 0.4
    """Largest share of a recording over which labels may be exchanged back by the usual shape, if that is known from the same
    recording alone (0 to 1). More is left and warned of.
    Change it when labels are right in a smaller part of a recording than this (higher)."""

    min_open_share: Share = 0.3
    """Smallest share of a recording in which the distances of two counterparts are interchanged, to warn of it (0 to 1)."""

    min_open_mm: Millimetres = 60
    """Smallest difference between the distances of the two to a marker that may tell them apart, mean."""

    max_open_spread: NotNegative = 0.25
    """Largest standard deviation of this difference and of the sum of the distances, as a part of the difference."""

    open_frames: Count = 60
    """Frames in which such markers are looked for, about."""

    shape: Annotated[ShapeOptions, Shared()] = field(default_factory=ShapeOptions)
    """The subject's usual shape."""


@dataclass(frozen=True)
class DetectorOptions:
    """What all detectors share."""

    predictors: Annotated[PredictorOptions, Shared(("local_ridge",))] = field(default_factory=PredictorOptions)
    """The predictors."""


@dataclass(frozen=True)
class RepeatedFramesOptions:
    """Frames that repeat the frame before."""

    min_repeated_share: Annotated[float, Above(0), AtMost(1)] = 0.9
    """Share of the markers seen in a frame and in that before that have exactly the same position in both, at least (0 to 1)."""

    min_markers: Count = 3
    """Markers that repeat their positions, at least."""

    min_moving_share: Annotated[float, Above(0), AtMost(1)] = 0.25
    """Share of these markers that move just before and just after, at least (0 to 1)."""

    min_speed_mm_s: NotNegative = 10
    """Speed from which a marker moves."""

    min_resolution_steps: NotNegative = 3
    """A marker moves if it changes by this many steps of the stored values from one frame to the next, at least."""

    min_speed_ratio: Share = 0.5
    """It moves just before and after at this part of its usual speed there, at least: motion that comes to rest is no fault (0 to 1)."""

    min_regular_share: Annotated[float, Above(0), AtMost(1)] = 0.8
    """If this share of the frames with motion lies between regular repetitions, the recording has frames of a lower rate, and stays as it is (0 to 1)."""


@dataclass(frozen=True)
class SceneJumpOptions:
    """Jumps of all markers at once."""

    floor_mm: PositiveMillimetres = 4
    """Smallest jump, median over the markers."""

    usual_factor: NotNegative = 3
    """Smallest jump, in units of the median of what the motion makes of it around."""

    scale_window_s: PositiveSeconds = 0.5
    """Window of that median."""

    max_residual_fraction: Annotated[float, Above(0), AtMost(1)] = 0.4
    """Distance of a marker from the rigid displacement of all, as a part of the jump, at most (0 to 1)."""

    min_share: Annotated[float, Above(0), AtMost(1)] = 0.9
    """Share of the markers within that distance, at least (0 to 1)."""

    min_markers: Annotated[int, AtLeast(4)] = 6
    """Markers that are seen on both sides of the jump, at least."""

    max_duration_s: PositiveSeconds = 5
    """Longest time after which a second jump takes the markers back."""

    max_remaining_fraction: Share = 0.3
    """What remains of a jump once it is taken back, as a part of it, at most (0 to 1)."""


@dataclass(frozen=True)
class SegmentSlipOptions:
    """Markers of a segment that slip together over a few frames."""

    max_frames: Count = 6
    """Longest slip, frames, without the flanks over which it begins and ends."""

    floor_mm: PositiveMillimetres = 3
    """Smallest slip."""

    threshold_sigmas: Positive = 9
    """Smallest slip, in units of what the motion usually makes of it, in the laboratory and against the neighbours."""

    noise_mm: PositiveMillimetres = 0.05
    """Noise that is always allowed for."""

    scale_window_s: PositiveSeconds = 0.6
    """Window over which the usual size is estimated."""

    context_frames: Annotated[int, AtLeast(2)] = 3
    """Frames on either side with which a slip is compared."""

    max_impact_ratio: Annotated[float, Above(0), AtMost(1)] = 0.5
    """What a slip leaves unexplained of the motion, as a part of what an impact, a break of the velocity, would leave, at most."""

    max_disagreement: Annotated[float, Above(0), AtMost(1)] = 0.5
    """Distance of a marker's displacement from that of the others, as a part of it, at most (0 to 1)."""

    min_markers: Annotated[int, AtLeast(2)] = 3
    """Markers that slip together, at least."""

    anchors: Annotated[int, AtLeast(3)] = 6
    """Nearest markers that do not slip with these, against which they move."""

    min_share: Annotated[float, Above(0), AtMost(1)] = 0.6
    """Share of the anchors that stay in their places, at least (0 to 1)."""


@dataclass(frozen=True)
class FramesOptions(DetectorOptions):
    """Detect faults of the capture system: repeated frames, jumps of all markers, slips of whole segments."""

    repeats: RepeatedFramesOptions = field(default_factory=RepeatedFramesOptions)
    """Frames that all markers repeat."""

    jumps: SceneJumpOptions = field(default_factory=SceneJumpOptions)
    """Jumps of all markers at once."""

    slips: SegmentSlipOptions = field(default_factory=SegmentSlipOptions)
    """Slips of the markers of a segment."""


@dataclass(frozen=True)
class FrozenOptions(DetectorOptions):
    """Detect frozen markers."""

    min_frames: Annotated[int, AtLeast(2), Laboratory] = 4
    """Frames with exactly the same position, at least.

    Change it when short repetitions of a position are normal in your data (higher)."""

    floor_mm: Annotated[Millimetres, Laboratory] = 3
    """Motion of the neighbours, and predicted motion of the marker, in the meantime, at least.

    Change it when markers that really rest are reported (higher)."""

    threshold_sigmas: Annotated[NotNegative, Laboratory] = 4
    """Predicted motion of the marker in standard deviations of the prediction, at least.

    Change it when there are too many false findings (higher), or artifacts are missed (lower)."""

    neighbours: Annotated[int, AtLeast(3)] = 3
    """Nearest neighbours, which must move in the meantime."""


@dataclass(frozen=True)
class TailsOptions(DetectorOptions):
    """Detect noisy tails next to gaps."""

    max_duration_s: Annotated[PositiveSeconds, Laboratory] = 0.1
    """Longest tail.

    Change it when longer artifacts of this class are real in your data."""

    floor_mm: Annotated[Millimetres, Laboratory] = 5
    """Distance of the worst sample of a tail from the prediction, at least.

    Change it when deviations too small to matter to you are reported (higher)."""

    threshold_sigmas: Annotated[NotNegative, Laboratory] = 6
    """The same distance in standard deviations of the prediction, at least.

    Change it when there are too many false findings (higher), or artifacts are missed (lower)."""

    min_seen_before_s: PositiveSeconds = 0.1
    """Time for which the marker must be seen beyond the longest tail, on the side away from the gap."""

    scale_window_s: PositiveSeconds = 0.5
    """Window over which the usual size of changes is estimated."""

    onset_factor: NotNegative = 8
    """A tail begins with a change that exceeds the usual size by this factor."""

    half_fraction: NotNegative = 0.5
    """Half of the samples of a tail must exceed this part of the two thresholds (0 to 1)."""


@dataclass(frozen=True)
class ResidualWindowOptions:
    """Options of the matched filter on windows of the residual."""

    threshold_sigmas: Annotated[Positive, Laboratory] = 9.5
    """Smallest finding, in units of the usual residual.

    Change it when there are too many false findings (higher), or artifacts are missed (lower)."""

    floor_mm: Annotated[Millimetres, Laboratory] = 2
    """Smallest finding.

    Change it when deviations too small to matter to you are reported (higher)."""

    context_s: PositiveSeconds = 0.05
    """Context on either side with which a finding is compared."""

    polynomial_order: Annotated[int, AtLeast(0), AtMost(5)] = 2
    """Polynomials in time up to this order are never a finding, whatever their size."""

    white_noise_ratio: Positive = 0.01
    """Independent noise that is always allowed for, in units of the mean variance (far above 1: samples count as independent)."""

    covariance_windows: Annotated[int, AtLeast(100)] = 20000
    """Windows from which the covariance of the residual is estimated, at most."""

    scale_window_s: PositiveSeconds = 1.5
    """Window over which the local scale of the residual is estimated."""

    max_scale_ratio: Factor = 3
    """The local scale of a marker counts up to this multiple of that of its nearest neighbours."""

    scale_neighbours: Count = 6
    """Nearest neighbours with which the local scale is compared."""

    attribution_rounds: CountOrNone = 2
    """Rounds in which neighbours with overlapping findings are searched again."""

    attribution_neighbours: Count = 12
    """Nearest neighbours to which a finding in several residuals may be attributed."""


@dataclass(frozen=True)
class CommonMotionOptions:
    """Options by which common motion, such as an impact, is distinguished from artifacts of single markers."""

    min_unexplained_fraction: Share = 0.15
    """Part of the marker's acceleration that its neighbours, all of them seen, leave unexplained, at least (0 to 1)."""

    min_unexplained_amid_motion: Share = 0.6
    """The same where more than `max_moving_share` of the markers are accelerated, as at an impact (0 to 1).

    Change it when impacts are taken for artifacts (higher), or artifacts amid an impact are missed (lower)."""

    alike_fraction: Share = 0.5
    """Another marker counts as accelerated from this part of the marker's own acceleration on (0 to 1)."""

    max_moving_share: Share = 0.2
    """Share of the other markers that may be accelerated (0 to 1)."""


@dataclass(frozen=True)
class PeaksOptions(ResidualWindowOptions, DetectorOptions):
    """Detect isolated peaks.

    The options here and in `advanced.peaks` are those of the preset `default`; each other preset has its own in
    `advanced.peaks.PRESET`.
    """

    preset: Preset = "default"
    """The detector: `default` (against the neighbours, all axes together), `coordinates` (coordinate by coordinate, with
    robust thresholds) or `paper` (as published: skurowski2022).

    Change it when you repeat the paper (`paper`), or there are no neighbours to compare with (`coordinates`)."""

    max_duration_s: Annotated[PositiveSeconds, Laboratory] = 0.05
    """Longest peak.

    Change it when longer artifacts of this class are real in your data."""

    white_noise_ratio: Positive = 0.01
    """Independent noise that is always allowed for, in units of the mean variance (far above 1: samples count as independent).

    Change it when heavy noise is torn into peaks (higher), or artifacts on smoothed trajectories are missed (lower)."""

    extent_fraction: Share = 0.25
    """Samples belong to the peak if they deviate by this part of its largest deviation (0 to 1)."""

    max_shift_ratio: NotNegative = 1.8
    """A finding is no peak if a level shift leaves at most this many times the residual that remains without its samples.

    Change it when the edges of steps are taken for peaks (higher)."""

    common_motion: CommonMotionOptions = field(default_factory=CommonMotionOptions)
    """Options by which common motion is distinguished from peaks."""

    shape: Annotated[ShapeOptions, Shared()] = field(default_factory=ShapeOptions)
    """The subject's usual shape."""

    coordinates: PublishedPeaksOptions = field(default_factory=PublishedPeaksOptions)
    """Options of the preset `coordinates`: coordinate by coordinate, with robust thresholds."""

    paper: PublishedPeaksOptions = field(
        default_factory=lambda: PublishedPeaksOptions(
            trend_removal="difference_of_median", scale_estimator="std", threshold_sigmas=3, floor_mm=0
        )
    )
    """Options of the preset `paper`: as published (skurowski2022)."""


@dataclass(frozen=True)
class IncrementOptions:
    """Options of the detection of sudden changes in the residual."""

    threshold_sigmas: Annotated[Positive, Laboratory] = 6
    """Smallest sudden change, in units of the usual size of changes.

    Change it when there are too many false findings (higher), or artifacts are missed (lower)."""

    floor_mm: Annotated[Millimetres, Laboratory] = 2.5
    """Smallest sudden change, per frame at 100 Hz.

    Change it when changes too small to matter to you are reported (higher)."""

    median_window_s: PositiveSeconds = 0.05
    """Window of the moving median that removes the trend from the differences."""

    scale_window_s: PositiveSeconds = 1.5
    """Window over which the usual size of changes is estimated."""

    max_scale_ratio: Factor = 3
    """The usual size of a marker's changes counts up to this multiple of that of its nearest neighbours."""

    scale_neighbours: Count = 6
    """Nearest neighbours with which the usual size is compared."""

    tail_factor: NotNegative = 5
    """Smallest sudden change, in units of the size at `tail_quantile`: some systems jitter all the time."""

    tail_quantile: Share = 0.95
    """Share of the recording's samples whose changes do not exceed that size (0 to 1)."""

    attribution_rounds: CountOrNone = 2
    """Rounds in which neighbours with overlapping findings are searched again."""

    attribution_neighbours: Count = 12
    """Nearest neighbours to which a change in several residuals may be attributed."""


@dataclass(frozen=True)
class ExcessVarianceOptions:
    """Options of the detection of excess variance in a band of frequencies."""

    window_s: PositiveSeconds = 0.15
    """Window of the root mean square."""

    min_duration_s: PositiveSeconds = 0.25
    """Shortest time for which the threshold is exceeded."""

    floor_mm: PositiveMillimetres = 0.8
    """Smallest root mean square.

    Change it when shaking too small to matter to you is reported (higher)."""

    threshold_factor: Annotated[float, AtLeast(1)] = 1.8
    """Smallest root mean square, in units of that at `tail_quantile`: relative to what is usual of the marker, and to the motion of its neighbours.

    Change it when there are too many false findings (higher), or artifacts are missed (lower)."""

    tail_quantile: Share = 0.95
    """Share of the recording's samples that do not exceed that size (0 to 1)."""

    scale_neighbours: Count = 6
    """Nearest neighbours whose residuals set what is usual at the time."""

    min_seen_share: Share = 0.5
    """Share of them that must be seen: without them the prediction of a marker is worse than usual (0 to 1)."""

    motion_neighbours: Count = 3
    """Nearest neighbours of which the one that moves most in the band sets how much the body shakes."""

    min_motion_ratio: NotNegative = 0.3
    """Smallest root mean square, as a part of that of their motion: at an impact soft tissue shakes along.

    Change it when impacts are taken for noise (higher)."""

    border_power_fraction: Share = 0.2
    """The stretch extends to the last sample whose square exceeds this part of the median mean square (0 to 1).

    Change it when repair follows the first or last distorted sample, which was not found (lower)."""


@dataclass(frozen=True)
class JitterOptions(ExcessVarianceOptions):
    """Options of the detection of jitter from frame to frame."""


@dataclass(frozen=True)
class WobbleOptions(ExcessVarianceOptions):
    """Options of the detection of wobble of several Hz."""

    window_s: PositiveSeconds = 0.3
    """Window of the root mean square."""

    min_duration_s: PositiveSeconds = 0.6
    """Shortest time for which the threshold is exceeded."""

    threshold_factor: Annotated[float, AtLeast(1)] = 1.4
    """Smallest root mean square, in units of that at `tail_quantile`: relative to what is usual of the marker, and to the motion of its neighbours."""

    band_hz: tuple[Positive, Positive] = (5, 13)
    """The band of frequencies: one for all, since a wobble that varies has its power at several at a time.

    Change it when markers wobble more slowly or faster in your data."""

    filter_s: PositiveSeconds = 0.5
    """Length of the band-pass filter."""

    border_power_fraction: Share = 0.15
    """The stretch extends to the last sample whose square exceeds this part of the median mean square (0 to 1).

    Change it when repair follows the first or last distorted sample, which was not found (lower)."""


@dataclass(frozen=True)
class NoiseOptions(IncrementOptions, DetectorOptions):
    """Detect heavy noise.

    The options here and in `advanced.noise` are those of the preset `default`; each other preset has its own in
    `advanced.noise.PRESET`.
    """

    preset: Preset = "default"
    """The detector: `default` (against the neighbours, all axes together), `coordinates` (coordinate by coordinate, with
    robust thresholds) or `paper` (as published: skurowski2022).

    Change it when you repeat the paper (`paper`), or there are no neighbours to compare with (`coordinates`)."""

    min_duration_s: Annotated[Seconds, Laboratory] = 0.1
    """Shortest stretch of heavy noise.

    Change it when findings are too short to be of this class."""

    link_s: Seconds = 0.1
    """Sudden changes that are no further from each other than this belong to one stretch."""

    min_sudden_share: Share = 0.2
    """Share of the samples of a stretch that change suddenly, at least (0 to 1)."""

    min_sudden_changes: Count = 6
    """Sudden changes of a stretch, at least."""

    jitter: JitterOptions = field(default_factory=JitterOptions)
    """Options of the detection of jitter from frame to frame, whose single changes are not sudden."""

    wobble: WobbleOptions = field(default_factory=WobbleOptions)
    """Options of the detection of wobble of several Hz."""

    shape: Annotated[ShapeOptions, Shared()] = field(default_factory=ShapeOptions)
    """The subject's usual shape."""

    coordinates: PublishedNoiseOptions = field(default_factory=PublishedNoiseOptions)
    """Options of the preset `coordinates`: coordinate by coordinate, with robust thresholds."""

    paper: PublishedNoiseOptions = field(
        default_factory=lambda: PublishedNoiseOptions(
            scale_estimator="std", threshold_sigmas=2, floor_mm=0, min_sudden_share=0, min_sudden_changes=1
        )
    )
    """Options of the preset `paper`: as published (skurowski2022)."""


@dataclass(frozen=True)
class StepsOptions(ResidualWindowOptions, DetectorOptions):
    """Detect steps.

    The options here and in `advanced.steps` are those of the preset `default`; each other preset has its own in
    `advanced.steps.PRESET`.
    """

    shape: Annotated[ShapeOptions, Shared()] = field(default_factory=ShapeOptions)
    """The evidence of the subject's usual shape."""

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

    correlation_time_s: PositiveSeconds = 0.25
    """Time over which the level of a marker against its neighbours varies: samples nearer to each other say the same."""

    remaining_fractions: Annotated[tuple[Annotated[float, Above(0), AtMost(1)], ...], NotEmpty] = (1, 0.5, 0.25)
    """Parts of a displacement, all of them tried, that remain in the residual: the regression has learnt the others (0 to 1)."""

    min_shape_deviation_mm: PositiveMillimetres = 0.5
    """No distance counts as steadier than this when levels are compared."""

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
            scale_estimator="std", threshold_sigmas=4, floor_mm=0, min_duration_s=0.2
        )
    )
    """Options of the preset `paper`: as published (skurowski2022)."""


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
    for the deviation of the steadiest distance, above which long drifts are not found."""

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

    long_drifts: LongDriftOptions = field(default_factory=LongDriftOptions)
    """Options of the drifts of a second and more."""

    paper: PublishedSlowOptions = field(default_factory=PublishedSlowOptions)
    """Options of the preset `paper`: as published (skurowski2022)."""
