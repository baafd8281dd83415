"""Options of gap filling."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Literal

from markermend.options.declaration import (
    Above,
    Count,
    CountOrNone,
    Distinct,
    Factor,
    Laboratory,
    Millimetres,
    NotEmpty,
    NotNegative,
    Positive,
    PositiveMillimetres,
    Seconds,
    Share,
    Shared,
)
from markermend.options.prediction.predictors import PredictorOptions

WEIGHTS = ("error", "pma", "both", "equal")
"""Weights by the error on pseudo-gaps; by the likelihood of distances (tits2018 eq 20-24); by both; or all equal."""


@dataclass(frozen=True)
class DistanceOptions:
    """Distances between markers, as likelihood of a position and as constraint on it."""

    references: Count = 3
    """Markers whose distances to the filled one are compared with the usual ones."""

    min_frames: Count = 60
    """Frames on which both the marker and a reference must be seen."""

    max_frames: Count = 500
    """Frames and samples from which distances are learned, at most."""

    reference_choice: Literal["steadiest", "seen"] = "steadiest"
    """Whether these are the markers whose distance varies least (`steadiest`; one that is missing does not count), or those of them that are
    `seen` throughout the gap (tits2018)."""

    smoothing_s: Seconds = 0.07
    """Window of the moving average over the likelihoods of distances."""

    smoothing_filter: Literal["mean", "median_mean"] = "mean"
    """Filter over these likelihoods: a moving average, or a moving median before it (the program released with tits2018)."""

    min_likelihood: Positive = 1e-200
    """Smallest likelihood of a distance."""

    spacing_references: Count = 3
    """Markers that the spacing constraint considers."""

    spacing_lower_quantile: Share = 0.01
    """Lower end of the interval in which a distance must lie (0 to 1)."""

    spacing_upper_quantile: Share = 0.99
    """Upper end of the interval in which a distance must lie (0 to 1)."""

    spacing_order: Literal["steadiest_first", "steadiest_last"] = "steadiest_first"
    """Order in which a position is moved to its usual distances from them; the last one holds exactly (in the program released with
    tits2018 the steadiest)."""

    spacing_rounds: CountOrNone = 0
    """Rounds of the spacing constraint; 0 turns it off.

    Change it when you repeat tits2018 (5); it makes short gaps worse."""


@dataclass(frozen=True)
class RadiusOptions:
    """Radii of the balls around filled samples, before anything is known about the recording."""

    inner: Positive = 1.55
    """Radius of the ball that holds the true position with probability 0.68, in stated standard deviations of one axis
    (1.872 for a Gaussian)."""

    outer: Positive = 3.3
    """Radius of the ball that holds it with probability 0.95, in the same units (2.795 for a Gaussian)."""

    prior_pseudo_gaps: Positive = 20
    """Pseudo-gaps of the recording that weigh as much as these radii.

    Change it when recordings with few gaps state erratic errors (higher)."""

    def __post_init__(self) -> None:
        if not 0 < self.inner < self.outer or self.prior_pseudo_gaps <= 0:
            raise ValueError("radii: 0 < inner < outer and prior_pseudo_gaps > 0")


@dataclass(frozen=True)
class EnsembleOptions:
    """Averaging of the members."""

    weights: Literal["error", "pma", "both", "equal"] = "error"
    """Weights of the members: by their `error` on pseudo-gaps, by the likelihood of distances (`pma`), by `both`, or `equal`.

    Change it when you repeat tits2018 (`pma`)."""

    time_constraint: Literal["laboratory", "local", "off"] = "laboratory"
    """How predictions are made to meet the samples before and after a gap: by a ramp in `laboratory` axes (tits2018 eq 16-19), by a
    ramp in the `local` frame of members that have one (its released program), or not (`off`); interpolations meet them by themselves.

    Change it when you repeat tits2018 (`off`, to see its effect)."""

    member_smoothing_s: Seconds = 0
    """Window of a moving median, then a moving mean, over the prediction of each of several members; 0 for none (0.07 in the program
    released with tits2018)."""

    max_gap_s_of_member: Mapping[str, Seconds] = field(
        default_factory=lambda: {"linear": 0.5, "spline": 0.5, "pchip": 0.5, "makima": 0.5}
    )
    """Longest gap for which a member is used, by the member's name."""

    fallback_members: tuple[str, ...] = ("linear_regression",)
    """Members that are used only where no other member that uses the body can predict."""

    error_power: NotNegative = 3
    """Weights fall with this power of a member's error on the pseudo-gaps."""

    pseudo_gaps: CountOrNone = 5
    """Stretches of known samples that are hidden to measure the members' errors.

    Change it when you trade time for accuracy (higher is slower)."""

    jump_margin_s: Seconds = 0.1
    """Time that these keep from the borders of findings that were left as measured, at which a marker may jump."""

    max_hidden_share: Share = 0.2
    """Share of a marker's samples that is hidden at once for pseudo-gaps, which then share one training (0 to 1; smaller is slower)."""

    max_length_ratio: Annotated[float, Above(1)] = 1.5
    """Gaps of a marker are of one kind, and share their pseudo-gaps, if their lengths differ by less than this factor and the
    same neighbours are missing."""

    compared_neighbours: CountOrNone = 12
    """Nearest neighbours that are compared for this."""

    motion_neighbours: Count = 4
    """Nearest neighbours by whose motion gaps and pseudo-gaps are compared: by how much a cubic curve between their borders errs on them."""

    motion_power_of_member: Mapping[str, NotNegative] = field(
        default_factory=lambda: {"linear": 1.0, "spline": 1.0, "pchip": 1.0, "makima": 1.0}
    )
    """Where a gap moves more than its pseudo-gaps, errors of these members grow with this power of the motion, by the member's name."""

    stated_motion_power: NotNegative = 0.2
    """Where a gap moves more than its pseudo-gaps, the stated error grows with this power of the motion."""

    max_gap_kinds: Count = 12
    """Kinds of gaps of a marker that have pseudo-gaps of their own, at most; others count as the most similar kind.

    Change it when filling takes too long where a marker flickers (lower)."""

    max_error_ratio: Factor = 2
    """Members whose error exceeds that of the best member by this factor are left out."""

    min_error_mm: PositiveMillimetres = 0.01
    """Smallest error of a member."""

    stated_error_weight: NotNegative = 2
    """Weight of the errors that members state, in pseudo-gaps."""

    distances: DistanceOptions = field(default_factory=DistanceOptions)
    """Distances between markers: how they weigh and bound positions."""

    radius: RadiusOptions = field(default_factory=RadiusOptions)
    """Radii of the balls around filled samples, before anything is known about the recording."""

    def __post_init__(self) -> None:
        if self.weights not in WEIGHTS:
            raise ValueError(f"unknown weights {self.weights!r}: one of {', '.join(WEIGHTS)}")


