"""Options of the detection of peaks."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated

from markermend.options.declaration import (
    Count,
    Factor,
    Laboratory,
    NotNegative,
    Positive,
    PositiveSeconds,
    Share,
    Shared,
)
from markermend.options.detection.detector import DetectorOptions, Preset
from markermend.options.detection.level import LevelOptions
from markermend.options.detection.published import PublishedPeaksOptions
from markermend.options.detection.residual_windows import ResidualWindowOptions
from markermend.options.shape import ShapeOptions


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

    max_dip_duration_s: PositiveSeconds = 0.12
    """Longest dip: longer than a peak, and too short for the two jumps of a step to be separated if they have ramps."""

    dip_length_ratio: Factor = 1.2
    """Dips are looked for at lengths that grow by this factor: a pattern fits a dip that is a little shorter or longer."""

    dip_threshold_factor: Positive = 1.25
    """Threshold of a dip, in units of that of a peak: motion makes such pulses.

    Change it when motion is taken for dips (higher), or dips are missed (lower)."""

    likely_dip_threshold_factor: Positive = 0.7
    """The same of a dip for which residual and usual distances speak both, see `min_dip_log_ratio`."""

    unlikely_dip_threshold_factor: Positive = 2
    """The same of a dip against which the usual distances speak."""

    min_dip_log_ratio: NotNegative = 3
    """Residual and distances speak for a dip if the logarithm of the ratio of the likelihoods with it and without it is at least this."""

    white_noise_ratio: Positive = 0.01
    """Independent noise that is always allowed for, in units of the mean variance (far above 1: samples count as independent).

    Change it when heavy noise is torn into peaks (higher), or artifacts on smoothed trajectories are missed (lower)."""

    extent_fraction: Share = 0.25
    """Samples belong to the peak if they deviate by this part of its largest deviation (0 to 1)."""

    dip_extent_fraction: Share = 0.15
    """The same of a dip, whose ramps belong to it (0 to 1)."""

    dip_ramp_frames: Count = 2
    """Samples of the ramps of a dip on either side of the pattern by which it is found, at most."""

    max_shift_ratio: NotNegative = 1.8
    """A finding is no peak if a level shift leaves at most this many times the residual that remains without its samples.

    Change it when the edges of steps are taken for peaks (higher)."""

    max_kink_ratio: NotNegative = 1.5
    """A finding is no peak if a change of velocity leaves at most this many times the residual that remains without its samples.

    Change it when impacts are taken for peaks (higher)."""

    common_motion: CommonMotionOptions = field(default_factory=CommonMotionOptions)
    """Options by which common motion is distinguished from peaks."""

    shape: Annotated[ShapeOptions, Shared()] = field(default_factory=ShapeOptions)
    """The subject's usual shape."""

    level: Annotated[LevelOptions, Shared()] = field(default_factory=LevelOptions)
    """The evidence of a displaced level."""

    coordinates: PublishedPeaksOptions = field(default_factory=PublishedPeaksOptions)
    """Options of the preset `coordinates`: coordinate by coordinate, with robust thresholds."""

    paper: PublishedPeaksOptions = field(
        default_factory=lambda: PublishedPeaksOptions(
            trend_removal="difference_of_median",
            scale_estimator="std",
            sigma_over="recording",
            threshold_sigmas=3,
            floor_mm=0,
            localisation="window",
            joined_candidates=False,
        )
    )
    """Options of the preset `paper`: as published (skurowski2022)."""
