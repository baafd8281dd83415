"""Options of the repair."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any

from markermend.options.declaration import (
    AtLeast,
    AtMost,
    Changes,
    Count,
    CountOrNone,
    Factor,
    Keys,
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
from markermend.options.detection.displacement import DisplacementOptions
from markermend.options.prediction.local_ridge import LocalRidgeOptions
from markermend.options.prediction.predictors import PredictorOptions

USUAL_METHODS: Mapping[str, tuple[str, ...]] = {
    "labels": ("exchange",),
    "frames": ("move_back", "spline", "local_ridge"),
    "peaks": ("spline", "local_ridge"),
    "noise": ("separate_levels", "separate_noise", "local_ridge"),
    "steps": ("separate_step", "local_ridge"),
    "slow": ("separate_slow",),
}
"""The usual methods of each class of artifacts that is repaired."""


@dataclass(frozen=True)
class SeparationOptions:
    """Separation of the marker's trajectory from the artifact on it."""

    local_ridge_changes: Annotated[tuple[Annotated[Mapping[str, Any], Changes(LocalRidgeOptions)], ...], NotEmpty] = (
        {},
        {"anchors": 6, "inputs": 20},
        {"anchors": 4, "inputs": 8, "ridge_mm2": 1.0},
    )
    """The local ridges that predict together: the options in which each differs from `local_ridge`; `{}` is that itself.

    Change it when repair takes too long (fewer)."""

    amplitudes_mm: Annotated[tuple[Annotated[PositiveMillimetres, AtMost(10000)], ...], NotEmpty] = (4, 12, 36)
    """Amplitudes of artifacts that are tried.

    Change it when your artifacts are smaller or larger."""

    roughness_mm: Annotated[tuple[PositiveMillimetres, ...], NotEmpty] = (0.2, 2)
    """Standard deviations, all of them tried, of white noise by which an artifact may depart from the shape of its class."""

    oscillations_hz: tuple[Positive, ...] = (5, 6.5, 8.5, 11)
    """Frequencies of wobble that are tried beside white noise."""

    oscillation_mm: PositiveMillimetres = 4
    """Standard deviation of wobble."""

    oscillation_coherence_s: PositiveSeconds = 0.15
    """Time over which amplitude and phase of wobble stay alike."""

    max_level_error: Share = 0.2
    """Flicker between two levels: what the levels leave of the changes from frame to frame (root mean square, per axis and
    from one level to the other), as a part of their distance, at most (0 to 1)."""

    min_level_changes: Annotated[int, AtLeast(2)] = 4
    """Changes between the two levels, at least."""

    level_trend_frames: Count = 9
    """Changes over which those within levels are averaged: the slow error of the prediction."""

    step_ramps_frames: Annotated[tuple[CountOrNone, ...], NotEmpty] = (0, 2)
    """Frames, all of them tried, that a step takes to its level and back."""

    border_s: Seconds = 0.15
    """Time on either side of a finding whose samples are used."""

    margin_fractions: Annotated[tuple[NotNegative, ...], NotEmpty] = (0, 0.1)
    """Parts of its duration, all of them tried, by which a slow change may begin earlier and end later than was found."""

    likelihood_power: Share = 0.15
    """Power to which the likelihood of an artifact counts: 1 takes the assumed shapes and covariances as exact, 0 weighs all
    equally (0 to 1)."""

    max_frames: Annotated[int, AtLeast(2)] = 1000
    """Longer artifacts, in frames, are not separated: time and memory grow fast."""


@dataclass(frozen=True)
class RepairRadiusOptions:
    """Radii of the balls around repaired samples."""

    inner: Positive = 1.7
    """Radius of the ball that holds the true position with probability 0.68, in stated standard deviations of one axis."""

    outer: Positive = 3.4
    """Radius of the ball that holds it with probability 0.95, in the same units."""