@dataclass(frozen=True)
class FillOptions:
    """Fill the gaps."""

    predictors: Annotated[PredictorOptions, Shared()] = field(default_factory=PredictorOptions)
    """The predictors."""

    protect: Annotated[tuple[str, ...], Shared()] = ()
    """Markers that are not filled, as name patterns with `*` and `?`."""

    max_gap_s: Annotated[Seconds | None, Laboratory] = 2
    """Longest gap that is filled; a longer one stays as it is; `null` for any.

    Change it when your analysis can bear longer filled gaps, or only shorter ones."""

    max_gap_s_of: Annotated[Mapping[str, Seconds], Laboratory] = field(default_factory=dict)
    """Longest gap of single markers, by name pattern with `*` and `?`.

    Change it when some markers can bear longer or shorter filled gaps: `{"*TOE": 0.2}`."""

    fill_ends: Annotated[bool, Laboratory] = False
    """Whether gaps at the start and the end of the recording are filled.

    Change it when you know that it is safe to extrapolate there."""

    min_seen_share: Annotated[Share, Laboratory] = 0.3
    """Markers that are seen in a smaller share of the frames are left alone (0 to 1).

    Change it when markers that are seen for a small part of the recording matter to you."""

    max_error_mm: Annotated[Millimetres | None, Laboratory] = 50
    """Gaps with a larger expected error stay open; `null` for any.

    Change it when your purpose can bear a larger error, or only a smaller one."""

    max_error95_mm: Annotated[Millimetres | None, Laboratory] = 100
    """Gaps in which the true position may be farther away than this with a probability of 5 % stay open; `null` for any.

    Change it when your purpose can bear rare large errors, or not."""

    max_altered_share: Annotated[Share, Laboratory] = 0.25
    """Nothing is filled if more than this share of the samples would be altered (0 to 1).

    Change it when recordings of poor quality are refused as a whole (higher, with care)."""

    members: Annotated[tuple[str, ...], NotEmpty, Distinct, Laboratory] = (
        "local_gp",
        "local_gp_wide",
        "local_gp_fine",
        "local_interpolation",
        "local_grnn",
        "spline",
        "linear_regression",
    )
    """Predictors, and variants of local_ridge and local_gp, that fill together.

    Change it when you repeat a paper, or filling takes too long (fewer)."""

    pool: Annotated[bool, Laboratory] = True
    """Whether the predictors learn from the subject's other recordings, too.

    Change it when each recording must be filled from what it shows by itself."""

    border_s: Seconds = 0.02
    """Time for which a marker must be seen without a break on either side of a gap, unless the gap could be filled without the
    shorter pieces."""

    checked_piece_s: Seconds = 0.05
    """Pieces between gaps that are shorter are used only where they are as predicted without them, if the gap could be filled without them;
    0 to use all."""

    piece_tolerance: Positive = 2
    """Largest distance of such a piece from what is predicted, as a multiple of the radius of the 95 % ball.

    Change it when ghosts bend the filling (lower)."""

    rigid_mates: Count = 3
    """Markers that form a rigid body with a marker and are seen throughout a gap, so that it needs no border."""

    max_rigid_spread_mm: PositiveMillimetres = 3
    """Largest spread of the distances within a rigid body."""

    reuse_filled: bool = True
    """Whether filled markers are inputs for those that are filled later."""

    fill_again: bool = True
    """Whether gaps are filled once more of which near neighbours were filled later.

    Change it when filling takes too long where many markers are missing at once (`false`)."""

    smoothing_s: Seconds = 0
    """Window of a moving median, then a moving mean, over what was filled; 0 for none (0.07 in the program released with tits2018)."""

    ensemble: EnsembleOptions = field(default_factory=EnsembleOptions)
    """Averaging of the members, and expected error."""
