"""Options of the detection of heavy noise, jitter and wobble."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated

from markermend.options.declaration import (
    AtLeast,
    Count,
    CountOrNone,
    Factor,
    Laboratory,
    Millimetres,
    NotNegative,
    Positive,
    PositiveMillimetres,
    PositiveSeconds,
    Seconds,
    Share,
    Shared,
)
from markermend.options.detection.detector import DetectorOptions, Preset
from markermend.options.detection.published import PublishedNoiseOptions
from markermend.options.shape import ShapeOptions


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

    threshold_factor: Positive = 0.55
    """Smallest root mean square in a recording of one window, in units of that at `tail_quantile`: relative to what is usual of
    the marker, and to the motion of its neighbours.

    Change it when there are too many false findings (higher), or artifacts are missed (lower)."""

    tail_index: Share = 0.2
    """The threshold rises with this power of the number of windows in the recording, as the largest of many does."""

    tail_quantile: Share = 0.9
    """Share of the recording's samples that do not exceed that size (0 to 1)."""

    level_quantile: Share = 0.25
    """The quantile of a marker's root mean squares from which its usual one is estimated (0 to 1): it may shake half of the time."""

    scale_neighbours: Count = 6
    """Nearest neighbours whose residuals set what is usual at the time."""

    min_seen_share: Share = 0.5
    """Share of them that must be seen: without them the prediction of a marker is worse than usual (0 to 1)."""

    motion_neighbours: Count = 3
    """Nearest neighbours of which the one that moves most in the band sets how much the body shakes."""

    min_motion_ratio: NotNegative = 0.3
    """Smallest root mean square, as a part of that of their motion: at an impact soft tissue shakes along.

    Change it when impacts are taken for noise (higher)."""

    min_evenness: Share = 0.5
    """Smallest root mean square of the changes from frame to frame as their median suggests it, as a part of the real one (0 to 1):
    where it is smaller, a few changes make up most of it, as at a jump of any size."""

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

    min_duration_s: PositiveSeconds = 0.5
    """Shortest time for which the threshold is exceeded."""

    threshold_factor: Positive = 0.4
    """Smallest root mean square in a recording of one window, in units of that at `tail_quantile`: relative to what is usual of
    the marker, and to the motion of its neighbours."""

    band_hz: tuple[Positive, Positive] = (5, 13)
    """The band of frequencies: one for all, since a wobble that varies has its power at several at a time.

    Change it when markers wobble more slowly or faster in your data."""

    filter_s: PositiveSeconds = 0.5
    """Length of the band-pass filter."""

    border_power_fraction: Share = 0.15
    """The stretch extends to the last sample whose square exceeds this part of the median mean square (0 to 1).

    Change it when repair follows the first or last distorted sample, which was not found (lower)."""


@dataclass(frozen=True)
class FlickerOptions:
    """Options of the detection of flicker between two levels."""

    max_dwell_s: PositiveSeconds = 0.15
    """Time that a marker stays at either level, at most: one that is at its place for longer has two displacements of their own."""

    min_jumps: Annotated[int, AtLeast(3)] = 4
    """Jumps between the levels, at least."""

    max_mismatch: Share = 0.3
    """Difference between a jump and the one before it, which it undoes, as a part of their size, at most (0 to 1)."""

    min_undone_share: Share = 0.5
    """Part of the first or last jump that a change undoes, at least, to count as the one that an odd number of jumps lacks (0 to
    1)."""


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

    flicker: FlickerOptions = field(default_factory=FlickerOptions)
    """Options of the detection of flicker between two levels, whose changes are rarer than those of noise."""

    shape: Annotated[ShapeOptions, Shared()] = field(default_factory=ShapeOptions)
    """The subject's usual shape."""

    coordinates: PublishedNoiseOptions = field(default_factory=PublishedNoiseOptions)
    """Options of the preset `coordinates`: coordinate by coordinate, with robust thresholds."""

    paper: PublishedNoiseOptions = field(
        default_factory=lambda: PublishedNoiseOptions(
            scale_estimator="std",
            sigma_over="recording",
            threshold_sigmas=2,
            floor_mm=0,
            element_s=0.19,
            min_sudden_share=0,
            min_sudden_changes=1,
        )
    )
    """Options of the preset `paper`: as published (skurowski2022)."""
