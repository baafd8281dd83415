"""Settings of gap filling."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

WEIGHTS = ("error", "pma", "both", "equal")
"""Weights by the error on pseudo-gaps; by the likelihood of distances (tits2018 eq 20-24); by both; or all alike."""


@dataclass(frozen=True)
class FillOptions:
    """What may be filled (config section `fill`).

    max_gap_s: longest gap filled, s, None = any. max_gap_s_of: the same for name patterns of markers. ends: whether
    gaps at the recording's ends are filled. protect: name patterns of markers never filled. seen_share: markers seen in
    fewer of the frames are left alone. border_s: how long the marker must be seen without a break on either side, s.
    max_error_mm: gaps whose expected error (68 %) exceeds it stay open, None = any. max_altered_share: if more of the
    recording's samples were altered, nothing is filled. reuse: filled markers are references for later ones.
    members: predictors that fill together. trial_frames: most training frames on pseudo-gaps. ensemble: how the members
    are weighted.
    """

    max_gap_s: float | None
    max_gap_s_of: Mapping[str, float]
    ends: bool
    protect: Sequence[str]
    seen_share: float
    border_s: float
    max_error_mm: float | None
    max_altered_share: float
    reuse: bool
    members: Sequence[str]
    trial_frames: int
    ensemble: EnsembleOptions


@dataclass(frozen=True)
class EnsembleOptions:
    """Settings of the averaging (config section `fill`, key `ensemble`).

    weights: one of WEIGHTS. longest_s: by name, members that are asked only about gaps up to so many s. fallback:
    members that are asked only where no other that looks at the body can tell. power: weights fall with this power of
    the error. pseudo_gaps: so many are tried. hidden_share: share of a marker's samples that are hidden at once for
    trials, which then share what is learned without them. similar_length, similar_neighbours: gaps of a marker share
    their pseudo-gaps if their lengths differ by less than this factor and the same of so many nearest neighbours are
    missing; of a marker at most `most_sorts` sorts of gaps have pseudo-gaps of their own. worst: members whose error exceeds the best member's by this factor are left out. distances: see
    DistanceOptions. error_mm: least error of a member. prior: weight of the stated errors, in pseudo-gaps, against what
    the pseudo-gaps of a gap tell. radius: see RadiusOptions.
    """

    weights: str
    longest_s: Mapping[str, float]
    fallback: Sequence[str]
    power: float
    pseudo_gaps: int
    hidden_share: float
    similar_length: float
    similar_neighbours: int
    most_sorts: int
    worst: float
    distances: Mapping[str, float]
    error_mm: float
    prior: float
    radius: Mapping[str, float]

    def __post_init__(self) -> None:
        if self.weights not in WEIGHTS:
            raise ValueError(f"unknown weights {self.weights!r}: one of {', '.join(WEIGHTS)}")


@dataclass(frozen=True)
class DistanceOptions:
    """Settings of both (config section `fill.ensemble`, key `distances`).

    references: distances to so many are judged. minimum_frames: joint frames that make a reference. frames: most frames
    and samples used to learn distances. smoothing_s: moving average over the likelihoods. floor: least likelihood.
    spacing_references, spacing_low, spacing_high, spacing_rounds: see constrain_spacing (0 rounds: off).
    """

    references: int
    minimum_frames: int
    frames: int
    smoothing_s: float
    floor: float
    spacing_references: int
    spacing_low: float
    spacing_high: float
    spacing_rounds: int


@dataclass(frozen=True)
class RadiusOptions:
    """What is believed about radii before a recording is looked at (config section `fill.ensemble`, key `radius`).

    inner, outer: radii of the 68 and 95 % balls in units of the stated standard deviation per axis (Gaussian: 1.872 and
    2.795). trials: how many pseudo-gaps of the recording weigh as much as that belief.
    """

    inner: float
    outer: float
    trials: float

    def __post_init__(self) -> None:
        if not 0 < self.inner < self.outer or self.trials <= 0:
            raise ValueError("radii: 0 < inner < outer and trials > 0")