@dataclass(frozen=True)
class ShapeGuardOptions:
    """Guard against repairs that take a marker away from the subject's usual shape."""

    mates: Count = 8
    """Markers to which the distances of a marker are judged: those to which it keeps them best."""

    min_mates: Count = 3
    """Fewer of them that are seen judge nothing; nor do fewer whose distances vary by less than a repair changes the marker."""

    min_deviation_mm: PositiveMillimetres = 0.1
    """No expected distance counts as more certain than this."""

    degrees_of_freedom: Positive = 4
    """Degrees of freedom of the Student's t distribution of distances: the fewer, the less a distance that is far off counts."""

    min_gain: NotNegative = 0
    """Mean logarithm of the factor, over samples and distances by their precision, by which a repair makes the distances more
    likely: above this.

    Change it when good samples are repaired (higher), or artifacts are left (lower)."""

    min_gain_share: Share = 0.4
    """Mean of that logarithm over samples and distances alike, as a part of what a right repair would bring, at least (0 to 1)."""

    clear_gain: NotNegative = 1
    """The same mean, by itself, from which a repair stands whatever the most precise, or the usual, distances say: a mate may be off
    itself, and a pose rare."""

    max_loss: NotNegative = 0.5
    """The same, by which it makes the usual distances of the subject alone less likely, at most."""

    shaking_window_s: PositiveSeconds = 0.2
    """Motion within such a window is fast: what a repair of shaking changes."""

    min_shaking_windows: Positive = 1.5
    """A finding of shaking lasts for as many windows, at least."""

    min_fast_share: Share = 0.7
    """A repair takes shaking away if this share of its changes, by their squares, is fast, at least (0 to 1)."""

    max_shaking_mm: Millimetres = 10
    """Root mean square of its changes, at most: larger ones the distances must bear out."""

    max_shaking_left: Share = 0.5
    """A repair that leaves at most this part of the squares of the fast changes, in more than half of the distances, stands unless
    it takes them away from the usual ones (0 to 1)."""

    max_misfit: NotNegative = 1
    """Mean logarithm of the factor by which distances are less likely than the expected ones: measured samples that no repair is
    accurate enough for are taken away above it only, and kept below it."""


@dataclass(frozen=True)
class RepairOptions:
    """Repair what was found."""

    predictors: Annotated[
        PredictorOptions, Shared(("local_ridge", "interpolation", "polynomial", "replicated_network"))
    ] = field(default_factory=PredictorOptions)
    """The predictors."""

    protect: Annotated[tuple[str, ...], Shared()] = ()
    """Markers that are not touched, as name patterns with `*` and `?`."""

    methods: Annotated[Mapping[str, tuple[str, ...]], Keys(tuple(USUAL_METHODS)), Laboratory] = field(
        default_factory=lambda: dict(USUAL_METHODS)
    )
    """For each class the methods that are compared, in order of preference; an empty list makes its findings missing (exchanged labels: leaves them).

    Change it when you prefer another repair for a class."""

    max_altered_share: Annotated[Share, Laboratory] = 0.1
    """Nothing is repaired if more than this share of the seen samples was found (0 to 1), exchanged labels aside.

    Change it when recordings of poor quality are refused as a whole (higher, with care)."""

    displacement: Annotated[DisplacementOptions, Shared()] = field(default_factory=DisplacementOptions)
    """Lasting displacements."""

    move_back_lasting: Annotated[bool, Laboratory] = False
    """Whether markers that were knocked, or crept, to another place for good are moved back; else they are reported and left.

    Change it when such recordings cannot be measured again (`true`)."""

    max_repair_s: Annotated[Seconds, Laboratory] = 2
    """Longer findings become missing instead.

    Change it when long artifacts should become gaps (lower) or be repaired (higher)."""

    max_error_mm: Annotated[Millimetres, Laboratory] = 20
    """Findings whose repair has a larger expected error become missing instead.

    Change it when your purpose can bear a larger error, or only a smaller one."""

    objections: bool = True
    """Whether a repair is refused that may err by more than it changes or than `max_error_mm`, or that the neighbours or their distances speak
    against; if not, every finding is repaired by the method of the least expected error.

    Change it when you repeat a paper (`false`)."""

    preference_factor: Factor = 1.25
    """Of two methods whose expected errors differ by less than this factor the preferred one is taken, else the better one.

    Change it when the order of the methods should always decide (higher)."""

    savitzky_golay_order: CountOrNone = 13
    """Order of the method savitzky_golay."""

    savitzky_golay_window_s: Seconds = 1.01
    """Window of the method savitzky_golay."""

    hidden_stretches: CountOrNone = 10
    """Stretches that are hidden to measure the error of a method that does not state one."""

    separation: SeparationOptions = field(default_factory=SeparationOptions)
    """Options of the methods separate_levels, separate_noise, separate_step and separate_slow, which separate the trajectory from
    the artifact."""

    guard: ShapeGuardOptions = field(default_factory=ShapeGuardOptions)
    """Guard against repairs that take a marker away from the subject's usual shape."""

    radius: RepairRadiusOptions = field(default_factory=RepairRadiusOptions)
    """Radii of the balls around repaired samples."""
